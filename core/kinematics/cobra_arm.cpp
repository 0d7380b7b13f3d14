#include "core/kinematics/cobra_arm.h"

#include "core/base/assert.h"
#include "core/base/trigonometry.h"

namespace tubesight::core::kinematics {

SerialArm cobra_arm() {
  const auto deg = [](double angle_deg) { return radians(angle_deg); };
  const Link links[] = {
      {0.0, 250.0, deg(90.0), 0.0, deg(-175.0), deg(175.0)},
      {1000.0, 0.0, 0.0, 0.0, deg(-30.0), deg(150.0)},
      {940.0, 0.0, 0.0, 0.0, deg(-155.0), deg(155.0)},
      {0.0, 0.0, deg(90.0), 0.0, deg(-200.0), deg(200.0)},
      {0.0, 0.0, deg(90.0), deg(90.0), deg(-60.0), deg(60.0)},
      {0.0, 150.0, 0.0, deg(90.0), deg(-270.0), deg(270.0)},
  };
  const auto arm =
      SerialArm::make(links, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, 180.0)});
  TUBESIGHT_ASSERT(arm.has_value());
  return *arm;
}

JointVector cobra_ready() {
  return {0.0, radians(75.0), radians(-105.0), radians(120.0), 0.0, 0.0, 0.0, 0.0};
}

}  // namespace tubesight::core::kinematics
