#include "core/tracking/picture_memory.h"

#include <algorithm>
#include <cstring>

namespace tubesight::core::tracking {
namespace {

constexpr std::int32_t kBlock_px = PictureMemory::kBlock_px;
constexpr std::int32_t kLeastGrey = 24;  // black levels may be cut off, and without noise
constexpr std::int32_t kMostGrey = 235;
// Six standard deviations of a noisy camera's pixels: a block that differs as much shows an edge.
constexpr std::int32_t kEdge = 24;

/// Calls `visit` with the number and the pixels of each block; none where the window is too narrow.
template <typename Visit>
void for_each_block(const FieldView& field, const PixelBox& window, Visit visit) {
  constexpr std::int32_t kLines = PictureMemory::kLines;
  constexpr std::int32_t kBlocks = PictureMemory::kBlocks;
  const std::int32_t left = std::clamp(window.left, 0, field.width_px - 1);
  const std::int32_t width = std::clamp(window.right, left, field.width_px - 1) - left + 1;
  if (width < 8 * kBlock_px) {
    return;
  }
  std::size_t number = 0;
  for (std::int32_t i = 0; i < kLines; ++i) {
    const std::int32_t v = window.top + (window.bottom - window.top) * (2 * i + 1) / (2 * kLines);
    const std::int32_t line =
        std::clamp((v - field.first_line) / field.line_step, 0, field.lines - 1);
    const std::uint8_t* const pixels =
        field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px + left;
    for (std::int32_t block = 0; block < kBlocks; ++block) {
      visit(number++, pixels + (width - kBlock_px) * block / (kBlocks - 1));
    }
  }
}

/// Two pictures of a block.
struct Pair {
  std::int32_t darkest = 255;  ///< of both
  std::int32_t brightest = 0;
  std::int32_t grey = 0;   ///< sum of the newer
  std::int32_t noise = 0;  ///< n sum d^2 - (sum d)^2, n (n - 1) times the variance of d
};

Pair compare(const std::uint8_t* now, const std::uint8_t* before) {
  Pair pair;
  std::int32_t sum = 0;
  std::int32_t squares = 0;
  for (std::int32_t i = 0; i < kBlock_px; ++i) {
    const std::int32_t a = now[i];
    const std::int32_t b = before[i];
    pair.darkest = std::min({pair.darkest, a, b});
    pair.brightest = std::max({pair.brightest, a, b});
    pair.grey += a;
    sum += a - b;
    squares += (a - b) * (a - b);
  }
  pair.noise = kBlock_px * squares - sum * sum;
  return pair;
}

}  // namespace

PictureLikeness PictureMemory::look(const FieldView& field, Parity parity, const PixelBox& window,
                                    std::int32_t usual_noise) const {
  PictureLikeness likeness;
  if (!known_[place_of(parity)]) {
    return likeness;
  }
  const Pixels& kept = kept_[place_of(parity)];
  std::array<std::int32_t, kAll> noises{};
  std::int32_t noise = 0;
  std::int32_t grey = 0;
  std::int32_t sum = 0;  // of all blocks' mean grey, and of its square
  std::int32_t squares = 0;
  for_each_block(field, window, [&](std::size_t number, const std::uint8_t* pixels) {
    const std::uint8_t* const before = kept.data() + number * kBlock_px;
    const Pair pair = compare(pixels, before);
    const std::int32_t mean = pair.grey / kBlock_px;
    sum += mean;
    squares += mean * mean;
    // Of one grey in both pictures: a patch put over the picture, and no camera's.
    const bool blank = pair.darkest == pair.brightest;
    if (blank || pair.darkest < kLeastGrey || pair.brightest >= kMostGrey) {
      return;
    }
    const bool equal = std::memcmp(pixels, before, kBlock_px) == 0;
    noises[static_cast<std::size_t>(likeness.compared++)] = pair.noise;
    likeness.equal += equal ? 1 : 0;
    likeness.equal_edges += equal && pair.brightest - pair.darkest >= kEdge ? 1 : 0;
    likeness.quiet += 2 * pair.noise < usual_noise ? 1 : 0;
    noise += pair.noise;
    grey += pair.grey;
  });
  constexpr auto kCount = static_cast<std::int32_t>(kAll);
  likeness.contrast = (kCount * squares - sum * sum) / (kCount * kCount);
  if (likeness.compared > 0) {
    const auto middle = noises.begin() + likeness.compared / 2;
    std::nth_element(noises.begin(), middle, noises.begin() + likeness.compared);
    likeness.middle_noise = *middle;
    likeness.noise = noise / likeness.compared;
    likeness.grey = grey / (likeness.compared * kBlock_px);
  }
  return likeness;
}

void PictureMemory::keep(const FieldView& field, Parity parity, const PixelBox& window) {
  Pixels& kept = kept_[place_of(parity)];
  bool& known = known_[place_of(parity)];
  known = false;
  for_each_block(field, window, [&](std::size_t number, const std::uint8_t* pixels) {
    std::memcpy(kept.data() + number * kBlock_px, pixels, kBlock_px);
    known = true;
  });
}

}  // namespace tubesight::core::tracking
