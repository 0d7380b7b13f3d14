#include "core/pose/bitangent.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace tubesight::core::pose {
namespace {

Conic circle(double x, double y, double radius) {
  Conic conic;
  conic << 1, 0, -x, 0, 1, -y, -x, -y, x * x + y * y - radius * radius;
  return conic;
}

// A leaning camera's view: circles become ellipses, tangents stay tangents [Fallon eq. 5.21].
Eigen::Matrix3d projective() {
  Eigen::Matrix3d T;
  T << 0.9, 0.1, 0.3, -0.2, 0.7, 0.1, 0.05, -0.08, 1.0;
  return T;
}

// All lines that touch both: those among the tangents of the first, walked round by angle, whose
// l^T C^-1 l for the second changes sign: the inverse conics intersected [Fallon 5.1.3, way 1].
std::vector<Eigen::Vector3d> dual_intersections(const Conic& first, const Conic& second) {
  const Eigen::Matrix3d dual = second.inverse();
  const auto tangent = [&](double angle) {
    const Eigen::Vector2d p =
        farthest_point(first, Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    Eigen::Vector3d line = first * p.homogeneous();
    return Eigen::Vector3d(line / line.head<2>().norm());
  };
  const auto value = [&](double angle) { return tangent(angle).dot(dual * tangent(angle)); };
  std::vector<Eigen::Vector3d> lines;
  const int steps = 720;
  for (int i = 0; i < steps; ++i) {
    double low = 6.283185307179586 * i / steps;
    double high = 6.283185307179586 * (i + 1) / steps;
    const bool rising = value(low) < 0.0;
    if (rising == (value(high) < 0.0)) {
      continue;
    }
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      ((value(middle) < 0.0) == rising ? low : high) = middle;
    }
    lines.push_back(tangent(low));
  }
  return lines;
}

TEST(WalkBitangent, TouchesEqualCirclesAtTheEndsOfTheirDiameters) {
  const auto left = walk_bitangent(circle(0, 0, 2), circle(10, 0, 2), 1);
  const auto right = walk_bitangent(circle(0, 0, 2), circle(10, 0, 2), -1);

  ASSERT_TRUE(left.has_value() && right.has_value());
  EXPECT_LT((left->on_first - Eigen::Vector2d(0, 2)).norm(), 1e-12);
  EXPECT_LT((left->on_second - Eigen::Vector2d(10, 2)).norm(), 1e-12);
  EXPECT_LT((right->on_first - Eigen::Vector2d(0, -2)).norm(), 1e-12);
}

TEST(WalkBitangent, TouchesUnequalCirclesWhereTrigonometrySays) {
  // sine of the line's slope = (3 - 1) / 10
  const auto bitangent = walk_bitangent(circle(0, 0, 3), circle(10, 0, 1), 1);

  ASSERT_TRUE(bitangent.has_value());
  const Eigen::Vector2d normal(0.2, std::sqrt(1 - 0.04));
  EXPECT_LT((bitangent->on_first - 3 * normal).norm(), 1e-12);
  EXPECT_LT((bitangent->on_second - Eigen::Vector2d(10, 0) - normal).norm(), 1e-12);
}

TEST(WalkBitangent, NeedsNoMoreThanTheSourceSays) {
  const Eigen::Matrix3d inverse = projective().inverse();
  const Conic first = transformed(circle(0, 0, 0.37), inverse);
  const Conic second = transformed(circle(1, 0, 0.35), inverse);

  const auto bitangent = walk_bitangent(first, second, 1);

  ASSERT_TRUE(bitangent.has_value());
  EXPECT_LE(bitangent->steps, 10);  // five passes of two tangents
}

TEST(WalkBitangent, AgreesWithTheIntersectionOfTheInverseConics) {
  const Eigen::Matrix3d inverse = projective().inverse();
  const Conic first = transformed(circle(0, 0, 0.37), inverse);
  const Conic second = transformed(circle(0.8, 0.6, 0.33), inverse);
  const std::vector<Eigen::Vector3d> lines = dual_intersections(first, second);
  ASSERT_EQ(lines.size(), 4U);  // [Fallon fig. 5.9]

  for (const int side : {1, -1}) {
    const auto bitangent = walk_bitangent(first, second, side);

    ASSERT_TRUE(bitangent.has_value());
    double nearest = 1.0;
    for (const Eigen::Vector3d& line : lines) {
      nearest =
          std::min({nearest, (line - bitangent->line).norm(), (line + bitangent->line).norm()});
    }
    EXPECT_LT(nearest, 1e-10) << side;
    // Both centres on the same side of it: an outer one.
    const double one = bitangent->line.dot(center_of(first).homogeneous());
    const double other = bitangent->line.dot(center_of(second).homogeneous());
    EXPECT_GT(one * other, 0.0);
  }
}

TEST(WalkBitangent, RefusesEllipsesOneInsideTheOther) {
  EXPECT_FALSE(walk_bitangent(circle(0, 0, 1), circle(0.1, 0, 5), 1).has_value());
}

}  // namespace
}  // namespace tubesight::core::pose
