#include "core/pose/bitangent.h"

#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace tubesight::core::pose {
namespace {

constexpr int kMaxSteps = 40;

// Where the tangent from a point outside touches the conic, the touching point farther along
// `outwards`: the point's polar C p [Fallon eq. 5.16] meets the conic in both.
std::optional<Eigen::Vector2d> touching_point(const Conic& conic, const Eigen::Vector2d& from,
                                              const Eigen::Vector2d& outwards) {
  const Eigen::Vector3d polar = conic * from.homogeneous();
  const Eigen::Vector2d normal = polar.head<2>();
  const double length2 = normal.squaredNorm();
  if (!(length2 > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d along = Eigen::Vector2d(-normal.y(), normal.x()) / std::sqrt(length2);
  // From the point of the polar nearest to the ellipse's centre, so that little cancels.
  const Eigen::Vector2d center = center_of(conic);
  const Eigen::Vector2d foot = center - normal * ((normal.dot(center) + polar.z()) / length2);
  const Eigen::Matrix2d A = conic.topLeftCorner<2, 2>();
  const double a = along.dot(A * along);
  const double b = along.dot(conic.topRows<2>() * foot.homogeneous());
  const double c = foot.homogeneous().dot(conic * foot.homogeneous());
  const double root2 = b * b - a * c;
  if (!(root2 >= 0.0)) {
    return std::nullopt;
  }
  const double root = std::sqrt(root2);
  const Eigen::Vector2d one = foot + along * ((-b + root) / a);
  const Eigen::Vector2d other = foot + along * ((-b - root) / a);
  if (outwards.dot(one) > outwards.dot(other)) {
    return one;
  }
  return other;
}

}  // namespace

Eigen::Vector2d farthest_point(const Conic& conic, const Eigen::Vector2d& direction) {
  const Eigen::Matrix2d inverse = conic.topLeftCorner<2, 2>().inverse();
  const Eigen::Vector2d center = center_of(conic);
  const double level = -center.homogeneous().dot(conic * center.homogeneous());
  const Eigen::Vector2d toward = inverse * direction;
  // (p - c)^T A (p - c) = level, with p - c along A^-1 d; a concave form has both signs turned.
  const Eigen::Vector2d off = toward * std::sqrt(level / direction.dot(toward));
  const double sign = off.dot(direction) > 0.0 ? 1.0 : -1.0;
  return center + sign * off;
}

Result<Bitangent> walk_bitangent(const Conic& first, const Conic& second, int side) {
  const Eigen::Vector2d way = center_of(second) - center_of(first);
  const Eigen::Vector2d outwards = static_cast<double>(side) * Eigen::Vector2d(-way.y(), way.x());
  Bitangent result;
  result.on_first = farthest_point(first, outwards);
  for (result.steps = 0; result.steps < kMaxSteps;) {
    const auto there = touching_point(second, result.on_first, outwards);
    if (!there) {
      return Unexpected(Error::kIllConditioned);
    }
    const auto back = touching_point(first, *there, outwards);
    if (!back) {
      return Unexpected(Error::kIllConditioned);
    }
    const double change = (*there - result.on_second).norm() + (*back - result.on_first).norm();
    result.on_second = *there;
    result.on_first = *back;
    result.steps += 2;
    if (change < 1e-13) {
      break;
    }
  }
  result.line = result.on_first.homogeneous().cross(result.on_second.homogeneous());
  result.line /= result.line.head<2>().norm();
  return result;
}

}  // namespace tubesight::core::pose
