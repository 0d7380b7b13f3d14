#pragma once

#include <cstdint>

#include "core/edges/edge_path.h"

namespace tubesight::core::edges {

/// Pixels that the horizontal operator sums ahead and behind [Fallon eq. 6.1].
inline constexpr std::int32_t kHorizontalTaps = 6;
/// Pixels that the vertical operator sums ahead and behind; it reads one field [Fallon eq. 6.2].
inline constexpr std::int32_t kVerticalTaps = 3;

/// Taps along a line where welds are fillets: the rim is bright for a few pixels only, with its
/// shadow behind, and six pixels ahead would average the two.
inline constexpr std::int32_t kFilletTaps = 4;

/// The gradient at one position of a path: `Taps` pairs ahead minus `Taps` pairs behind, ahead
/// being the direction of growing positions if `direction` is 1 and the other one if it is -1.
///
/// Eq. 6.1 for six taps on a horizontal path, Eq. 6.2 for three on a vertical one. Range
/// ±510 * Taps. Reads positions up to `Taps` away on either side.
[[nodiscard]] std::int32_t gradient(const EdgePath& path, std::int32_t position,
                                    std::int32_t direction, std::int32_t taps);

/// Where a search found the steepest rise from dark to bright.
struct EdgePeak {
  bool found = false;
  std::int32_t position = 0;  ///< of the greatest gradient
  std::int32_t gradient = 0;
};

/// Bounds of one search along a path.
struct SearchRange {
  std::int32_t first = 0;      ///< position where it starts, inside the dark
  std::int32_t direction = 1;  ///< 1 or -1
  std::int32_t steps = 0;      ///< positions looked at, at most
  std::int32_t taps = kHorizontalTaps;
  std::int32_t threshold = 0;
};

/// Walks outwards until the gradient exceeds the threshold, then to the peak of that rise.
///
/// The gradient is kept up by a running sum: four pairs of pixels a step. Reads positions from
/// `taps` before the first to `taps` + 1 behind the last step, which the caller keeps in the field.
[[nodiscard]] EdgePeak find_edge(const EdgePath& path, const SearchRange& range);

/// An edge to a fraction of a pixel.
struct Edge {
  bool found = false;
  std::int32_t position_q16 = 0;  ///< along the path, 1/65536 of a step
  std::int32_t contrast = 0;      ///< grey levels from dark to bright
};

/// How far around the peak the levels of dark and bright are read.
struct EdgeReach {
  std::int32_t dark = 4;    ///< steps behind the peak where the dark level is read (two pixels)
  std::int32_t bright = 4;  ///< steps ahead of it within which the bright level is looked for
};

/// Places the edge where the path crosses the middle between dark and bright, by interpolation.
///
/// The dark level is that of the tube's inside; the bright one the brightest two neighbouring
/// pixels shortly behind the rise, so that the narrow bright rim of a fillet weld counts and not
/// the shadow behind it. Not found when the path is not dark where it should be, or with less than
/// `least_contrast` grey levels. Reads positions `dark` + 1 behind to `bright` + 2 ahead of the
/// peak.
[[nodiscard]] Edge refine_edge(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
                               const EdgeReach& reach, std::int32_t least_contrast);

/// refine_edge() that reads every `stride`-th position alone, but for those around the crossing.
/// Reads positions `dark` + 1 behind to `bright` + 1 + `stride` ahead of the peak.
[[nodiscard]] Edge refine_edge_coarsely(const EdgePath& path, const EdgePeak& peak,
                                        std::int32_t direction, const EdgeReach& reach,
                                        std::int32_t stride, std::int32_t least_contrast);

/// Places the edge by how much of the three positions around the peak is dark: for paths that step
/// over the rise in one or two pixels, where interpolation would follow the pixels' places. Half a
/// cycle of that error is left: 0.06 px for an optical blur of 0.7 px on every second line.
///
/// Needs what refine_edge() needs; reads three positions to either side of the peak.
[[nodiscard]] Edge weigh_edge(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
                              std::int32_t least_contrast);

}  // namespace tubesight::core::edges
