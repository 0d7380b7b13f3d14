#include "core/tracking/sheet_pose.h"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class SheetPoseMove : public ::testing::Test {};
TYPED_TEST_SUITE(SheetPoseMove, Scalars);

template <typename S>
Eigen::Matrix3d axes(const SheetPose<S>& pose) {
  Eigen::Matrix3d R;
  R.col(0) = vector(pose.x_axis);
  R.col(1) = vector(pose.y_axis);
  R.col(2) = vector(pose.normal);
  return R;
}

template <typename S>
SheetPose<S> some_pose() {
  const Eigen::Matrix3d R = rotation_deg(30.0, -20.0, 50.0);
  SheetPose<S> pose;
  pose.x_axis = vector3<Unit<S>>(R.col(0));
  pose.y_axis = vector3<Unit<S>>(R.col(1));
  pose.normal = vector3<Unit<S>>(R.col(2));
  pose.origin = {Mm<S>(10.0), Mm<S>(-20.0), Mm<S>(150.0)};
  return pose;
}

TYPED_TEST(SheetPoseMove, TurnsAsEigensAngleAxisDoes) {
  // The rotation is exact to second order: what is left of the angle's cube over six, 2e-7 at 0.01.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const double angle : {0.0001, 0.001, 0.01, 0.1, 0.3}) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d turn =
          Eigen::Vector3d(any(random), any(random), any(random)).normalized() * angle;
      SheetPose<TypeParam> pose = some_pose<TypeParam>();
      const Eigen::Matrix3d before = axes(pose);

      move<TypeParam>(pose, vector3<Mm<TypeParam>>(turn), {});

      const Eigen::Matrix3d expected =
          Eigen::AngleAxisd(angle, turn.normalized()).toRotationMatrix() * before;
      const double cubic = angle * angle * angle / 3.0;
      EXPECT_LT((axes(pose) - expected).cwiseAbs().maxCoeff(),
                cubic + bound<TypeParam>(1e-12, 1e-6, 1.5e-6))
          << "angle " << angle << ", trial " << i;
    }
  }
}

TYPED_TEST(SheetPoseMove, KeepsTheAxesOrthonormalOverThousandsOfMoves) {
  SheetPose<TypeParam> pose = some_pose<TypeParam>();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  const double limit = bound<TypeParam>(1e-8, 1e-6, 1e-8);
  for (int i = 0; i < 3000; ++i) {
    move<TypeParam>(
        pose, vector3<Mm<TypeParam>>(Eigen::Vector3d(any(random), any(random), any(random))), {});
    const Eigen::Matrix3d R = axes(pose);
    ASSERT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), limit) << i;
    ASSERT_GT(R.determinant(), 0.0) << i;
  }
}

TYPED_TEST(SheetPoseMove, IsOrthonormalAfterTheLargestTurn) {
  for (const auto& turn : {Eigen::Vector3d(0.3, 0, 0), Eigen::Vector3d(0, -0.3, 0),
                           Eigen::Vector3d(0.17, 0.17, -0.17)}) {
    SheetPose<TypeParam> pose = some_pose<TypeParam>();
    move<TypeParam>(pose, vector3<Mm<TypeParam>>(turn), {});
    const Eigen::Matrix3d R = axes(pose);
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
              bound<TypeParam>(1e-7, 1e-6, 1e-7));
  }
}

TYPED_TEST(SheetPoseMove, TurnsAboutTheAnchorAndShiftsIt) {
  SheetPose<TypeParam> pose = some_pose<TypeParam>();
  using M = Mm<TypeParam>;

  move<TypeParam>(pose, {M(0.01), M(-0.02), M(0.03)}, {M(1.5), M(-2.25), M(0.125)});

  EXPECT_EQ(number(pose.origin.x), 11.5);
  EXPECT_EQ(number(pose.origin.y), -22.25);
  EXPECT_EQ(number(pose.origin.z), 150.125);
}

TYPED_TEST(SheetPoseMove, OfNothingChangesNothing) {
  SheetPose<TypeParam> pose = some_pose<TypeParam>();
  const Eigen::Matrix3d before = axes(pose);
  move<TypeParam>(pose, {}, {});
  EXPECT_LT((axes(pose) - before).cwiseAbs().maxCoeff(), bound<TypeParam>(1e-15, 3e-7, 4e-9));
}

TYPED_TEST(SheetPoseMove, AlongWritesAVectorOfThePlaneInTheCameraFrame) {
  const SheetPose<TypeParam> pose = some_pose<TypeParam>();
  const Eigen::Matrix3d R = rotation_deg(30.0, -20.0, 50.0);

  const auto v = pose.along({Mm<TypeParam>(100.0), Mm<TypeParam>(-40.0)});

  const Eigen::Vector3d expected = 100.0 * R.col(0) - 40.0 * R.col(1);
  EXPECT_LT((vector(v) - expected).norm(), bound<TypeParam>(1e-12, 2e-5, 2e-6));
}

}  // namespace
}  // namespace tubesight::core::tracking
