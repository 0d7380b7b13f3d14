#pragma once

#include <cstdint>

#include "core/base/static_vector.h"
#include "core/picture/rim.h"
#include "core/pose/planar_pose.h"
#include "core/pose/plane_points.h"
#include "core/pose/point_pair.h"
#include "core/pose/pose_kinds.h"
#include "core/pose/pose_model.h"
#include "core/pose/projected_center.h"

namespace tubesight::core::pose {

/// Closed-form poses of one picture, the best first.
struct PoseSeeds {
  StaticVector<SeenCircle, kMaxTubesInView> circles;  ///< the ellipses, one a pair
  PointPairList pairs;                                ///< ellipses' centres; sigma of 0.1 px
  StaticVector<PoseCandidate, 12> candidates;
};

/// Proposes poses from the centres of the rims' ellipses as they are, which is right to some tenths
/// of a millimetre: both solutions of the planar closed form, or for three tube-ends (or more, all
/// but one on a line) those of three points [Fallon 5.2.1], and those in the planes that
/// their ellipses lie in.
///
/// kTooFewTubes: fewer rims than `min_tubes` are ellipses; kCollinear: their centres lie on one
/// line; kAddressesContradict: no pose shows three tube-ends where the rims are.
[[nodiscard]] PoseRefusal find_seeds(const PoseModel& model, const picture::RimList& rims,
                                     std::int32_t min_tubes, PlanePointBuffer& points,
                                     PoseSeeds& seeds);

}  // namespace tubesight::core::pose
