#pragma once

#include <array>
#include <optional>

#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Points of a rim where the picture is searched for its edge: as many chord ends as pay; see
/// docs/performance.md for the centres' errors and the cost with other numbers. A multiple of four.
inline constexpr int kRimPoints = 8;

/// The spokes of a tube-end: from its centre to kRimPoints points of its rim, camera frame. The
/// same for all tube-ends of one pose.
template <Scalar S>
using RimSpokes = std::array<Vector3<Mm<S>>, kRimPoints>;

/// The spokes for rims of a radius in mm (up to 100).
template <Scalar S>
[[nodiscard]] RimSpokes<S> make_rim_spokes(const SheetPose<S>& pose, Mm<S> radius_mm);

/// The image of a tube-end's rim, full-frame pixels: kRimPoints of its points, projected through
/// perspective and lens, in the order of their angles.
template <Scalar S>
struct RimOutline {
  std::array<Vector2<Px<S>>, kRimPoints> points{};
  Vector2<Px<S>> center{};       ///< image of the tube-end's centre
  Vector2<Px<S>> middle{};       ///< mean of the points: near the outline's own centre
  Vector2<Px<S>> half_extent{};  ///< half the bounding box of the points: within 8 % of the rim's

  /// The tangent at a point, px per rad: the chord between its neighbours, which is exact for an
  /// ellipse and within 1 % for rims.
  [[nodiscard]] Vector2<Px<S>> tangent(int index) const;
};

/// Projects the rim of the tube-end at `center` (camera frame, mm). Empty when part of it cannot be
/// projected or falls more than two pixels outside the search window, which a prediction may be
/// off. Some 4,000 instructions, fewer for a rim outside.
template <Scalar S>
[[nodiscard]] std::optional<RimOutline<S>> project_rim(const TrackingModel<S>& model,
                                                       const Vector3<Mm<S>>& center,
                                                       const RimSpokes<S>& spokes);

}  // namespace tubesight::core::tracking
