#include "board/bench/campaign/lamp_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

#include "board/bench/campaign/move_judge.h"
#include "board/bench/campaign/move_run.h"
#include "board/bench/campaign/random_parts.h"
#include "board/bench/script/simulated_box.h"

namespace tubesight::board::campaign {
namespace {

using core::Liveness;
using core::TrackState;

constexpr std::array<std::string_view, kLampFaults> kFaultNames = {"sound", "dead", "fades",
                                                                   "frozen", "other-camera"};
constexpr std::array<std::string_view, kLampMotions> kMotionNames = {"rests", "moves", "goes-on"};
constexpr std::array<std::string_view, kLampCounts> kCountNames = {
    "runs",        "fields",  "refused", "proved",  "false_alarms", "named",         "named_late",
    "lost_before", "unnamed", "unknown", "vouched", "wrong",        "wrong_unnamed", "runs_wrong"};

/// What is still seen of a run after the fault has its name.
constexpr double kAfterName_s = 1.0;

double limit_s(const LampRun& run) {
  return run.motion == LampMotion::kRests ? kNamedAtRest_s : kNamedMoving_s;
}

/// Judges the fields of a run.
class LampJudge {
 public:
  LampJudge(const LampRun& run, const drivers::Scenario& scenario)
      : run_(run),
        moves_({scenario.told.verification.aligned_within_mm, pitch_mm(scenario.scene.sheet)}),
        begins_s_(scenario.faults.empty() ? scenario.video.length_s + 1.0
                                          : scenario.faults.front().at_s) {}

  void take(double now_s, const FieldTruth& truth, const core::session::Output& output) {
    const core::Sighting& sighting = output.sighting;
    const std::int64_t wrong = moves_.counts()[Count::kWrongTube];
    moves_.take(truth, sighting);
    now_s_ = now_s;
    liveness_ = sighting.liveness;
    refused_ = refused_ || sighting.state == TrackState::kWaiting;
    if (sighting.liveness == Liveness::kProved && proved_s_ < 0.0) {
      proved_s_ = now_s;
    }
    const bool fault = core::lighting::is_fault(output.lamp);
    if (now_s < begins_s_) {
      false_alarm_ = false_alarm_ || fault || sighting.liveness == Liveness::kFailed;
      return;
    }
    if (named_s_ < 0.0 && moves_.counts()[Count::kWrongTube] > wrong) {
      ++wrong_unnamed_;
    }
    if (named_s_ < 0.0 && fault) {
      named_s_ = now_s;
      lost_before_ = lost_;
      named_ = core::lighting::words_of(output.lamp).word;
    }
    lost_ = lost_ || sighting.state == TrackState::kLost;
  }

  /// Whether there is nothing more to see.
  [[nodiscard]] bool over() const {
    return refused_ || (named_s_ >= 0.0 && now_s_ > named_s_ + kAfterName_s);
  }

  [[nodiscard]] std::string_view named() const { return named_; }

  [[nodiscard]] LampCounts counts() const {
    LampCounts counts;
    counts[LampCount::kRuns] = 1;
    const Counts fields = moves_.counts();
    counts[LampCount::kFields] = fields[Count::kFields];
    counts[LampCount::kRefused] = refused_ ? 1 : 0;
    if (refused_) {
      return counts;
    }
    counts[LampCount::kProved] = proved_s_ >= 0.0 ? 1 : 0;
    counts.proved_ms_most = milliseconds(std::max(proved_s_, 0.0));
    counts[LampCount::kFalseAlarms] = false_alarm_ ? 1 : 0;
    counts[LampCount::kVouched] = fields[Count::kVouched];
    counts[LampCount::kWrong] = fields[Count::kWrongTube];
    counts[LampCount::kWrongUnnamed] = wrong_unnamed_;
    counts[LampCount::kRunsWrong] = fields[Count::kMovesWrongTube];
    if (run_.fault == LampFault::kNone) {
      return counts;
    }
    counts[LampCount::kNamed] = named_s_ >= 0.0 ? 1 : 0;
    counts[LampCount::kUnnamed] = named_s_ < 0.0 ? 1 : 0;
    counts[LampCount::kUnknown] = named_s_ < 0.0 && liveness_ != Liveness::kProved ? 1 : 0;
    counts[LampCount::kLostBefore] = (named_s_ < 0.0 ? lost_ : lost_before_) ? 1 : 0;
    if (named_s_ >= 0.0) {
      const double took_s = std::max(named_s_ - run_.fault_s, 0.0);
      counts[LampCount::kNamedLate] = took_s > limit_s(run_) ? 1 : 0;
      counts.named_ms_sum = counts.named_ms_most = milliseconds(took_s);
    }
    return counts;
  }

 private:
  static std::int64_t milliseconds(double s) { return std::llround(1000.0 * s); }

  LampRun run_;
  MoveJudge moves_;
  double begins_s_;
  double now_s_ = 0.0;
  Liveness liveness_ = Liveness::kUnknown;
  double proved_s_ = -1.0;
  double named_s_ = -1.0;
  bool refused_ = false;
  bool false_alarm_ = false;
  bool lost_ = false;         ///< since the fault
  bool lost_before_ = false;  ///< when it got its name
  std::int64_t wrong_unnamed_ = 0;
  std::string_view named_;
};

}  // namespace

std::int32_t lamp_kind_of(const LampRun& run) {
  return static_cast<std::int32_t>(run.fault) + kLampFaults * static_cast<std::int32_t>(run.motion);
}

std::string lamp_kind_name(std::int32_t kind) {
  return std::string(kFaultNames.at(static_cast<std::size_t>(kind % kLampFaults))) + "/" +
         std::string(kMotionNames.at(static_cast<std::size_t>(kind / kLampFaults)));
}

std::string_view name_of(LampCount count) {
  return kCountNames.at(static_cast<std::size_t>(count));
}

LampCounts& LampCounts::operator+=(const LampCounts& other) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] += other.values[i];
  }
  named_ms_sum += other.named_ms_sum;
  named_ms_most = std::max(named_ms_most, other.named_ms_most);
  proved_ms_most = std::max(proved_ms_most, other.proved_ms_most);
  return *this;
}

LampResult LampRunner::run(const drivers::Scenario& scenario, const LampRun& run) {
  LampResult result;
  const auto box = std::make_unique<SimulatedBox<>>(*world_, scenario, run.policy);
  if (!box->start()) {
    return result;
  }
  result.runs = true;
  LampJudge judge(run, scenario);
  while (!judge.over() && box->turn()) {
    const drivers::SimulatedField& field = box->field();
    const double now_s = std::chrono::duration<double>(field.field.mid_exposure).count();
    judge.take(now_s, judged_truth(scenario, field.truth), box->output());
  }
  result.counts = judge.counts();
  result.named = judge.named();
  return result;
}

}  // namespace tubesight::board::campaign
