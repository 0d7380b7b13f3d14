#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/math/rotation.h"
#include "core/pose/four_point.h"
#include "core/pose/n_point.h"
#include "core/pose/planar_pose.h"
#include "core/pose/three_point.h"
#include "tests/support/synthetic_rims.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

CameraSheet leaning() {
  return {rotation_from_degrees({35.0, -4.0, 47.0}), Eigen::Vector3d(-20.0, 15.0, 170.0)};
}

std::vector<PointPair> pairs_of(const CameraSheet& T, const std::vector<Eigen::Vector3d>& object,
                                double noise = 0.0, std::uint64_t seed = 1) {
  tests::Deviates deviates(seed);
  std::vector<PointPair> pairs;
  for (const Eigen::Vector3d& point : object) {
    const Eigen::Vector3d p = T * point;
    const Eigen::Vector2d off(noise * deviates.normal(), noise * deviates.normal());
    pairs.push_back(
        {point, Eigen::Vector2d(p.x() / p.z(), p.y() / p.z()) + off, std::max(noise, 1e-6)});
  }
  return pairs;
}

std::vector<Eigen::Vector3d> lattice(int half) {
  std::vector<Eigen::Vector3d> points;
  for (int row = -half; row <= half; ++row) {
    for (int column = -half; column <= half; ++column) {
      points.emplace_back(25.4 * column, 25.4 * row, 0.0);
    }
  }
  return points;
}

double distance(const CameraSheet& a, const CameraSheet& b) {
  return (a.translation_mm() - b.translation_mm()).norm() + (a.rotation() - b.rotation()).norm();
}

TEST(SolveRayLengths, SatisfiesTheLawsOfCosinesAndFindsTheTruth) {
  tests::Deviates deviates(11);
  for (int round = 0; round < 200; ++round) {
    std::array<Eigen::Vector3d, 3> points;
    for (Eigen::Vector3d& point : points) {
      point = {40.0 * deviates.normal(), 40.0 * deviates.normal(),
               150.0 + 20.0 * deviates.normal()};
    }
    const std::array<Eigen::Vector3d, 3> rays = {points[0].normalized(), points[1].normalized(),
                                                 points[2].normalized()};
    const std::array<double, 3> sides = {(points[0] - points[1]).norm(),
                                         (points[0] - points[2]).norm(),
                                         (points[1] - points[2]).norm()};

    const auto solutions = solve_ray_lengths(rays, sides);

    const RayLengths truth(points[0].norm(), points[1].norm(), points[2].norm());
    double nearest = 1e9;
    for (const RayLengths& x : solutions) {
      nearest = std::min(nearest, (x - truth).norm());
      EXPECT_NEAR((x(0) * rays[0] - x(1) * rays[1]).norm(), sides[0], 1e-7);
      EXPECT_NEAR((x(0) * rays[0] - x(2) * rays[2]).norm(), sides[1], 1e-7);
      EXPECT_NEAR((x(1) * rays[1] - x(2) * rays[2]).norm(), sides[2], 1e-7);
    }
    EXPECT_LE(solutions.size(), 4);
    EXPECT_LT(nearest, 1e-5) << "round " << round;
  }
}

TEST(SolveRayLengths, FindsAllFourOfASymmetricPyramid) {
  // Fischler and Bolles' example: an equilateral triangle of 2 sqrt(3), legs of 4 (1981, fig. 5).
  const double side = 2.0 * std::sqrt(3.0);
  const std::array<Eigen::Vector3d, 3> corners = {
      Eigen::Vector3d(2.0, 0.0, std::sqrt(12.0)),
      Eigen::Vector3d(-1.0, std::sqrt(3.0), std::sqrt(12.0)),
      Eigen::Vector3d(-1.0, -std::sqrt(3.0), std::sqrt(12.0))};
  const std::array<Eigen::Vector3d, 3> rays = {corners[0] / 4.0, corners[1] / 4.0,
                                               corners[2] / 4.0};

  const auto solutions = solve_ray_lengths(rays, {side, side, side});

  ASSERT_EQ(solutions.size(), 4);
  int equal = 0;
  int short_legs = 0;
  for (const RayLengths& x : solutions) {
    equal += (x - RayLengths(4, 4, 4)).norm() < 1e-6 ? 1 : 0;
    short_legs += std::abs(x.minCoeff() - 1.0) < 1e-6 && std::abs(x.sum() - 9.0) < 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(equal, 1);
  EXPECT_EQ(short_legs, 3);
}

TEST(SolveThreePoints, GivesPosesThatShowThePointsWhereTheyAre) {
  const std::vector<PointPair> pairs =
      pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}, {0.0, 25.4, 0.0}});

  const auto poses = solve_three_points({pairs[0], pairs[1], pairs[2]});

  ASSERT_GE(poses.size(), 1);
  double nearest = 1e9;
  for (const CameraSheet& T : poses) {
    nearest = std::min(nearest, distance(T, leaning()));
    EXPECT_LT(plane_rms(T, pairs), 1e-9);
    EXPECT_NEAR(T.rotation().determinant(), 1.0, 1e-12);
  }
  EXPECT_LT(nearest, 1e-6);
}

