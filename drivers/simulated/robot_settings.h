#pragma once

#include "core/kinematics/arm_errors.h"
#include "core/kinematics/installed_arm.h"
#include "core/kinematics/serial_arm.h"
#include "core/kinematics/speed_profile.h"
#include "core/kinematics/tool_path.h"

namespace tubesight::drivers {

/// A robot and what is wrong with it.
struct SimulatedRobotSettings {
  core::kinematics::InstalledArm believed;   ///< the arm as its controller knows it
  core::kinematics::ArmErrors errors{};      ///< what makes the true arm of it
  core::kinematics::JointVector near_rad{};  ///< decides elbow up or down
  core::kinematics::ToolPlace home{};        ///< where it believes its tool to be at time 0
  core::kinematics::SpeedShape shape = core::kinematics::SpeedShape::kTrapezoid;
  core::kinematics::SpeedLimits limits{};  ///< of SimulatedRobot::move_to(), mm
  double claim_period_s = 0.5;             ///< from one claim to the next; 0: none by itself
};

}  // namespace tubesight::drivers
