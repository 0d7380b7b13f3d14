#include "core/base/transform.h"

#include <array>
#include <cstdint>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

using frames::Camera;
using frames::Sheet;
using frames::Tool;

constexpr double kTiny = 1e-14;

void expect_near(const Eigen::Vector3d& actual, const Eigen::Vector3d& expected, double bound) {
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), bound)
      << "actual " << actual.transpose() << ", expected " << expected.transpose();
}

TEST(RotationFromDegrees, TurnsAboutOneAxisRightHanded) {
  const Eigen::Vector3d x{1, 0, 0};
  const Eigen::Vector3d y{0, 1, 0};
  const Eigen::Vector3d z{0, 0, 1};
  expect_near(rotation_from_degrees({90, 0, 0}) * x, y, kTiny);  // about z: x to y
  expect_near(rotation_from_degrees({0, 90, 0}) * z, x, kTiny);  // about y: z to x
  expect_near(rotation_from_degrees({0, 0, 90}) * y, z, kTiny);  // about x: y to z
  expect_near(rotation_from_degrees({30, 0, 0}) * x, {0.86602540378443865, 0.5, 0}, kTiny);
}

TEST(RotationFromDegrees, AppliesGammaFirstAndAlphaLast) {
  // (0, 1, 0) about x by 90 is (0, 0, 1), about y by 90 is (1, 0, 0), about z by 90 is (0, 1, 0);
  // in the other order it would stay (-1, 0, 0) -> (0, 0, 1) -> (0, -1, 0).
  expect_near(rotation_from_degrees({90, 90, 90}) * Eigen::Vector3d{0, 1, 0}, {0, 1, 0}, kTiny);
  // Only alpha and gamma: (0, 1, 0) -> (0, 0, 1) -> unchanged; the other order gives (-1, 0, 0).
  expect_near(rotation_from_degrees({90, 0, 90}) * Eigen::Vector3d{0, 1, 0}, {0, 0, 1}, kTiny);
  // Only alpha and beta: (1, 0, 0) -> (0, 0, -1) -> unchanged; the other order gives (0, 1, 0).
  expect_near(rotation_from_degrees({90, 90, 0}) * Eigen::Vector3d{1, 0, 0}, {0, 0, -1}, kTiny);
}

TEST(RotationFromDegrees, HasTheElementsWorkedOutByHand) {
  // sin 30 = 1/2, cos 60 = 1/2, the others h = sqrt(3)/2; s, c of (a, b, g) = (30, 60, 60):
  // ca cb = h/2, -sb = -h, cb sg = h/2, cb cg = 1/4, sa cb = 1/4,
  // ca sb sg - sa cg = h^3 - 1/4, sa sb sg + ca cg = h^2/2 + h/2.
  const Eigen::Matrix3d R = rotation_from_degrees({30, 60, 60});
  const double h = 0.86602540378443865;
  EXPECT_NEAR(R(0, 0), h / 2, kTiny);
  EXPECT_NEAR(R(1, 0), 0.25, kTiny);
  EXPECT_NEAR(R(2, 0), -h, kTiny);
  EXPECT_NEAR(R(0, 1), 0.75 * h - 0.25, kTiny);
  EXPECT_NEAR(R(1, 1), 0.375 + h / 2, kTiny);
  EXPECT_NEAR(R(2, 1), h / 2, kTiny);
  EXPECT_NEAR(R(2, 2), 0.25, kTiny);
}

TEST(Transform, MovesAPointByHandValues) {
  // A quarter turn about z, then (10, 20, 30): (1, 2, 3) -> (-2, 1, 3) -> (8, 21, 33).
  const Transform<Camera, Tool> T_camera_tool(rotation_from_degrees({90, 0, 0}), {10, 20, 30});
  expect_near(T_camera_tool * Eigen::Vector3d{1, 2, 3}, {8, 21, 33}, 1e-13);
  expect_near(T_camera_tool.inverse() * Eigen::Vector3d{8, 21, 33}, {1, 2, 3}, 1e-13);
}

TEST(Transform, IsTheIdentityByDefault) {
  const Transform<Camera, Tool> T_camera_tool;
  expect_near(T_camera_tool * Eigen::Vector3d{1, 2, 3}, {1, 2, 3}, 0.0);
}

TEST(Transform, ChainsActLikeOneAfterTheOther) {
  // (1, 2, 3) in the sheet: x by 90 -> (1, -3, 2) + (0, 0, 5) = (1, -3, 7) in the tool;
  // z by 90 -> (3, 1, 7) + (10, 20, 30) = (13, 21, 37) in the camera.
  const Transform<Camera, Tool> T_camera_tool(rotation_from_degrees({90, 0, 0}), {10, 20, 30});
  const Transform<Tool, Sheet> T_tool_sheet(rotation_from_degrees({0, 0, 90}), {0, 0, 5});
  const Transform<Camera, Sheet> T_camera_sheet = T_camera_tool * T_tool_sheet;
  expect_near(T_camera_sheet * Eigen::Vector3d{1, 2, 3}, {13, 21, 37}, 1e-13);
}

TEST(Transform, TimesItsInverseIsTheIdentity) {
  constexpr std::uint32_t kSeed = 7;
  std::mt19937 random(kSeed);
  const auto uniform = [&random](double bound) {
    return bound * (static_cast<double>(random()) / 2147483648.0 - 1.0);
  };
  for (int i = 0; i < 500; ++i) {
    const std::array<double, 3> angles_deg{uniform(360), uniform(360), uniform(360)};
    const Transform<Camera, Tool> T_camera_tool(rotation_from_degrees(angles_deg),
                                                {uniform(1000), uniform(1000), uniform(1000)});
    const Transform<Camera, Camera> one = T_camera_tool * T_camera_tool.inverse();
    const Eigen::Matrix3d& R = T_camera_tool.rotation();
    ASSERT_LE((one.rotation() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14)
        << "seed " << kSeed << " round " << i;
    ASSERT_LE(one.translation_mm().cwiseAbs().maxCoeff(), 1e-11) << "seed " << kSeed;
    ASSERT_NEAR(R.col(0).cross(R.col(1)).dot(R.col(2)), 1.0, 1e-14) << "not right-handed";
  }
}

}  // namespace
}  // namespace tubesight::core
