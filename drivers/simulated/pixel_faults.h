#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "drivers/simulated/dice.h"

namespace tubesight::drivers {

/// The lines of one field of a full frame, to change.
struct FieldPixels {
  std::uint8_t* pixels = nullptr;  ///< first pixel of the field's first line
  std::int32_t width_px = 0;
  std::int32_t lines = 0;
  std::int32_t stride_px = 0;  ///< from one line of the field to the next

  [[nodiscard]] std::uint8_t* line(std::int32_t index) const {
    return pixels + static_cast<std::ptrdiff_t>(index) * stride_px;
  }
};

/// What faults do to the pixels of a field; the same dice leave the same bytes.

/// All pixels become `grey`.
void fill(const FieldPixels& field, std::uint8_t grey);

/// All pixels become even noise, 0..255.
void snow(const FieldPixels& field, Dice& dice);

/// A `share` of the lines is lifted or lowered, each by a number of its own up to `amplitude`,
/// fading along the line as a burst does.
void disturb_lines(const FieldPixels& field, double share, double amplitude, Dice& dice);

/// A `share` of the pixels becomes white or black, half each.
void salt_and_pepper(const FieldPixels& field, double share, Dice& dice);

}  // namespace tubesight::drivers
