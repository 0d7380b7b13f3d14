#pragma once

#include "core/base/event.h"
#include "core/base/pose_result.h"

namespace tubesight::core {

/// The tool at rest, by the robot's kinematics and by vision, of one request: what the robot's base
/// is calibrated by.
struct PosePair {
  RobotPose robot;  ///< T_base_tool
  PoseResult seen;  ///< T_sheet_tool
};

}  // namespace tubesight::core
