#include "core/tracking/picture_light.h"

#include <algorithm>

namespace tubesight::core::tracking {

PictureLight judge_light(const FieldView& field, const PixelBox& window) {
  constexpr std::int32_t kColumns = 16;
  constexpr std::int32_t kLines = 12;
  constexpr std::int32_t kBright = 24;  // grey levels: black levels and read noise stay below
  constexpr std::int32_t kUnsaturated = 235;
  std::int32_t bright = 0;
  std::int32_t unsaturated = 0;
  for (std::int32_t i = 0; i < kLines; ++i) {
    const std::int32_t v = window.top + (window.bottom - window.top) * (2 * i + 1) / (2 * kLines);
    const std::int32_t line =
        std::clamp((v - field.first_line) / field.line_step, 0, field.lines - 1);
    const std::uint8_t* pixels = field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px;
    for (std::int32_t j = 0; j < kColumns; ++j) {
      const std::int32_t u =
          window.left + (window.right - window.left) * (2 * j + 1) / (2 * kColumns);
      const std::int32_t value = pixels[std::clamp(u, 0, field.width_px - 1)];
      bright += value >= kBright ? 1 : 0;
      unsaturated += value < kUnsaturated ? 1 : 0;
    }
  }
  constexpr std::int32_t kFew = kColumns * kLines / 32;
  if (bright <= kFew) {
    return PictureLight::kDark;
  }
  return unsaturated <= kFew ? PictureLight::kWashedOut : PictureLight::kUsable;
}

}  // namespace tubesight::core::tracking
