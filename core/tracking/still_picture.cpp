#include "core/tracking/still_picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace tubesight::core::tracking {
namespace {

// Five standard deviations of a mean of 16 noisy pixels (sigma 8), and half of what an edge of the
// least contrast changes in its block when it moves by half of it.
constexpr std::int32_t kChange = 10;
// An eighth of the blocks: a third of them hold an edge, and a shift by half a block changes those.
constexpr std::int32_t kMostChanged = 8;
constexpr std::int32_t kLeastContrast = 40;

}  // namespace

void StillPicture::look(const Field& field) {
  told_ = false;
  if (field.status == FieldStatus::kMissing) {
    return;  // the time that passed is seen in the next field
  }
  Means means{};
  if (field.status != FieldStatus::kGood || !mean_blocks(field.pixels, means) ||
      !has_contrast(means)) {
    forget();
    return;
  }
  const auto parity = static_cast<std::size_t>(field.parity);
  const bool counted = field.sequence >= last_sequence_;
  last_sequence_ = field.sequence;
  if (!resting_) {
    begin(field, means);
  } else if (!compared_[parity]) {
    reference_[parity] = means;
    compared_[parity] = true;
  } else {
    const FieldTime passed = field.mid_exposure - last_time_[parity];
    const bool same = means == last_[parity];
    const bool at_rest = counted && passed > FieldTime(0) && passed <= setup_.longest_gap &&
                         alike(means, reference_[parity]);
    if (same && noisy_) {
      forget();
    } else if (at_rest) {
      noisy_ = noisy_ || shows_noise(last_[parity], means);
      told_ = true;
    } else {
      begin(field, means);
    }
  }
  last_[parity] = means;
  last_time_[parity] = field.mid_exposure;
}

// Whether blocks that are no edges differ: motion changes edges, noise all.
bool StillPicture::shows_noise(const Means& before, const Means& now) {
  constexpr std::int32_t kFlat = 3;  // grey levels to the blocks beside it
  const auto near = [](std::uint8_t a, std::uint8_t b) {
    return std::abs(std::int32_t{a} - std::int32_t{b}) < kFlat;
  };
  std::int32_t flat = 0;
  std::int32_t changed = 0;
  for (std::size_t i = 1; i + 1 < now.size(); ++i) {
    if (near(now[i], now[i - 1]) && near(now[i], now[i + 1])) {
      ++flat;
      changed += now[i] != before[i] ? 1 : 0;
    }
  }
  return changed >= kLines / 2 && 8 * changed >= flat;
}

void StillPicture::begin(const Field& field, const Means& means) {
  const auto parity = static_cast<std::size_t>(field.parity);
  compared_ = {};
  compared_[parity] = true;
  reference_[parity] = means;
  since_ = field.number;
  resting_ = true;
  told_ = true;
}

bool StillPicture::mean_blocks(const FieldView& field, Means& means) const {
  const PixelBox& window = setup_.window;
  const std::int32_t left = std::clamp(window.left, 0, field.width_px - 1);
  const std::int32_t width = std::clamp(window.right, left, field.width_px - 1) - left + 1;
  if (width < 2 * kBlock_px || field.lines < 1) {
    return false;
  }
  for (std::int32_t i = 0; i < kLines; ++i) {
    const std::int32_t v = window.top + (window.bottom - window.top) * (2 * i + 1) / (2 * kLines);
    const std::int32_t line =
        std::clamp((v - field.first_line) / field.line_step, 0, field.lines - 1);
    const std::uint8_t* const pixels =
        field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px + left;
    for (std::int32_t block = 0; block < kBlocks; ++block) {
      const std::uint8_t* const from = pixels + (width - kBlock_px) * block / (kBlocks - 1);
      std::int32_t sum = 0;
      for (std::int32_t k = 0; k < kBlock_px; ++k) {
        sum += from[k];
      }
      means[static_cast<std::size_t>(i * kBlocks + block)] =
          static_cast<std::uint8_t>(sum / kBlock_px);
    }
  }
  return true;
}

bool StillPicture::has_contrast(const Means& means) {
  const auto [darkest, brightest] = std::minmax_element(means.begin(), means.end());
  return *brightest - *darkest >= kLeastContrast;
}

bool StillPicture::alike(const Means& a, const Means& b) {
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    changed += std::abs(std::int32_t{a[i]} - std::int32_t{b[i]}) > kChange ? 1 : 0;
  }
  return changed * kMostChanged <= kLines * kBlocks;
}

}  // namespace tubesight::core::tracking
