#pragma once

#include <chrono>
#include <cstdint>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

/// How a bulb is spared.
struct LampCare {
  std::chrono::milliseconds soft{500};  ///< from dark to full, and back; 0: at once
  /// How long more than `rest_permille` may shine at a stretch; 0: without end. As long again at or
  /// below it gives all of that time back.
  std::chrono::seconds full_for{0};
  std::int32_t rest_permille = 1000;
};

/// From the level that is wanted to the one that shines. Asks no clock.
class LampRamp {
 public:
  explicit LampRamp(const LampCare& care) : care_(care) {}

  /// Begins dark at `now`.
  void begin(MonotonicTime now);

  /// The level from `now` on.
  std::int32_t next(std::int32_t wanted_permille, MonotonicTime now);

  /// Whether the time at full power is used up, and the light is held back.
  [[nodiscard]] bool resting() const { return resting_; }

 private:
  LampCare care_;
  MonotonicTime last_{0};
  std::int64_t level_millionth_ = 0;
  MonotonicTime spent_{0};  ///< above the rest's level, less what was given back
  bool resting_ = false;
};

}  // namespace tubesight::board
