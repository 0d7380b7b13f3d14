#include "core/lighting/tube_light.h"

#include <algorithm>
#include <cstddef>

namespace tubesight::core::lighting {
namespace {

constexpr std::int32_t kLines = 12;
constexpr std::int32_t kPixels = 16;  // a line: their sum is the mean in 1/16

/// No sheet has rows of that number.
constexpr std::int32_t kNoRow = -1'000'000'000;

}  // namespace

void list_tube_light(std::span<const TubeSighting> tubes, TubeLightList& lights) {
  lights.clear();
  for (const TubeSighting& tube : tubes) {
    if (!tube.plug && tube.quality_permyriad > 0) {
      static_cast<void>(lights.try_push_back({tube.address, tube.contrast_q4}));
    }
  }
}

void list_window_light(const FieldView& field, const PixelBox& window, TubeLightList& lights) {
  lights.clear();
  for (std::int32_t i = 0; i < kLines; ++i) {
    const std::int32_t v = window.top + (window.bottom - window.top) * (2 * i + 1) / (2 * kLines);
    const std::int32_t line =
        std::clamp((v - field.first_line) / field.line_step, 0, field.lines - 1);
    const std::uint8_t* pixels = field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px;
    std::int32_t sum = 0;
    for (std::int32_t j = 0; j < kPixels; ++j) {
      const std::int32_t u =
          window.left + (window.right - window.left) * (2 * j + 1) / (2 * kPixels);
      sum += pixels[std::clamp(u, 0, field.width_px - 1)];
    }
    static_cast<void>(lights.try_push_back({{kNoRow, i}, sum}));
  }
}

std::int32_t mean_light_q4(const TubeLightList& lights) {
  std::int32_t sum = 0;
  for (const TubeLight& light : lights) {
    sum += light.light_q4;
  }
  return lights.empty() ? 0 : sum / lights.size();
}

}  // namespace tubesight::core::lighting
