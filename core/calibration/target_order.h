#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/calibration/calibration_data.h"
#include "core/detection/lattice_finder.h"

namespace tubesight::core::calibration {

/// How a template's dots are laid out.
enum class TargetLattice : std::uint8_t {
  kSquare,     ///< lines below each other
  kStaggered,  ///< odd lines, from 0, shifted by half the spacing
};

/// A template of dots.
struct Target {
  std::int32_t rows = 0;     ///< lines of dots
  std::int32_t columns = 0;  ///< dots in a line
  TargetLattice lattice = TargetLattice::kSquare;
  double spacing_mm = 0.0;      ///< along a line
  double row_spacing_mm = 0.0;  ///< between lines
  double dot_mm = 0.0;          ///< diameter; 0: points
  bool bright = true;           ///< dots bright on dark
};

/// Why a lattice found is not the template.
enum class OrderRefusal : std::uint8_t {
  kNone,
  kColour,  ///< bright where dark ones are expected, or the reverse
  kForm,    ///< other steps: not this pitch over diameter, not these angles
  kCount,   ///< lines or dots missing at an edge, or too many of them
};

/// Gives the elements of a lattice found their places on the template, appended to `dots`.
///
/// The template's own symmetry leaves open which corner is dot (0, 0); it is the same for all
/// pictures that show the template in the same attitude. Of a staggered one either the odd or the
/// even lines may be those that are shifted: a lattice seen tells which. All lines and all dots of
/// a line must show somewhere, as nothing else tells where the template ends; single ones may be
/// missing. One whose surroundings the picture's edge cuts off counts for that and is not appended:
/// its centroid is not known.
[[nodiscard]] OrderRefusal order_on_target(const detection::FoundLattice& found,
                                           const Target& target,
                                           StaticVector<SeenDot, kMaxDots>& dots);

}  // namespace tubesight::core::calibration
