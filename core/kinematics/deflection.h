#pragma once

#include <array>

#include <Eigen/Core>

#include "core/base/frames.h"
#include "core/base/transform.h"
#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// How an arm and what it stands on give way. A value of 0 means stiff.
struct Flexibility {
  double support_rad_per_nm = 0.0;      ///< support and base, about any axis through the base
  JointVector joint_rad_per_nm{};       ///< each joint about its axis: gear and shaft
  JointVector connection_rad_per_nm{};  ///< each joint across its axis: bearing and flange
  JointVector link_bend_per_nm2{};      ///< 1 / (E I) of each link as a beam, in 1/(N m²)
  JointVector link_twist_per_nm2{};     ///< 1 / (G J) of each link as a shaft, in 1/(N m²)
};

/// What pulls at an arm.
struct Load {
  JointVector link_mass_kg{};                           ///< each link's, in its middle
  double tool_mass_kg = 0.0;                            ///< toolhead with what it carries
  std::array<double, 3> tool_center_mm{};               ///< its centre of mass, tool frame
  std::array<double, 3> gravity_m_s2{0.0, 0.0, -9.81};  ///< base frame
  std::array<double, 3> tip_force_n{};  ///< on the tip, base frame: docked, the sheet pushes back
};

/// A small movement of the tool: the tip's way and a turn about axes of the base frame.
struct Deflection {
  Eigen::Vector3d shift_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
};

/// How far the load moves the tool from where stiff links would hold it, to first order.
///
/// The moment in each place comes from the stiff arm's shape. Support and joints turn in
/// proportion to it; each link is a beam held at its near end and bent by the moment and the force
/// at its far end (slope M l / EI + F l² / 2 EI, sag M l² / 2 EI + F l³ / 3 EI), and twisted by the
/// moment along it. Shear and stretching are left out: an aluminium tube of a metre with 1000 mm²
/// of wall stretches by 0.0014 mm under 100 N, and bends a hundred times that.
[[nodiscard]] Deflection deflection(const SerialArm& arm, const JointVector& angles_rad,
                                    const Flexibility& flexibility, const Load& load);

/// The pose after the deflection. For turns up to 0.1 rad the rotation is right to 1e-4 rad.
[[nodiscard]] Transform<frames::Base, frames::Tool> deflected(
    const Transform<frames::Base, frames::Tool>& T_base_tool, const Deflection& deflection);

/// The rotation of a small turn, exactly orthogonal: to third order the one by the vector's length.
[[nodiscard]] Eigen::Matrix3d small_turn(const Eigen::Vector3d& turn_rad);

}  // namespace tubesight::core::kinematics
