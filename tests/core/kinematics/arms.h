#pragma once

#include <random>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// Two links of 1000 and 500 mm in a plane, tip at the end of the second.
inline SerialArm planar_arm() {
  const Link links[] = {{1000.0, 0.0, 0.0, 0.0, -7.0, 7.0}, {500.0, 0.0, 0.0, 0.0, -7.0, 7.0}};
  const auto arm = SerialArm::make(links, {});
  EXPECT_TRUE(arm);
  return arm.value_or({});
}

/// As many joints as there may be, none parallel to the next.
inline SerialArm eight_joints() {
  Link links[8];
  for (int i = 0; i < 8; ++i) {
    links[i] = {200.0 - 10.0 * i, 30.0 * i, radians(i % 2 == 0 ? 80.0 : -95.0), 0.1 * i, -2.0, 2.0};
  }
  const auto arm = SerialArm::make(
      links, {rotation_from_degrees({10.0, 20.0, 30.0}), Eigen::Vector3d(5.0, 60.0, 70.0)});
  EXPECT_TRUE(arm);
  return arm.value_or({});
}

/// Joint angles anywhere within the limits.
inline JointVector anywhere(const SerialArm& arm, std::mt19937& random) {
  JointVector angles{};
  for (std::size_t i = 0; i < arm.links().size(); ++i) {
    angles[i] = std::uniform_real_distribution<double>(arm.links()[i].lowest_rad,
                                                       arm.links()[i].highest_rad)(random);
  }
  return angles;
}

}  // namespace tubesight::core::kinematics
