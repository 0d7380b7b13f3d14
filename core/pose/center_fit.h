#pragma once

#include <array>

#include "core/base/transform.h"
#include "core/pose/plane_points.h"
#include "core/pose/point_pair.h"
#include "core/pose/pose_kinds.h"
#include "core/pose/pose_model.h"
#include "core/pose/projected_center.h"
#include "core/pose/rim_bundle.h"

namespace tubesight::core::pose {

/// Scratch memory of fit_centers().
struct CenterFitWorkspace {
  std::array<SeenCircle, kMaxTubesInView> circles;
  std::array<double, kMaxTubesInView> sigma;      ///< of the centres, plane at unit distance
  std::array<std::int32_t, kMaxTubesInView> rim;  ///< the rim of each circle
  std::size_t count = 0;
  PointPairList pairs;
  std::array<std::int32_t, kMaxTubesInView> pair_circle;  ///< the circle of each pair
};

/// Fits the pose to one point a tube-end, the image of its centre by the method given (not kRims).
///
/// Ellipses by fit_ellipse(), robust; then solve_n_point(), robust. kCenters starts from the pose
/// given and repeats until the eccentricities stand still: each round's error is some hundredth of
/// the one before. The radius that an eccentricity is computed from is the ellipse's own, as edges
/// bloom and bores vary. Not solved with fewer than three centres, and for the constructions with
/// tube-ends that have too few neighbours in the picture.
///
/// The result's rms_px is of the centres; its covariance is scaled by the residuals where there are
/// more centres than needed. `points` must hold the points of `rims`.
[[nodiscard]] RimFit fit_centers(const PoseModel& model, const picture::RimList& rims,
                                 const Transform<frames::Camera, frames::Sheet>& start,
                                 PoseMethod method, PlanePointBuffer& points,
                                 CenterFitWorkspace& workspace);

}  // namespace tubesight::core::pose
