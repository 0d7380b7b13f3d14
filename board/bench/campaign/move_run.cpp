#include "board/bench/campaign/move_run.h"

#include <algorithm>
#include <chrono>

#include "board/bench/campaign/random_parts.h"
#include "board/bench/script/simulated_box.h"
#include "core/base/fnv1a.h"
#include "core/tracking/margin_policy.h"

namespace tubesight::board::campaign {
namespace {

using core::rendering::TubeEndKind;

// Whether a site is closed, and nobody told the box: it need not vouch for a tube that it never
// saw.
bool closed_untold(const drivers::Scenario& scenario, const core::rendering::NearestTube& nearest) {
  const auto plugged = scenario.told.tubesheet.plugged.view();
  const bool plug =
      nearest.kind == TubeEndKind::kPlugFlush || nearest.kind == TubeEndKind::kPlugRolled;
  return plug && std::find(plugged.begin(), plugged.end(), nearest.address) == plugged.end();
}

/// Over what matters of the answers.
class Digest {
 public:
  void add(std::int64_t value) { digest_.step(static_cast<std::uint64_t>(value)); }
  void add(const core::Sighting& sighting) {
    add(static_cast<std::int64_t>(sighting.state));
    add(static_cast<std::int64_t>(sighting.reason));
    add(sighting.tracked);
    add(sighting.tool.row);
    add(sighting.tool.column);
    add(sighting.offset_um_q8);
    add(sighting.aligned ? 1 : 0);
    add(sighting.margin_permyriad);
  }
  [[nodiscard]] std::uint64_t value() const { return digest_.value(); }

 private:
  core::Fnv1a digest_;
};

}  // namespace

FieldTruth judged_truth(const drivers::Scenario& scenario, const drivers::FieldTruth& field) {
  FieldTruth truth;
  const core::rendering::NearestTube& nearest = field.axis.nearest;
  truth.nearest = nearest.address;
  truth.present = field.axis_known && nearest.kind != TubeEndKind::kVoid;
  truth.open = !closed_untold(scenario, nearest);
  truth.offset_mm = nearest.offset_mm;
  truth.slip = {field.slip[0], field.slip[1]};
  return truth;
}

MoveResult MoveRunner::run(const drivers::Scenario& scenario, const RunOptions& options) {
  return options.margin_check
             ? play<core::tracking::MarginChecked>(scenario, options.stop_at_wrong)
             : play<core::tracking::MarginUnchecked>(scenario, options.stop_at_wrong);
}

template <typename Margin>
MoveResult MoveRunner::play(const drivers::Scenario& scenario, bool stop_at_wrong) {
  MoveResult result;
  const auto box = std::make_unique<SimulatedBox<Margin>>(*world_, scenario);
  if (!box->start()) {
    return result;
  }
  result.runs = true;
  MoveJudge judge({scenario.told.verification.aligned_within_mm, pitch_mm(scenario.scene.sheet)});
  Digest digest;
  const drivers::SimulatedField& field = box->field();
  while (!judge.over() && box->turn()) {
    const core::Sighting& sighting = box->output().sighting;
    digest.add(sighting);
    const std::int64_t wrong_before = judge.first_wrong_field();
    judge.take(judged_truth(scenario, field.truth), sighting);
    if (wrong_before < 0 && judge.first_wrong_field() >= 0) {
      result.first_wrong_field = field.slot;
      if (stop_at_wrong) {
        break;
      }
    }
  }
  if (judge.over()) {
    // The box says `lost` to the end: no need to draw that.
    for (std::int64_t slot = field.slot + 1; slot < world_->slots(); ++slot) {
      const double time_s = std::chrono::duration<double>(world_->slot_time(slot)).count() +
                            world_->faults_at(slot).skipped_s;
      const auto axis = world_->truth().axis(world_->path().state_at(time_s).T_sheet_tool);
      drivers::FieldTruth unseen = field.truth;
      unseen.axis_known = axis.has_value();
      unseen.axis = axis.value_or(core::rendering::AxisTruth{});
      judge.take_unseen(judged_truth(scenario, unseen));
    }
  }
  result.counts = judge.counts();
  result.digest = digest.value();
  return result;
}

}  // namespace tubesight::board::campaign
