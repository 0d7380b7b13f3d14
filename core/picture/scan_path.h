#pragma once

#include <cstddef>
#include <cstdint>

#include "core/picture/averaged_picture.h"

namespace tubesight::core::picture {

/// A walk along a row or a column of an averaged picture in one direction, with the two paths
/// beside it that the 24-pixel operator reads [Fallon eq. 5.1]: v±2 on a row, u±2 on a column.
///
/// Position i is i steps outwards from the walk's first pixel; positions -`before` .. `after` are
/// in the picture.
struct ScanPath {
  const std::uint16_t* origin = nullptr;
  std::ptrdiff_t step = 1;
  std::ptrdiff_t side = 0;
  std::int32_t before = 0;
  std::int32_t after = 0;

  [[nodiscard]] std::int32_t grey(std::int32_t position) const { return origin[position * step]; }
  [[nodiscard]] std::int32_t pair(std::int32_t position) const {
    const std::uint16_t* const p = origin + position * step;
    return std::int32_t{p[-side]} + std::int32_t{p[side]};
  }
};

/// Pixels that Eq. 5.1 sums ahead and behind.
inline constexpr std::int32_t kScanTaps = 6;

/// The path from pixel (u, v) along its row (`horizontal`) or column, towards growing coordinates
/// (`direction` 1) or the other way (-1). Needs 2 <= across < size - 2.
[[nodiscard]] ScanPath scan_path(const AveragedPicture& picture, std::int32_t u, std::int32_t v,
                                 bool horizontal, std::int32_t direction);

/// Where a walk meets the rise from dark to bright.
struct ScanEdge {
  bool found = false;
  double position = 0.0;      ///< in steps from the first pixel, where dark and bright meet halfway
  std::int32_t gradient = 0;  ///< of Eq. 5.1 at its peak, whole grey levels
};

/// Walks outwards, `reach` steps at most, until the gradient of Eq. 5.1 exceeds `threshold`, then
/// to the peak of that rise; the edge is where the walk's own grey values cross the middle between
/// the dark behind and the brightest two neighbours shortly ahead: the narrow bright rim of a
/// fillet weld, not the shadow outside it.
[[nodiscard]] ScanEdge find_scan_edge(const ScanPath& path, std::int32_t first, std::int32_t reach,
                                      std::int32_t threshold);

}  // namespace tubesight::core::picture
