#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/base/sighting.h"
#include "core/base/static_vector.h"

namespace tubesight::core::pose {

/// A point of the object and where the picture shows it.
struct PointPair {
  Eigen::Vector3d object_mm = Eigen::Vector3d::Zero();  ///< sheet frame; z = 0 on a tubesheet
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();      ///< ideal image plane at unit distance
  double sigma = 1e-4;  ///< standard deviation on that plane, each direction
};

/// One pair a tube-end.
using PointPairList = StaticVector<PointPair, kMaxTubesInView>;

}  // namespace tubesight::core::pose
