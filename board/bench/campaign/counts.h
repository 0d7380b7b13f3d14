#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/sighting.h"

namespace tubesight::board::campaign {

/// What is counted; the columns of progress files and reports in this order.
enum class Count : std::uint8_t {
  kMoves,
  kFields,          ///< that the box looked at, from the start to the end of a move or to its loss
  kAfterLoss,       ///< fields of moves after the track was lost or the start refused: not drawn
  kTubes,           ///< tubes under which the tool truly came into the gate
  kTrulyAligned,    ///< fields in which the tool is truly 0.3 mm or more inside the gate
  kMissed,          ///< of those, not vouched for
  kMissedLost,      ///< of the missed, after a loss or a refused start
  kVouched,         ///< fields with `aligned`
  kWrongTube,       ///< of those, under another tube than named, or where no tube stands
  kFalseAligned,    ///< of those, truly 0.3 mm or more outside the gate
  kUndetectable,    ///< vouched for and wrong by just the lattice step of a silent jump
  kNamed,           ///< fields with a tube named, truly 1.5 mm or more clear of half the pitch
  kWrongNearest,    ///< of those, with another name than the nearest tube's
  kMovesLost,       ///< moves whose track was lost
  kMovesRefused,    ///< moves whose start was refused
  kMovesWrongTube,  ///< moves with a field of kWrongTube; likewise the others
  kMovesFalseAligned,
  kMovesUndetectable,
  kMovesWrongNearest,
  kMovesMissed,
  kLostNoTubes,  ///< losses by their reason
  kLostCoasted,
  kLostJump,
  kLostSpeed,
  kLostGap,
  kLostTime,
  kLostArithmetic,
  kLostSequence,
  kLostRate,
  kLostFieldOrder,
  kLostMap,
};
inline constexpr std::size_t kCounts = 31;

/// The word of a count in files.
[[nodiscard]] std::string_view name_of(Count count);

/// What was counted in a move, a stratum, a campaign.
class Counts {
 public:
  [[nodiscard]] std::int64_t operator[](Count count) const {
    return values_[static_cast<std::size_t>(count)];
  }
  std::int64_t& operator[](Count count) { return values_[static_cast<std::size_t>(count)]; }

  Counts& operator+=(const Counts& other);
  friend bool operator==(const Counts&, const Counts&) = default;

 private:
  std::array<std::int64_t, kCounts> values_{};
};

/// Where a loss for `reason` is counted.
[[nodiscard]] Count loss_count(core::Reason reason);

}  // namespace tubesight::board::campaign
