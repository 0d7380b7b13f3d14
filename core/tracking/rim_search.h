#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/edges/dynamic_threshold.h"

namespace tubesight::core::tracking {

/// What a rim is to be looked for with.
struct MeasurementBounds {
  std::int32_t range_px = 5;        ///< the rim is looked for this far to both sides
  std::int32_t step_px = 1;         ///< from one reading to the next
  std::int32_t taps = 6;            ///< of the horizontal operator
  std::int32_t least_contrast = 8;  ///< grey levels
  bool thin_rim = false;            ///< the bright rim is a few pixels wide (fillet welds)
};

/// One rim point's equation for the shift (du, dv) of a tube-end and the growth of its rim: along a
/// line of the picture `distance = du - slope dv + growth * reach`, along a column with du and dv
/// exchanged.
template <Scalar S>
struct RimEquation {
  bool along_line = true;
  Mm<S> slope{};     ///< du/dv of the rim along a line's search, dv/du along a column's
  Mm<S> reach{};     ///< movement of the crossing for a growth of 1 px per 32 px
  Mm<S> distance{};  ///< found edge minus predicted crossing, px
  Mm<S> weight{};    ///< square of the cosine between search and rim's normal
  std::int32_t contrast = 0;
};

/// Why no equation came of a rim point.
enum class RimMiss : std::uint8_t { kNone, kOutside, kNoEdge };

/// Searches the field outwards across the predicted rim at one of its points.
///
/// `point` and `tangent` (px per rad) are of the predicted rim, `middle` its mean. The search runs
/// along the nearest line of the field, or along the nearest column where the rim runs too level.
template <Scalar S>
[[nodiscard]] RimMiss search_rim(const FieldView& field, const Vector2<Px<S>>& point,
                                 const Vector2<Px<S>>& tangent, const Vector2<Px<S>>& middle,
                                 const MeasurementBounds& bounds,
                                 edges::DynamicThreshold& threshold, RimEquation<S>& equation);

}  // namespace tubesight::core::tracking
