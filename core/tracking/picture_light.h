#pragma once

#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core::tracking {

/// What the light in the search window allows.
enum class PictureLight : std::uint8_t {
  kUsable,
  kDark,       ///< hardly anything is brighter than the inside of a tube-end
  kWashedOut,  ///< hardly anything is darker than saturation
};

/// Judges the window by 16 x 12 pixels spread over it.
[[nodiscard]] PictureLight judge_light(const FieldView& field, const PixelBox& window);

}  // namespace tubesight::core::tracking
