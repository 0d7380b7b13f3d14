#pragma once

#include <cstdint>

#include "board/bench/campaign/counts.h"
#include "core/base/sighting.h"
#include "core/base/tube_address.h"

namespace tubesight::board::campaign {

/// What is true of one field.
struct FieldTruth {
  core::TubeAddress nearest{};  ///< tube of the lattice nearest to the guidetube's axis
  bool present = true;          ///< a tube stands there, open or plugged
  bool open = true;             ///< or told to be plugged: a box can vouch for it
  double offset_mm = 0.0;       ///< its distance from the axis
  /// drivers::FieldTruth::slip: a box that cannot have noticed names the true tube less these.
  core::TubeAddress slip{};
};

/// What a judgement needs to know of the settings.
struct JudgeLimits {
  double gate_mm = 2.5;           ///< aligned_within_mm
  double shortest_step_mm = 0.0;  ///< distance of neighbouring tubes
};

/// Judges what the box says in the fields of one move.
///
/// The rules are those by which recordings are scored: 0.3 mm on either side of the gate count for
/// neither, and where the axis is within 1.5 mm of half the pitch no name of a tube is judged
/// unless the box vouches for it.
class MoveJudge {
 public:
  explicit MoveJudge(const JudgeLimits& limits) : limits_(limits) {}

  /// Judges a field that the box looked at.
  void take(const FieldTruth& truth, const core::Sighting& sighting);

  /// Takes a field after the end of the track, which the box was not shown: it would say `lost`.
  void take_unseen(const FieldTruth& truth);

  /// Whether there is nothing more to see: lost, or the start refused.
  [[nodiscard]] bool over() const { return over_; }

  /// The counts of the move so far, as one move.
  [[nodiscard]] Counts counts() const;

  /// Number of the first field that vouched for a wrong tube; -1 when there is none.
  [[nodiscard]] std::int64_t first_wrong_field() const { return first_wrong_field_; }

 private:
  [[nodiscard]] bool truly_aligned(const FieldTruth& truth) const;
  void visit(const FieldTruth& truth);
  void judge_vouched(const FieldTruth& truth, const core::Sighting& sighting);

  JudgeLimits limits_;
  Counts counts_;
  bool over_ = false;
  bool visiting_ = false;
  core::TubeAddress visited_{};
  std::int64_t first_wrong_field_ = -1;
};

}  // namespace tubesight::board::campaign
