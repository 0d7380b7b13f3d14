#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/frames.h"
#include "core/base/result.h"
#include "core/base/static_vector.h"
#include "core/base/transform.h"

namespace tubesight::core::kinematics {

/// Joints that an arm may have.
inline constexpr std::int32_t kMaxJoints = 8;

/// One number a joint, in radians where angles are meant; those beyond an arm's joints are 0.
using JointVector = std::array<double, static_cast<std::size_t>(kMaxJoints)>;

/// The frame of whichever link of an arm; inside core/kinematics only.
struct LinkFrame {};

/// One revolute joint and the link that it turns, by the standard convention of Denavit and
/// Hartenberg [Siciliano2009 sec. 2.8.2]: A = Rz(theta) Tz(d) Tx(a) Rx(twist), theta = joint angle
/// + offset. The joint turns about the z axis of the frame before.
struct Link {
  double a_mm = 0.0;        ///< length of the common normal
  double d_mm = 0.0;        ///< offset along the joint's axis
  double twist_rad = 0.0;   ///< from this joint's axis to the next one's, about the normal
  double offset_rad = 0.0;  ///< theta where the joint reads 0
  double lowest_rad = 0.0;  ///< limits of the joint's angle
  double highest_rad = 0.0;
};

/// How the tip moves with the joints: rows 0-2 mm, rows 3-5 radians, both in the base frame, for a
/// radian of each joint. Columns beyond the arm's joints are 0.
using ArmJacobian = Eigen::Matrix<double, 6, kMaxJoints>;

/// Where all frames of an arm stand: that of the base, then one behind each joint.
using LinkFrames = std::array<Transform<frames::Base, LinkFrame>, kMaxJoints + 1>;

/// A serial arm of revolute joints, perfectly stiff: geometry alone.
///
/// Only + - x /, square roots and our own sine: the same bits on every machine.
class SerialArm {
 public:
  SerialArm() = default;

  /// An arm of 1 to kMaxJoints links. `T_last_tool` says where the tool is in the frame behind the
  /// last joint. kInvalidArgument: the count, a number that is not finite, limits out of order or
  /// beyond ±100 rad.
  [[nodiscard]] static Result<SerialArm> make(
      std::span<const Link> links, const Transform<LinkFrame, frames::Tool>& T_last_tool);

  [[nodiscard]] std::int32_t joints() const { return links_.size(); }
  [[nodiscard]] std::span<const Link> links() const { return links_.view(); }
  [[nodiscard]] const Transform<LinkFrame, frames::Tool>& T_last_tool() const {
    return T_last_tool_;
  }

  /// T_base_link of each frame; entry joints() is the last that counts.
  [[nodiscard]] LinkFrames link_frames(const JointVector& angles_rad) const;

  /// T_base_tool.
  [[nodiscard]] Transform<frames::Base, frames::Tool> forward(const JointVector& angles_rad) const;

  /// The derivative of forward(); turning as a vector about the base's axes.
  [[nodiscard]] ArmJacobian jacobian(const JointVector& angles_rad) const;

  [[nodiscard]] bool within_limits(const JointVector& angles_rad) const;

  /// The angles, each moved to the nearest limit where it is beyond one.
  [[nodiscard]] JointVector limited(JointVector angles_rad) const;

 private:
  StaticVector<Link, kMaxJoints> links_;
  Transform<LinkFrame, frames::Tool> T_last_tool_;
};

}  // namespace tubesight::core::kinematics
