#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/edges/dynamic_threshold.h"
#include "core/tracking/rim_outline.h"
#include "core/tracking/rim_search.h"

namespace tubesight::core::tracking {

/// How a look at a predicted tube-end ended.
enum class Finding : std::uint8_t {
  kMeasured,   ///< its centre is known
  kBright,     ///< no dark inside where it should be: sheet, flush plug, glare
  kDisagrees,  ///< dark inside, but no rim of the right size and shape around it
  kOutside,    ///< too near to the border of the picture or too small
};

/// A tube-end measured in one field.
template <Scalar S>
struct TubeMeasurement {
  TubeAddress address{};
  Vector2<Mm<S>> local{};         ///< its centre on the sheet, mm from the pose's anchor
  Vector2<Px<S>> predicted_px{};  ///< image of its centre by the predicted pose
  Vector2<Px<S>> center_px{};     ///< image of its centre as measured
  Mm<S> information_uu{};         ///< inverse covariance of the centre, in units of one edge's
  Mm<S> information_uv{};
  Mm<S> information_vv{};
  std::int32_t edges = 0;        ///< rim points used, of kRimPoints
  std::int32_t contrast_q4 = 0;  ///< mean from dark to bright, 1/16 grey level
  Px<S> rms_px{};                ///< of the rim points' distances along their searches
  Px<S> growth_px{};             ///< rim radius beyond the predicted one, per 32 px
  bool used = true;              ///< kept in the pose fit
};

/// Measures the centre of the tube-end whose rim is predicted by `rim`.
///
/// At kRimPoints points of the predicted rim the field is searched outwards across the rim, along
/// its line or column, whichever crosses it better. The shift of the tube-end and the growth of its
/// rim follow from the distances by least squares, with outliers left out. As the predicted rim is
/// the true image of a circle about the predicted centre, the shift applies to that centre: the
/// bias of an ellipse's centre does not arise.
///
/// `result.predicted_px` is read; the rest is written. About 10,000 instructions.
template <Scalar S>
[[nodiscard]] Finding measure_tube(const FieldView& field, const RimOutline<S>& rim,
                                   const MeasurementBounds& bounds,
                                   edges::DynamicThreshold& threshold, TubeMeasurement<S>& result);

}  // namespace tubesight::core::tracking
