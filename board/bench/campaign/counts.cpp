#include "board/bench/campaign/counts.h"

namespace tubesight::board::campaign {
namespace {

constexpr std::array<std::string_view, kCounts> kNames = {"moves",
                                                          "fields",
                                                          "after_loss",
                                                          "tubes",
                                                          "truly_aligned",
                                                          "missed",
                                                          "missed_lost",
                                                          "vouched",
                                                          "wrong_tube",
                                                          "false_aligned",
                                                          "undetectable",
                                                          "named",
                                                          "wrong_nearest",
                                                          "moves_lost",
                                                          "moves_refused",
                                                          "moves_wrong_tube",
                                                          "moves_false_aligned",
                                                          "moves_undetectable",
                                                          "moves_wrong_nearest",
                                                          "moves_missed",
                                                          "lost_no_tubes",
                                                          "lost_coasted",
                                                          "lost_jump",
                                                          "lost_speed",
                                                          "lost_gap",
                                                          "lost_time",
                                                          "lost_arithmetic",
                                                          "lost_sequence",
                                                          "lost_rate",
                                                          "lost_field_order",
                                                          "lost_map"};

}  // namespace

std::string_view name_of(Count count) { return kNames[static_cast<std::size_t>(count)]; }

Counts& Counts::operator+=(const Counts& other) {
  for (std::size_t i = 0; i < kCounts; ++i) {
    values_[i] += other.values_[i];
  }
  return *this;
}

Count loss_count(core::Reason reason) {
  using core::Reason;
  switch (reason) {
    case Reason::kNoTubes: return Count::kLostNoTubes;
    case Reason::kJump: return Count::kLostJump;
    case Reason::kSpeed: return Count::kLostSpeed;
    case Reason::kGap: return Count::kLostGap;
    case Reason::kTime: return Count::kLostTime;
    case Reason::kSequence: return Count::kLostSequence;
    case Reason::kRate: return Count::kLostRate;
    case Reason::kFieldOrder: return Count::kLostFieldOrder;
    case Reason::kMap: return Count::kLostMap;
    case Reason::kArithmetic: return Count::kLostArithmetic;
    default: return Count::kLostCoasted;
  }
}

}  // namespace tubesight::board::campaign
