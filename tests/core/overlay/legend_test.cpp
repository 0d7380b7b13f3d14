#include "tests/core/overlay/legend.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "core/overlay/palette.h"

namespace tubesight::tests {
namespace {

using core::overlay::Rgb;
namespace palette = core::overlay::palette;

Rgb pixel_of(const Picture& picture, std::int32_t u, std::int32_t v) {
  const std::size_t at = 3 * static_cast<std::size_t>(v * picture.width_px + u);
  return {picture.bytes[at], picture.bytes[at + 1], picture.bytes[at + 2]};
}

std::size_t count_of(const Picture& picture, Rgb colour) {
  std::size_t count = 0;
  for (std::int32_t v = 0; v < picture.height_px; ++v) {
    for (std::int32_t u = 0; u < picture.width_px; ++u) {
      count += pixel_of(picture, u, v) == colour ? 1U : 0U;
    }
  }
  return count;
}

TEST(OverlayLegend, ShowsEachColourThatAMarkHas) {
  const Picture legend = draw_legend();

  for (const Rgb colour :
       {palette::kRow, palette::kColumn, palette::kTool, palette::kAxis, palette::kUsed,
        palette::kRejected, palette::kPlug, palette::kClick, palette::kClickRefused,
        palette::kClaim, palette::kWindow, palette::kEstimateOpen, palette::kEstimatePlugged,
        palette::kEstimateAbsent, palette::kStateTracking, palette::kStateDegraded}) {
    EXPECT_GT(count_of(legend, colour), 4U)
        << int{colour.red} << ", " << int{colour.green} << ", " << int{colour.blue};
  }
}

TEST(OverlayLegend, CutsNoWords) {
  const Picture legend = draw_legend();

  for (const std::int32_t u : {legend.width_px / 2 - 1, legend.width_px - 1}) {
    for (std::int32_t v = 0; v < legend.height_px; ++v) {
      ASSERT_EQ(pixel_of(legend, u, v), palette::kBlack) << u << ", " << v;
    }
  }
}

}  // namespace
}  // namespace tubesight::tests
