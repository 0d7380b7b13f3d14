#include "tests/system/scenario_judge.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "board/bench/script/simulated_box.h"
#include "core/base/names.h"
#include "core/session/session.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::tests {
namespace {

using core::rendering::TubeEndKind;

constexpr double kSlack_mm = 0.3;
constexpr double kUnclear_mm = 1.5;

void judge_field(const drivers::SimulatedField& field, const core::Sighting& sighting,
                 double gate_mm, double pitch_mm, ScenarioVerdict& verdict) {
  const auto& nearest = field.truth.axis.nearest;
  const bool stands = nearest.kind != TubeEndKind::kVoid;
  const bool aligned = stands && nearest.offset_mm <= gate_mm - kSlack_mm;
  const bool clear = stands && nearest.offset_mm < pitch_mm / 2.0 - kUnclear_mm;
  const bool right = sighting.tool_known && sighting.tool == nearest.address;
  verdict.truly_aligned += aligned ? 1 : 0;
  verdict.missed += aligned && !sighting.aligned ? 1 : 0;
  const bool wrong_tube = sighting.aligned && (!right || !stands);
  const bool false_aligned = sighting.aligned && nearest.offset_mm > gate_mm + kSlack_mm;
  const bool wrong_nearest = sighting.tool_known && clear && !right;
  // Off by just the steps that nothing showed: no box can know better. Nothing else is excused.
  const auto& [rows, columns] = field.truth.slip;
  const core::TubeAddress slipped{sighting.tool.row + rows, sighting.tool.column + columns};
  const bool excused = (rows != 0 || columns != 0) && slipped == nearest.address;
  verdict.undetectable += excused && (wrong_tube || wrong_nearest) ? 1 : 0;
  verdict.wrong_tube += wrong_tube && !excused ? 1 : 0;
  verdict.false_aligned += false_aligned ? 1 : 0;
  verdict.wrong_nearest += wrong_nearest && !excused ? 1 : 0;
}

void judge_replies(const core::session::Output& output, ScenarioVerdict& verdict) {
  for (const core::Reply& reply : output.replies) {
    if (const auto* const claim = core::content_if<core::ClaimReply>(reply)) {
      ++verdict.claims;
      verdict.contradicted += claim->verdict == core::ClaimVerdict::kContradicted ? 1 : 0;
      verdict.confirmed += claim->verdict == core::ClaimVerdict::kConfirmed ? 1 : 0;
    }
  }
}

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double ScenarioVerdict::answered_share() const { return share(answered, fields); }
double ScenarioVerdict::missed_share() const { return share(missed, truly_aligned); }

std::string ScenarioVerdict::text() const {
  std::ostringstream text;
  text << fields << " fields, answered " << answered_share() << ", missed " << missed_share()
       << " of " << truly_aligned << ", wrong tube " << wrong_tube << ", false aligned "
       << false_aligned << ", wrong nearest " << wrong_nearest << ", undetectable " << undetectable
       << ", contradicted " << contradicted << " and confirmed " << confirmed << " of " << claims
       << ", tubes " << tubes.size() << ", end " << core::name_of(end);
  for (const core::Reason reason : lost) {
    text << ", lost " << core::name_of(reason);
  }
  for (const core::Reason reason : degraded) {
    text << ", degraded " << core::name_of(reason);
  }
  return text.str();
}

ScenarioVerdict judge_scenario(const drivers::ScenarioFile& file) {
  ScenarioVerdict verdict;
  const auto world = std::make_unique<drivers::SimulatedWorld>();
  const drivers::Scenario& scenario = file.scenario;
  const auto box = std::make_unique<board::SimulatedBox<>>(*world, scenario);
  if (!box->start()) {
    return verdict;
  }
  verdict.played = true;
  const double pitch_mm = core::tubesheet::shortest_step_mm(scenario.told.tubesheet);
  const drivers::SimulatedField& field = box->field();
  while (box->turn()) {
    const core::Sighting& sighting = box->output().sighting;
    ++verdict.fields;
    verdict.end = sighting.state;
    if (sighting.state == core::TrackState::kLost) {
      verdict.lost.insert(sighting.reason);
    } else if (sighting.state != core::TrackState::kWaiting) {
      ++verdict.answered;
    }
    if (sighting.state == core::TrackState::kDegraded) {
      verdict.degraded.insert(sighting.reason);
    }
    judge_field(field, sighting, scenario.told.verification.aligned_within_mm, pitch_mm, verdict);
    const core::TubeAddress nearest = field.truth.axis.nearest.address;
    if (sighting.aligned && sighting.tool == nearest) {
      verdict.tubes.emplace(nearest.row, nearest.column);
    }
    judge_replies(box->output(), verdict);
  }
  return verdict;
}

}  // namespace tubesight::tests
