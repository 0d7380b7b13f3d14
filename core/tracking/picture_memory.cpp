#include "core/tracking/picture_memory.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace tubesight::core::tracking {
namespace {

constexpr std::int32_t kBlocks = 8;      // of a line, spread over it
constexpr std::int32_t kBlock_px = 8;    // as many as a register takes at once
constexpr std::int32_t kLeastGrey = 24;  // black levels may be cut off, and without noise
constexpr std::int32_t kMostGrey = 235;
constexpr std::int32_t kEnoughGrey = 2;  // blocks that begin with grey

// A sum in which each pixel counts by its place; 0 for a line without grey. `step` from block to
// block.
std::uint64_t sum_of(const std::uint8_t* pixels, std::int32_t step) {
  std::uint64_t sum = 1;
  std::int32_t grey = 0;
  for (std::int32_t i = 0; i < kBlocks; ++i, pixels += step) {
    std::uint64_t block = 0;
    std::memcpy(&block, pixels, kBlock_px);
    sum = (sum ^ block) * 0x9e3779b97f4a7c15ULL;
    sum ^= sum >> 32U;
    grey += *pixels >= kLeastGrey && *pixels < kMostGrey ? 1 : 0;
  }
  return grey >= kEnoughGrey ? std::max<std::uint64_t>(sum, 1) : 0;
}

}  // namespace

PictureLikeness PictureMemory::look(const FieldView& field, Parity parity, const PixelBox& window) {
  PictureLikeness likeness;
  Sums& before = sums_[static_cast<std::size_t>(parity)];
  const std::int32_t left = std::clamp(window.left, 0, field.width_px - 1);
  const std::int32_t width = std::clamp(window.right, left, field.width_px - 1) - left + 1;
  if (width < kBlocks * kBlock_px) {
    return likeness;
  }
  const std::int32_t step = (width - kBlock_px) / (kBlocks - 1);
  for (std::int32_t i = 0; i < kLines; ++i) {
    const std::int32_t v = window.top + (window.bottom - window.top) * (2 * i + 1) / (2 * kLines);
    const std::int32_t line =
        std::clamp((v - field.first_line) / field.line_step, 0, field.lines - 1);
    const std::uint8_t* const pixels =
        field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px + left;
    const std::uint64_t sum = sum_of(pixels, step);
    std::uint64_t& last = before[static_cast<std::size_t>(i)];
    likeness.compared += sum != 0 && last != 0 ? 1 : 0;
    likeness.equal += sum != 0 && sum == last ? 1 : 0;
    last = sum;
  }
  return likeness;
}

}  // namespace tubesight::core::tracking