TEST(SolveThreePoints, FindsNothingOnALine) {
  const std::vector<PointPair> pairs =
      pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}, {50.8, 0.0, 0.0}});

  EXPECT_TRUE(solve_three_points({pairs[0], pairs[1], pairs[2]}).empty());
}

TEST(SolveFourPoints, FindsTheSquareOfTheSource) {
  const std::vector<PointPair> pairs =
      pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}, {25.4, 25.4, 0.0}, {0.0, 25.4, 0.0}});

  const auto pose = solve_four_points({pairs[0], pairs[1], pairs[2], pairs[3]});

  ASSERT_TRUE(pose.has_value());
  EXPECT_LT(distance(pose->T_camera_sheet, leaning()), 1e-6);
  EXPECT_LT(pose->objective_mm2, 1e-16);
  EXPECT_NEAR(pose->lengths_mm(0), leaning().translation_mm().norm(), 1e-6);
}

TEST(SolveFourPoints, RefusesFourOnALine) {
  const std::vector<PointPair> pairs =
      pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}, {50.8, 0.0, 0.0}, {76.2, 0.0, 0.0}});

  EXPECT_FALSE(solve_four_points({pairs[0], pairs[1], pairs[2], pairs[3]}).has_value());
}

TEST(PlanarPoses, PutsTheTrueOneFirstAndItsMirrorSecond) {
  const std::vector<PointPair> pairs = pairs_of(leaning(), lattice(1));

  const auto poses = planar_poses(pairs);

  ASSERT_TRUE(poses.has_value());
  EXPECT_LT(distance(poses->candidates[0].T_camera_sheet, leaning()), 1e-9);
  EXPECT_LT(poses->candidates[0].rms, 1e-12);
  EXPECT_GT(poses->candidates[1].rms * 520.0, 2.0);
  // The other leans the other way about the line of sight.
  EXPECT_GT(
      (poses->candidates[1].T_camera_sheet.rotation().col(2) - leaning().rotation().col(2)).norm(),
      0.5);
}

TEST(PlanarPoses, AreNearlyAsGoodAsEachOtherFarAway) {
  CameraSheet far(rotation_from_degrees({0.0, 0.0, 20.0}), {0.0, 0.0, 4000.0});
  const std::vector<PointPair> pairs = pairs_of(far, lattice(1));

  const auto poses = planar_poses(pairs);

  ASSERT_TRUE(poses.has_value());
  EXPECT_LT(poses->candidates[1].rms * 520.0, 0.05);
}

TEST(PlanarPoses, StandStraightAboveAPlaneSeenFrontally) {
  const CameraSheet straight(rotation_from_degrees({30.0, 0.0, 0.0}), {0.0, 0.0, 150.0});

  const auto poses = planar_poses(pairs_of(straight, lattice(1)));

  ASSERT_TRUE(poses.has_value());
  EXPECT_LT(distance(poses->candidates[0].T_camera_sheet, straight), 1e-6);
}

TEST(FitHomography, RefusesThreeOfFourOnALine) {
  const std::vector<PointPair> pairs =
      pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}, {50.8, 0.0, 0.0}, {0.0, 25.4, 0.0}});

  const auto homography = fit_homography(pairs);

  ASSERT_FALSE(homography.has_value());
  EXPECT_EQ(homography.error(), Error::kIllConditioned);
}

TEST(ProjectPoint, HasTheDerivativesOfCentralDifferences) {
  const CameraSheet T = leaning();
  const Eigen::Vector3d point(31.0, -17.0, 4.0);
  const PointProjection projection = project_point(T, point);
  const double h = 1e-5;

  for (int i = 0; i < 6; ++i) {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step(i) = h;
    const auto at = [&](double sign) {
      const CameraSheet moved(math::exp_rotation(sign * step.tail<3>()) * T.rotation(),
                              T.translation_mm() + sign * step.head<3>());
      return project_point(moved, point).plane;
    };
    const Eigen::Vector2d difference = (at(1.0) - at(-1.0)) / (2.0 * h);
    EXPECT_LT((difference - projection.by_pose.col(i)).norm(), 1e-9) << i;
  }
}

