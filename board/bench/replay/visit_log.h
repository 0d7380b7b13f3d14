#pragma once

#include <cstdint>
#include <vector>

#include "core/base/field.h"
#include "core/base/sighting.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// A stretch of time for which the box vouched for one tube above the guidetube.
struct Visit {
  core::TubeAddress tube{};
  core::FieldTime from{0};
  core::FieldTime until{0};
  std::int64_t fields = 0;            ///< in which it vouched for it
  std::int64_t offset_sum_um_q8 = 0;  ///< over those fields, 1/256 um
  std::int64_t height_sum_um_q8 = 0;

  [[nodiscard]] core::FieldTime dwell() const { return until - from; }
};

/// Collects the tubes that a replay came under.
class VisitLog {
 public:
  /// Longest interruption, without another tube in between, that does not end a visit.
  static constexpr core::FieldTime kBridged = std::chrono::milliseconds(500);
  /// A shorter dwell is a tube passed on the way.
  static constexpr core::FieldTime kShortestVisit = std::chrono::milliseconds(200);

  /// Takes a field's answer and the time until the next field.
  void add(const core::Sighting& sighting, core::FieldTime span);

  /// All stretches in their order, tubes passed included.
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }

 private:
  std::vector<Visit> visits_;
};

}  // namespace tubesight::board
