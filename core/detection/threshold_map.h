#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// The largest side of a picture that is searched: a map of 512 x 512 tiles, 1.5 MB.
inline constexpr std::int32_t kMaxSide_px = 4096;

/// A threshold between dark and bright that follows a picture's light, kept on tiles.
///
/// Between the darkest and the brightest pixel nearby, where these differ; where they do not (the
/// inside of a large dot, the sheet between) what the nearest tiles with an edge say, so that such
/// a place is on the side of the edge that it lies on.
class ThresholdMap {
 public:
  /// Side of a tile. An edge and its blur fit into three of them, which a tile looks at; more, and
  /// a bright rim hides the edge of its neighbour in the dark.
  static constexpr std::int32_t kTile_px = 8;

  /// Reads the picture's light. kOutOfRange: a side is longer than kMaxSide_px or shorter than
  /// three tiles.
  [[nodiscard]] Result<void> measure(const picture::AveragedPicture& picture);

  /// Sets the thresholds at `share` of the way from dark to bright. Where the two differ by less
  /// than `least_contrast` grey levels there is no edge. False: no edge anywhere.
  [[nodiscard]] bool choose(double share, double least_contrast);

  /// The thresholds of line `v`, as wide as the picture, in 1/256 grey level.
  void line(std::int32_t v, std::span<std::uint16_t> thresholds) const;

 private:
  static constexpr std::size_t kMaxTiles =
      static_cast<std::size_t>(kMaxSide_px / kTile_px) * (kMaxSide_px / kTile_px);

  [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }
  template <typename Choose>
  void pool(std::array<std::uint16_t, kMaxTiles>& level, Choose choose);
  [[nodiscard]] std::uint16_t around(std::int32_t x, std::int32_t y) const;
  void fill_flat();

  std::int32_t width_px_ = 0;
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::array<std::uint16_t, kMaxTiles> dark_{};
  std::array<std::uint16_t, kMaxTiles> bright_{};
  std::array<std::uint16_t, kMaxTiles> threshold_{};  ///< 0: not known yet
  std::array<std::uint16_t, kMaxTiles> scratch_{};
};

}  // namespace tubesight::core::detection
