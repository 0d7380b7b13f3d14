#pragma once

#include <cstdint>

namespace tubesight::drivers {

/// When a frame was taken, as a video's file tells: `ticks` units of numerator / denominator
/// seconds, from an origin that only the file knows.
struct FrameStamp {
  std::int64_t ticks = 0;
  std::int64_t numerator = 0;  ///< 1..1'000'000'000, as is the denominator
  std::int64_t denominator = 1;
};

}  // namespace tubesight::drivers
