#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"
#include "core/kinematics/installed_arm.h"
#include "core/kinematics/joint_drive.h"

namespace tubesight::core::kinematics {

/// How far a pose is off from what is believed: p_true = T p_believed.
struct PoseError {
  std::array<double, 3> position_mm{};
  std::array<double, 3> rotation_deg{};  ///< alpha, beta, gamma: R = Rz(alpha) Ry(beta) Rx(gamma)
};

/// How far a link's numbers are off: true less believed.
struct LinkError {
  double a_mm = 0.0;        ///< length
  double d_mm = 0.0;        ///< offset
  double twist_rad = 0.0;   ///< between its two joint axes
  double offset_rad = 0.0;  ///< the joint's zero: true angle less reading
};

/// What is wrong with a robot's idea of itself, item by item as the source lists it
/// [Fallon sec. 1.1]. Rotations are about the believed frame's axes.
struct ArmErrors {
  PoseError base;  ///< 1: pose of the robot's base on its support, base frame
  std::array<LinkError, static_cast<std::size_t>(kMaxJoints)> links{};  ///< 2 and 3
  JointDriveSettings drive{};  ///< 3: what the joints' readings do not show
  PoseError tool;              ///< 4: dimensions of the tool, frame behind the last joint
  PoseError workpiece;         ///< 5: pose of the tubesheet, sheet frame
  PoseError support;  ///< 6: the way from the sheet round the bowl to the support, sheet frame
  Flexibility flexibility{};  ///< 7: true less believed; may be negative
  double tool_mass_kg = 0.0;  ///< 7: true less believed
};

/// One standard deviation of each error, except where a plain size is named.
struct ErrorMagnitudes {
  double base_mm = 0.0;         ///< in each axis
  double base_deg = 0.0;        ///< about each axis
  double length_mm = 0.0;       ///< a and d of each link
  double twist_deg = 0.0;       ///< of each link
  double zero_deg = 0.0;        ///< of each joint
  double resolution_deg = 0.0;  ///< size: step of each reading
  double backlash_deg = 0.0;    ///< size: of each joint
  double tool_mm = 0.0;
  double tool_deg = 0.0;
  double workpiece_mm = 0.0;
  double workpiece_deg = 0.0;
  double support_mm = 0.0;
  double support_deg = 0.0;
  double flexibility_share = 0.0;  ///< of each believed value
  double tool_mass_share = 0.0;    ///< of the believed mass
};

/// An arm measured part by part and just installed: its base is where the drawings say, roughly.
[[nodiscard]] ErrorMagnitudes installed_magnitudes();

/// The same after its base was calibrated by docking [Fallon sec. 5.3: then typically within 5 mm
/// over the whole generator].
[[nodiscard]] ErrorMagnitudes calibrated_magnitudes();

/// How a Cobra-like arm gives way, for use with cobra_arm(): some 7 mm at full reach.
[[nodiscard]] Flexibility cobra_flexibility();

/// What a Cobra-like arm carries: links of 50 kg in all [Fallon sec. 1.1.2] and a toolhead.
[[nodiscard]] Load cobra_load();

/// Errors of these magnitudes, the same ones for the same seed. Each normal number is a sum of
/// twelve uniform ones, so at most six standard deviations.
[[nodiscard]] ArmErrors draw_errors(const ErrorMagnitudes& magnitudes, const InstalledArm& believed,
                                    std::uint64_t seed);

/// The arm that is, from the arm that is believed. kInvalidArgument: a number is not finite.
[[nodiscard]] Result<InstalledArm> true_arm(const InstalledArm& believed, const ArmErrors& errors);

}  // namespace tubesight::core::kinematics
