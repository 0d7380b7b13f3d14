#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/base/transform.h"

namespace tubesight::core::calibration {

/// Pairs that one base calibration takes: "hundreds of local points" [Fallon sec. 5.3].
inline constexpr std::int32_t kMaxPairs = 256;

/// The tool's pose at rest, by the robot's kinematics and by vision (or docking).
struct BasePair {
  Transform<frames::Base, frames::Tool> T_base_tool;
  Transform<frames::Sheet, frames::Tool> T_sheet_tool;
  bool turned = true;  ///< both rotations are known; else the position alone
  bool use = true;     ///< false: compared, not fitted
  /// One sigma of T_sheet_tool's position by vision, along the sheet's axes; 0: not told.
  Eigen::Vector3d sigma_mm = Eigen::Vector3d::Zero();
};

using BasePairs = StaticVector<BasePair, kMaxPairs>;

/// Whether a pair comes before another in an order of their own: by all that counts in them, so
/// that equal ones may stand in either.
[[nodiscard]] bool comes_before(const BasePair& a, const BasePair& b);

/// Where the base stands, and how the tool that the robot means stands in the one that vision
/// means: T_sheet_base T_base_tool X = T_sheet_tool.
struct BasePose {
  Transform<frames::Sheet, frames::Base> T_sheet_base;
  Eigen::Matrix3d X = Eigen::Matrix3d::Identity();
};

/// What is known beforehand.
struct BaseKnowledge {
  bool level = false;        ///< the base's z axis is square to the sheet, up or down
  bool tool_known = false;   ///< X does not turn about the tool's z axis
  bool places_only = false;  ///< rotations are not believed
};

}  // namespace tubesight::core::calibration
