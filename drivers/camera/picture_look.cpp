#include "drivers/camera/picture_look.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kPlacesAcross = 16;
constexpr std::int32_t kPlacesDown = 16;
/// Of a place the pixel beside it and one so far away are looked at.
constexpr std::int32_t kFar_px = 8;
/// Grey values by which neighbours differ in snow, in the mean; of evenly spread greys it is 85. A
/// sensor's noise of 10 grey values, a very dark one's, makes 11.
constexpr std::int32_t kSnow = 24;
/// What may differ in a picture of one grey: a converter's last bits.
constexpr std::int32_t kFlat = 4;
/// Luma of black is 16 or 0; that of blue is 29 to 41, and of grey more.
constexpr std::int32_t kBlackBelow = 24;

}  // namespace

// In any picture through a lens neighbours are more alike than pixels apart, as it draws no point
// finer than a pixel or two; in snow they are as different.
Look look_at(const core::FieldView& field) {
  if (field.width_px <= 2 * kFar_px || field.lines < kPlacesDown) {
    return Look::kPicture;
  }
  std::int32_t darkest = 255;
  std::int32_t brightest = 0;
  std::int32_t near = 0;
  std::int32_t apart = 0;
  const std::int32_t across = field.width_px - kFar_px - 1;
  for (std::int32_t y = 0; y < kPlacesDown; ++y) {
    const std::ptrdiff_t line = (2 * y + 1) * field.lines / (2 * kPlacesDown);
    for (std::int32_t x = 0; x < kPlacesAcross; ++x) {
      const std::uint8_t* const at =
          field.pixels + line * field.stride_px + (2 * x + 1) * across / (2 * kPlacesAcross);
      const std::int32_t grey = at[0];
      darkest = std::min(darkest, grey);
      brightest = std::max(brightest, grey);
      near += std::abs(grey - at[1]);
      apart += std::abs(grey - at[kFar_px]);
    }
  }
  if (brightest - darkest <= kFlat) {
    return brightest < kBlackBelow ? Look::kBlack : Look::kBlank;
  }
  const bool bright = near >= kSnow * kPlacesAcross * kPlacesDown;
  return bright && 4 * near >= 3 * apart ? Look::kNoise : Look::kPicture;
}

}  // namespace tubesight::drivers