TEST(SolveNPoint, ConvergesFromFarOffOnAnyShape) {
  const std::vector<Eigen::Vector3d> object = {{0, 0, 0},   {30, 0, 5},   {0, 40, -10},
                                               {20, 25, 9}, {-30, 10, 3}, {-10, -35, -6}};
  const std::vector<PointPair> pairs = pairs_of(leaning(), object);
  const CameraSheet start(math::exp_rotation({0.3, -0.2, 0.25}) * leaning().rotation(),
                          leaning().translation_mm() + Eigen::Vector3d(15.0, -20.0, 40.0));

  const auto pose = solve_n_point(pairs, start, {});

  ASSERT_TRUE(pose.has_value());
  EXPECT_LT(distance(pose->T_camera_sheet, leaning()), 1e-8);
  EXPECT_LT(pose->steps, 20);
}

TEST(SolveNPoint, LeavesFalsePointsOut) {
  std::vector<PointPair> pairs = pairs_of(leaning(), lattice(1), 1e-4);
  pairs[2].plane.x() += 0.02;  // 10 px

  NPointOptions options;
  options.robust = true;
  const auto robust = solve_n_point(pairs, leaning(), options);
  const auto plain = solve_n_point(pairs, leaning(), {});

  ASSERT_TRUE(robust.has_value() && plain.has_value());
  EXPECT_LT(distance(robust->T_camera_sheet, leaning()), 0.3);
  EXPECT_GT(distance(plain->T_camera_sheet, leaning()), 2.0);
  EXPECT_LE(robust->used, 8);
}

TEST(SolveNPoint, FindsTheFocalLengthTooWhereTheViewIsDeep) {
  std::vector<PointPair> pairs = pairs_of(leaning(), lattice(2));
  for (PointPair& pair : pairs) {
    pair.plane *= 1.01;  // the true EFL is 1 % longer than the one that the points are divided by
  }
  NPointOptions options;
  options.free_focal_length = true;

  const auto pose = solve_n_point(pairs, leaning(), options);

  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(pose->focal_length_ratio, 1.01, 1e-9);
  EXPECT_LT(distance(pose->T_camera_sheet, leaning()), 1e-6);
}

TEST(SolveNPoint, CannotTellTheFocalLengthFromAFrontalPlane) {
  const CameraSheet straight(Eigen::Matrix3d::Identity(), {0.0, 0.0, 150.0});
  NPointOptions options;
  options.free_focal_length = true;

  const auto pose = solve_n_point(pairs_of(straight, lattice(1)), straight, options);

  EXPECT_TRUE(!pose.has_value() || pose->focal_length_sigma > 1e-4);
}

TEST(SolveNPoint, TellsTheScatterOfItsPoses) {
  // 300 noisy pictures: the normalised squared errors' mean is 6, its deviation sqrt(12 / 300).
  double sum = 0.0;
  constexpr int kRounds = 300;
  for (int round = 0; round < kRounds; ++round) {
    const auto pairs = pairs_of(leaning(), lattice(1), 2e-4, static_cast<std::uint64_t>(round + 1));
    const auto pose = solve_n_point(pairs, leaning(), {});
    ASSERT_TRUE(pose.has_value());
    math::Vector6d error;
    error.head<3>() = leaning().translation_mm() - pose->T_camera_sheet.translation_mm();
    error.tail<3>() =
        math::log_rotation(leaning().rotation() * pose->T_camera_sheet.rotation().transpose());
    sum += error.dot(pose->covariance.inverse() * error) / kRounds;
  }
  EXPECT_NEAR(sum, 6.0, 4.0 * std::sqrt(12.0 / kRounds));
}

TEST(SolveNPoint, RefusesTooFewPoints) {
  const auto pairs = pairs_of(leaning(), {{0.0, 0.0, 0.0}, {25.4, 0.0, 0.0}});

  const auto pose = solve_n_point(pairs, leaning(), {});

  ASSERT_FALSE(pose.has_value());
  EXPECT_EQ(pose.error(), Error::kBufferTooSmall);
}

}  // namespace
}  // namespace tubesight::core::pose
