#include "core/kinematics/serial_arm.h"

#include <cmath>

#include "core/base/trigonometry.h"

namespace tubesight::core::kinematics {
namespace {

std::size_t at(std::int32_t joint) { return static_cast<std::size_t>(joint); }

Transform<LinkFrame, LinkFrame> across(const Link& link, double angle_rad) {
  const auto [st, ct] = sine_cosine(angle_rad + link.offset_rad);
  const auto [sa, ca] = sine_cosine(link.twist_rad);
  Eigen::Matrix3d rotation;
  rotation << ct, -st * ca, st * sa,  //
      st, ct * ca, -ct * sa,          //
      0.0, sa, ca;
  return {rotation, Eigen::Vector3d(link.a_mm * ct, link.a_mm * st, link.d_mm)};
}

// Eigen's cross() would need <Eigen/Geometry>, which compiles three times as long.
Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

}  // namespace

Result<SerialArm> SerialArm::make(std::span<const Link> links,
                                  const Transform<LinkFrame, frames::Tool>& T_last_tool) {
  SerialArm arm;
  bool good = !links.empty() && T_last_tool.rotation().allFinite() &&
              T_last_tool.translation_mm().allFinite();
  for (const Link& link : links) {
    good = good && std::isfinite(link.a_mm) && std::isfinite(link.d_mm) &&
           std::abs(link.twist_rad) <= 100.0 && std::abs(link.offset_rad) <= 100.0 &&
           link.lowest_rad >= -100.0 && link.highest_rad <= 100.0 &&
           link.lowest_rad <= link.highest_rad && arm.links_.try_push_back(link);
  }
  if (!good) {
    return Unexpected(Error::kInvalidArgument);
  }
  arm.T_last_tool_ = T_last_tool;
  return arm;
}

LinkFrames SerialArm::link_frames(const JointVector& angles_rad) const {
  LinkFrames frames;
  for (std::int32_t i = 0; i < joints(); ++i) {
    frames[at(i + 1)] = frames[at(i)] * across(links_[i], angles_rad[at(i)]);
  }
  return frames;
}

Transform<frames::Base, frames::Tool> SerialArm::forward(const JointVector& angles_rad) const {
  return link_frames(angles_rad)[at(joints())] * T_last_tool_;
}

ArmJacobian SerialArm::jacobian(const JointVector& angles_rad) const {
  const LinkFrames frames = link_frames(angles_rad);
  const Eigen::Vector3d tip = frames[at(joints())] * T_last_tool_.translation_mm();
  ArmJacobian J = ArmJacobian::Zero();
  for (std::int32_t i = 0; i < joints(); ++i) {
    const Eigen::Vector3d axis = frames[at(i)].rotation().col(2);
    J.block<3, 1>(0, i) = cross(axis, tip - frames[at(i)].translation_mm());
    J.block<3, 1>(3, i) = axis;
  }
  return J;
}

bool SerialArm::within_limits(const JointVector& angles_rad) const {
  for (std::int32_t i = 0; i < joints(); ++i) {
    const double angle = angles_rad[at(i)];
    if (!(angle >= links_[i].lowest_rad && angle <= links_[i].highest_rad)) {
      return false;
    }
  }
  return true;
}

JointVector SerialArm::limited(JointVector angles_rad) const {
  for (std::int32_t i = 0; i < kMaxJoints; ++i) {
    double& angle = angles_rad[at(i)];
    if (i >= joints()) {
      angle = 0.0;
    } else if (!(angle >= links_[i].lowest_rad)) {
      angle = links_[i].lowest_rad;
    } else if (angle > links_[i].highest_rad) {
      angle = links_[i].highest_rad;
    }
  }
  return angles_rad;
}

}  // namespace tubesight::core::kinematics
