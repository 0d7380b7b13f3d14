#pragma once

#include "core/base/frames.h"
#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/kinematics/deflection.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// An arm as it stands below a tubesheet: its geometry, its place, and how it gives way.
///
/// One of these is what the robot believes, another what is true; arm_errors.h makes the second
/// from the first.
struct InstalledArm {
  SerialArm arm;
  Transform<frames::Sheet, frames::Base> T_sheet_base;
  Flexibility flexibility{};  ///< believed: what the controller compensates; all 0: nothing
  Load load{};
};

/// T_sheet_tool where the links stand at these angles, deflection included.
[[nodiscard]] Transform<frames::Sheet, frames::Tool> tool_pose(const InstalledArm& installed,
                                                               const JointVector& angles_rad);

/// Joint angles that put the tool at a pose, deflection included: inverse() on the stiff arm,
/// repeated with the deflection taken off the goal until that changes by less than 1e-4 mm.
///
/// Errors: as inverse(); kIllConditioned the deflection does not settle (an arm much too weak).
[[nodiscard]] Result<InverseSolution> reach(
    const InstalledArm& installed, const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
    const JointVector& start_rad, const InverseOptions& options = {});

}  // namespace tubesight::core::kinematics
