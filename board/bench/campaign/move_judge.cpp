#include "board/bench/campaign/move_judge.h"

namespace tubesight::board::campaign {
namespace {

using core::TrackState;
using core::TubeAddress;

constexpr double kGateSlack_mm = 0.3;
constexpr double kHalfPitchSlack_mm = 1.5;

// Off by just the steps that nothing showed: no box can know better.
constexpr bool explained_by_slip(TubeAddress told, const FieldTruth& truth) {
  const TubeAddress slipped{told.row + truth.slip.row, told.column + truth.slip.column};
  return truth.slip != TubeAddress{} && slipped == truth.nearest;
}

}  // namespace

bool MoveJudge::truly_aligned(const FieldTruth& truth) const {
  return truth.present && truth.open && truth.offset_mm <= limits_.gate_mm - kGateSlack_mm;
}

void MoveJudge::visit(const FieldTruth& truth) {
  if (!truly_aligned(truth)) {
    return;
  }
  ++counts_[Count::kTrulyAligned];
  if (!visiting_ || truth.nearest != visited_) {
    ++counts_[Count::kTubes];
  }
  visiting_ = true;
  visited_ = truth.nearest;
}

void MoveJudge::take(const FieldTruth& truth, const core::Sighting& sighting) {
  visit(truth);
  ++counts_[Count::kFields];
  const bool lost = sighting.state == TrackState::kLost || sighting.state == TrackState::kWaiting;
  if (truly_aligned(truth) && !sighting.aligned) {
    ++counts_[Count::kMissed];
    counts_[Count::kMissedLost] += lost ? 1 : 0;
  }
  if (sighting.aligned) {
    judge_vouched(truth, sighting);
  }
  const bool clear =
      truth.present && truth.offset_mm < limits_.shortest_step_mm / 2.0 - kHalfPitchSlack_mm;
  if (clear && sighting.tool_known) {
    ++counts_[Count::kNamed];
    if (sighting.tool != truth.nearest && !explained_by_slip(sighting.tool, truth)) {
      ++counts_[Count::kWrongNearest];
    }
  }
  if (lost && !over_) {
    over_ = true;
    if (sighting.state == TrackState::kLost) {
      ++counts_[Count::kMovesLost];
      ++counts_[loss_count(sighting.reason)];
    } else {
      ++counts_[Count::kMovesRefused];
    }
  }
}

void MoveJudge::judge_vouched(const FieldTruth& truth, const core::Sighting& sighting) {
  ++counts_[Count::kVouched];
  if (sighting.tool == truth.nearest && truth.present) {
    counts_[Count::kFalseAligned] += truth.offset_mm > limits_.gate_mm + kGateSlack_mm ? 1 : 0;
    return;
  }
  if (explained_by_slip(sighting.tool, truth)) {
    ++counts_[Count::kUndetectable];
    return;
  }
  ++counts_[Count::kWrongTube];
  if (first_wrong_field_ < 0) {
    first_wrong_field_ = counts_[Count::kFields] - 1;
  }
}

void MoveJudge::take_unseen(const FieldTruth& truth) {
  visit(truth);
  ++counts_[Count::kAfterLoss];
  if (truly_aligned(truth)) {
    ++counts_[Count::kMissed];
    ++counts_[Count::kMissedLost];
  }
}

Counts MoveJudge::counts() const {
  Counts counts = counts_;
  counts[Count::kMoves] = 1;
  const auto flag = [&counts](Count fields, Count moves) {
    counts[moves] = counts[fields] > 0 ? 1 : 0;
  };
  flag(Count::kWrongTube, Count::kMovesWrongTube);
  flag(Count::kFalseAligned, Count::kMovesFalseAligned);
  flag(Count::kUndetectable, Count::kMovesUndetectable);
  flag(Count::kWrongNearest, Count::kMovesWrongNearest);
  flag(Count::kMissed, Count::kMovesMissed);
  return counts;
}

}  // namespace tubesight::board::campaign
