#include "core/detection/threshold_map.h"

#include <algorithm>

namespace tubesight::core::detection {

Result<void> ThresholdMap::measure(const picture::AveragedPicture& picture) {
  const std::int32_t shorter = std::min(picture.width_px, picture.height_px);
  const std::int32_t longer = std::max(picture.width_px, picture.height_px);
  if (longer > kMaxSide_px || shorter < 3 * kTile_px) {
    return Unexpected(Error::kOutOfRange);
  }
  width_px_ = picture.width_px;
  columns_ = picture.width_px / kTile_px;
  rows_ = picture.height_px / kTile_px;
  for (std::int32_t y = 0; y < rows_; ++y) {
    for (std::int32_t x = 0; x < columns_; ++x) {
      std::uint16_t dark = 0xffff;
      std::uint16_t bright = 0;
      for (std::int32_t v = y * kTile_px; v < (y + 1) * kTile_px; ++v) {
        const std::uint16_t* const pixel = picture.line(v) + x * kTile_px;
        for (std::int32_t u = 0; u < kTile_px; ++u) {
          dark = std::min(dark, pixel[u]);
          bright = std::max(bright, pixel[u]);
        }
      }
      dark_[at(x, y)] = dark;
      bright_[at(x, y)] = bright;
    }
  }
  pool(dark_, [](std::uint16_t a, std::uint16_t b) { return std::min(a, b); });
  pool(bright_, [](std::uint16_t a, std::uint16_t b) { return std::max(a, b); });
  return {};
}

/// Replaces each tile's level by what `choose` makes of its own and those of its neighbours: along
/// rows first, then along columns.
template <typename Choose>
void ThresholdMap::pool(std::array<std::uint16_t, kMaxTiles>& level, Choose choose) {
  for (std::int32_t y = 0; y < rows_; ++y) {
    for (std::int32_t x = 0; x < columns_; ++x) {
      std::uint16_t value = level[at(x, y)];
      value = x > 0 ? choose(value, level[at(x - 1, y)]) : value;
      scratch_[at(x, y)] = x + 1 < columns_ ? choose(value, level[at(x + 1, y)]) : value;
    }
  }
  for (std::int32_t y = 0; y < rows_; ++y) {
    for (std::int32_t x = 0; x < columns_; ++x) {
      std::uint16_t value = scratch_[at(x, y)];
      value = y > 0 ? choose(value, scratch_[at(x, y - 1)]) : value;
      level[at(x, y)] = y + 1 < rows_ ? choose(value, scratch_[at(x, y + 1)]) : value;
    }
  }
}

bool ThresholdMap::choose(double share, double least_contrast) {
  const auto least = static_cast<std::int32_t>(least_contrast * picture::kGreyScale);
  const auto share_q8 = static_cast<std::int32_t>(share * 256.0);
  bool any = false;
  const std::size_t tiles = at(0, rows_);
  for (std::size_t i = 0; i < tiles; ++i) {
    const std::int32_t range = bright_[i] - dark_[i];
    const bool edge = range >= least;
    threshold_[i] = edge ? static_cast<std::uint16_t>(dark_[i] + ((range * share_q8) >> 8)) : 0;
    any = any || edge;
  }
  if (any) {
    fill_flat();
  }
  return any;
}

/// The mean of the known thresholds among the eight neighbours; 0: none is known.
std::uint16_t ThresholdMap::around(std::int32_t x, std::int32_t y) const {
  std::int32_t sum = 0;
  std::int32_t count = 0;
  for (std::int32_t j = std::max(0, y - 1); j <= std::min(rows_ - 1, y + 1); ++j) {
    for (std::int32_t i = std::max(0, x - 1); i <= std::min(columns_ - 1, x + 1); ++i) {
      const std::int32_t value = threshold_[at(i, j)];
      sum += value;
      count += value > 0 ? 1 : 0;
    }
  }
  return count > 0 ? static_cast<std::uint16_t>(sum / count) : std::uint16_t{0};
}

/// Lets the known thresholds grow into the unknown, a ring of tiles a round.
void ThresholdMap::fill_flat() {
  const std::int32_t rounds = rows_ + columns_;
  for (std::int32_t round = 0; round < rounds; ++round) {
    bool open = false;
    for (std::int32_t y = 0; y < rows_; ++y) {
      for (std::int32_t x = 0; x < columns_; ++x) {
        const std::uint16_t known = threshold_[at(x, y)];
        scratch_[at(x, y)] = known > 0 ? known : around(x, y);
        open = open || known == 0;
      }
    }
    if (!open) {
      return;
    }
    std::copy_n(scratch_.begin(), at(0, rows_), threshold_.begin());
  }
}

void ThresholdMap::line(std::int32_t v, std::span<std::uint16_t> thresholds) const {
  // Between the middles of tiles in both directions, in sixteenths of a tile.
  constexpr std::int32_t kParts = 2 * kTile_px;
  const std::int32_t down = std::clamp(2 * v + 1 - kTile_px, 0, (rows_ - 1) * kParts);
  const std::int32_t y = std::min(down / kParts, rows_ - 2);
  const std::int32_t y_part = down - y * kParts;
  const auto column = [&](std::int32_t x) {
    return threshold_[at(x, y)] * (kParts - y_part) + threshold_[at(x, y + 1)] * y_part;
  };
  const auto narrow = [](std::int32_t value) {
    return static_cast<std::uint16_t>(value / (kParts * kParts));
  };
  const auto pixel = thresholds.begin();
  std::fill(pixel, pixel + kTile_px / 2, narrow(column(0) * kParts));
  std::int32_t u = kTile_px / 2;
  for (std::int32_t x = 0; x + 1 < columns_; ++x) {
    const std::int32_t left = column(x);
    const std::int32_t step = column(x + 1) - left;
    for (std::int32_t part = 1; part < kParts; part += 2) {
      pixel[u++] = narrow(left * kParts + step * part);
    }
  }
  std::fill(pixel + u, pixel + width_px_, narrow(column(columns_ - 1) * kParts));
}

}  // namespace tubesight::core::detection
