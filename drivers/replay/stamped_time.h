#pragma once

#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "drivers/files/frame_stamp.h"

namespace tubesight::drivers {

/// Places the frames of a video in time by their stamps; the first frame is at 0.
///
/// Containers round stamps to their own unit (Matroska to a millisecond). A stamp within one unit
/// of a multiple of the frame's period is taken for that multiple, so that an even rate stays even;
/// all others are taken as they are, so that a variable rate and lost frames stay true.
class StampedTime {
 public:
  /// Frames a second, 1..1'000'000'000 each; as it is until the first place().
  void begin(std::int64_t rate_numerator, std::int64_t rate_denominator);

  /// Places the next frame; one without a stamp a period behind the one before.
  void place(const std::optional<FrameStamp>& stamp);

  /// Mid exposure of a field of the frame placed last.
  [[nodiscard]] core::FieldTime time(bool later_field) const;

 private:
  [[nodiscard]] core::FieldTime period() const;

  std::int64_t rate_numerator_ = 1;
  std::int64_t rate_denominator_ = 1;
  bool begun_ = false;
  std::optional<FrameStamp> first_;
  core::FieldTime time_{0};
  std::optional<std::int64_t> multiple_;  ///< of the period that time_ is
};

}  // namespace tubesight::drivers
