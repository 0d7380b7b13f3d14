#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// How a pose is to be reached.
struct InverseOptions {
  bool position_only = false;   ///< for arms that cannot choose how the tool stands
  double tolerance_mm = 1e-6;   ///< a solution is at most this far off
  double tolerance_rad = 1e-9;  ///< and turned by at most this
  std::int32_t restarts = 100;  ///< further starts within the limits when the given one leads
                                ///< nowhere; 0 where the arm must not change its configuration
};

/// Joint angles that reach a pose.
struct InverseSolution {
  JointVector angles_rad{};
  double miss_mm = 0.0;  ///< how far off the tip is
  double miss_rad = 0.0;
  std::int32_t iterations = 0;  ///< of all starts together
  std::int32_t restarts = 0;    ///< that it took
};

/// Finds joint angles within the limits that put the tool at a pose, near the angles given.
///
/// Damped least squares after Levenberg and Marquardt [Siciliano2009 sec. 3.5]: it passes through
/// singular places slowly rather than wildly. A joint at its limit is held there while the step
/// would push it further. When a start ends in a corner, others are tried, the same ones each time.
/// Which of several solutions (elbow up or down) comes out is decided by the start.
///
/// Errors: kOutOfRange no start reached the pose (out of reach, or outside the limits),
/// kInvalidArgument a number is not finite. Cost: some ten Jacobians when the start is near,
/// thousands before it gives up.
[[nodiscard]] Result<InverseSolution> inverse(
    const SerialArm& arm, const Transform<frames::Base, frames::Tool>& T_base_tool,
    const JointVector& start_rad, const InverseOptions& options = {});

/// The turn that takes `R_a` into `R_b`, as a vector about the axes of the frame that both are
/// written in: 2 sin(angle / 2) along the axis, which is the angle to first order.
[[nodiscard]] Eigen::Vector3d turn_between(const Eigen::Matrix3d& R_a, const Eigen::Matrix3d& R_b);

}  // namespace tubesight::core::kinematics
