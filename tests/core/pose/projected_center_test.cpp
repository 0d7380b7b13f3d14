#include "core/pose/projected_center.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

CameraSheet leaning() {
  return {rotation_from_degrees({20.0, 12.0, 45.0}), Eigen::Vector3d(-5.0, 8.0, 160.0)};
}

Eigen::Vector2d image_of(const CameraSheet& T, const Eigen::Vector2d& point) {
  const Eigen::Vector3d p = T * Eigen::Vector3d(point.x(), point.y(), 0.0);
  return {p.x() / p.z(), p.y() / p.z()};
}

// Nine circles of one pitch; the middle one is number 4.
std::array<SeenCircle, 9> patch(const CameraSheet& T, double middle_radius) {
  std::array<SeenCircle, 9> circles;
  for (std::size_t i = 0; i < 9; ++i) {
    const Eigen::Vector2d center(25.4 * (static_cast<double>(i % 3) - 1.0),
                                 25.4 * (static_cast<double>(i / 3) - 1.0));
    circles[i] = {image_of_circle(T, center, i == 4 ? middle_radius : 9.3), center};
  }
  return circles;
}

TEST(ImageOfCircle, HoldsTheImagesOfItsPoints) {
  const Conic conic = image_of_circle(leaning(), {10.0, -20.0}, 9.3);

  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5 * i;
    const Eigen::Vector2d point(10.0 + 9.3 * std::cos(angle), -20.0 + 9.3 * std::sin(angle));
    EXPECT_LT(std::abs(distance_to(conic, image_of(leaning(), point))), 1e-14);
  }
}

TEST(Eccentricity, LeadsFromTheEllipsesCentreToTheCirclesCentre) {
  const Eigen::Vector2d center(10.0, -20.0);
  const Conic conic = image_of_circle(leaning(), center, 9.3);

  const Eigen::Vector2d corrected = center_of(conic) + eccentricity(leaning(), center, 9.3);

  EXPECT_LT((corrected - image_of(leaning(), center)).norm(), 1e-14);
  // It matters: over a pixel at 520 px per unit.
  EXPECT_GT(eccentricity(leaning(), center, 9.3).norm() * 520.0, 0.5);
}

TEST(Eccentricity, VanishesWhenThePlanesAreParallel) {
  const CameraSheet straight(rotation_from_degrees({30.0, 0.0, 0.0}), {3.0, 4.0, 150.0});

  EXPECT_LT(eccentricity(straight, {20.0, 10.0}, 9.3).norm(), 1e-16);
}

TEST(CircleNormals, HoldTheNormalOfThePlaneAndLeadToTheCentre) {
  const CameraSheet T = leaning();
  const Eigen::Vector2d center(30.0, -12.0);
  const Conic conic = image_of_circle(T, center, 9.3);

  const auto normals = circle_normals(conic);

  const Eigen::Vector3d true_normal = T.rotation().col(2);
  const double first = std::abs(normals[0].dot(true_normal));
  const double second = std::abs(normals[1].dot(true_normal));
  EXPECT_NEAR(std::max(first, second), 1.0, 1e-12);
  EXPECT_LT(std::min(first, second), 0.99);
  EXPECT_LT((center_by_normal(conic, -true_normal) - image_of(T, center)).norm(), 1e-13);
}

TEST(CircleNormals, AreOneWhenTheCircleIsSeenStraightOn) {
  const CameraSheet T(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, 160.0));

  const auto normals = circle_normals(image_of_circle(T, {0.0, 0.0}, 9.3));

  EXPECT_NEAR(std::abs(normals[0].z()), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(normals[1].z()), 1.0, 1e-12);
}

TEST(ConstructCenter, IsExactForEqualCirclesByBothConstructions) {
  const auto circles = patch(leaning(), 9.3);

  for (const auto way : {CenterConstruction::kTangentPoints, CenterConstruction::kTangentLines}) {
    for (const std::size_t index : {0U, 1U, 4U, 8U}) {
      const auto center = construct_center(circles, index, way, 40.0);

      ASSERT_TRUE(center.has_value());
      EXPECT_LT((*center - image_of(leaning(), circles[index].center_mm)).norm(), 1e-12) << index;
    }
  }
}

TEST(ConstructCenter, IsMovedByUnequalNeighboursOnlyWhereTheyAreOneSided) {
  // A bore 0.2 mm wider among its like: with neighbours all round the shifts cancel.
  const auto circles = patch(leaning(), 9.4);

  const auto middle = construct_center(circles, 4, CenterConstruction::kTangentPoints, 40.0);
  const auto corner = construct_center(circles, 0, CenterConstruction::kTangentPoints, 40.0);

  ASSERT_TRUE(middle.has_value() && corner.has_value());
  EXPECT_LT((*middle - image_of(leaning(), {0.0, 0.0})).norm() * 160.0, 0.003);
  EXPECT_GT((*corner - image_of(leaning(), circles[0].center_mm)).norm() * 160.0, 0.003);
}

TEST(ConstructCenter, NeedsTwoNeighboursInDifferentDirections) {
  const auto circles = patch(leaning(), 9.3);
  const std::array<SeenCircle, 3> row = {circles[0], circles[1], circles[2]};

  const auto center = construct_center(row, 1, CenterConstruction::kTangentPoints, 40.0);

  ASSERT_FALSE(center.has_value());
  EXPECT_EQ(center.error(), Error::kBufferTooSmall);
}

}  // namespace
}  // namespace tubesight::core::pose
