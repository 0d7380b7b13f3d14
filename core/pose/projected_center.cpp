#include "core/pose/projected_center.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/math/small_matrix.h"
#include "core/pose/bitangent.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

// Neighbours within reach that take part: of a square pitch the eight around, of a triangular one
// two rings are too many and the nearest six do.
constexpr std::int32_t kMaxNeighbours = 8;
constexpr double kLeastSine = 0.5;  // of 30 degrees

// Both outer bitangents with one neighbour.
struct Pair {
  Eigen::Vector2d direction_mm = Eigen::Vector2d::Zero();  // unit vector to it, on the sheet
  Bitangent left;
  Bitangent right;
};

struct Neighbours {
  std::array<Pair, kMaxNeighbours> pairs;
  std::size_t count = 0;
};

double sine_between(const Pair& a, const Pair& b) {
  return std::abs(a.direction_mm.x() * b.direction_mm.y() -
                  a.direction_mm.y() * b.direction_mm.x());
}

// The nearest neighbours first, so that a full list holds the best.
Result<Neighbours> neighbours_of(std::span<const SeenCircle> circles, std::size_t index,
                                 double reach_mm) {
  Neighbours result;
  double last = 0.0;
  std::size_t last_index = circles.size();
  while (result.count < static_cast<std::size_t>(kMaxNeighbours)) {
    std::size_t best = circles.size();
    double best_distance = reach_mm;
    for (std::size_t i = 0; i < circles.size(); ++i) {
      const double distance = (circles[i].center_mm - circles[index].center_mm).norm();
      const bool later = distance > last || (distance == last && i > last_index);
      if (i != index && later && distance < best_distance) {
        best = i;
        best_distance = distance;
      }
    }
    if (best == circles.size()) {
      break;
    }
    last = best_distance;
    last_index = best;
    const auto left = walk_bitangent(circles[index].conic, circles[best].conic, 1);
    const auto right = walk_bitangent(circles[index].conic, circles[best].conic, -1);
    if (!left || !right) {
      return Unexpected(Error::kIllConditioned);
    }
    const Eigen::Vector2d way = circles[best].center_mm - circles[index].center_mm;
    result.pairs[result.count++] = {way / way.norm(), *left, *right};
  }
  for (std::size_t i = 0; i < result.count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (sine_between(result.pairs[i], result.pairs[j]) >= kLeastSine) {
        return result;
      }
    }
  }
  return Unexpected(Error::kBufferTooSmall);
}

// The point nearest to all diameters.
Eigen::Vector2d from_points(const Neighbours& neighbours) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < neighbours.count; ++i) {
    const Pair& pair = neighbours.pairs[i];
    const Eigen::Vector2d along = pair.left.on_first - pair.right.on_first;
    const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
    normal += across * across.transpose();
    moment += across * across.dot(pair.left.on_first);
  }
  return normal.inverse() * moment;
}

// Where the diagonals of the tangent lines' quadrangles meet, the mean of all pairs.
Eigen::Vector2d from_lines(const Neighbours& neighbours) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < neighbours.count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Pair& a = neighbours.pairs[i];
      const Pair& b = neighbours.pairs[j];
      if (sine_between(a, b) < kLeastSine) {
        continue;
      }
      const Eigen::Vector3d one =
          a.left.line.cross(b.left.line).cross(a.right.line.cross(b.right.line));
      const Eigen::Vector3d other =
          a.left.line.cross(b.right.line).cross(a.right.line.cross(b.left.line));
      sum += one.cross(other).hnormalized();
      count += 1.0;
    }
  }
  return sum / count;
}

// pi^-2 times the squared area of an ellipse: the product of the squared half axes.
double squared_size(const Conic& conic) {
  const EllipseAxes axes = axes_of(conic);
  return axes.major * axes.major * axes.minor * axes.minor;
}

}  // namespace

Result<Eigen::Vector2d> construct_center(std::span<const SeenCircle> circles, std::size_t index,
                                         CenterConstruction construction, double reach_mm) {
  const Result<Neighbours> neighbours = neighbours_of(circles, index, reach_mm);
  if (!neighbours) {
    return Unexpected(neighbours.error());
  }
  return construction == CenterConstruction::kTangentPoints ? from_points(*neighbours)
                                                            : from_lines(*neighbours);
}

Conic image_of_circle(const CameraSheet& T_camera_sheet, const Eigen::Vector2d& center_mm,
                      double radius_mm) {
  Eigen::Matrix3d H = T_camera_sheet.rotation();
  H.col(2) = T_camera_sheet * Eigen::Vector3d(center_mm.x(), center_mm.y(), 0.0);
  const Eigen::Vector3d diagonal(1.0, 1.0, -radius_mm * radius_mm);
  return transformed(diagonal.asDiagonal(), H.inverse());
}

double apparent_radius(const CameraSheet& T_camera_sheet, const SeenCircle& circle,
                       double nominal_mm) {
  const Conic expected = image_of_circle(T_camera_sheet, circle.center_mm, nominal_mm);
  const double ratio2 = squared_size(circle.conic) / squared_size(expected);
  return nominal_mm * std::sqrt(std::sqrt(ratio2));
}

Eigen::Vector2d eccentricity(const CameraSheet& T_camera_sheet, const Eigen::Vector2d& center_mm,
                             double radius_mm) {
  const Eigen::Matrix3d& R = T_camera_sheet.rotation();
  const Eigen::Vector3d t = T_camera_sheet * Eigen::Vector3d(center_mm.x(), center_mm.y(), 0.0);
  const Eigen::Vector3d ellipse =
      t * t.z() - radius_mm * radius_mm * (R(2, 0) * R.col(0) + R(2, 1) * R.col(1));
  return t.hnormalized() - ellipse.hnormalized();
}

std::array<Eigen::Vector3d, 2> circle_normals(const Conic& conic) {
  // C - l2 I, l2 the middle eigenvalue, is the pair of planes through the projection point that cut
  // circles out of the cone.
  const math::SymmetricEigen<3> eigen(conic);
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return eigen.values(a) > eigen.values(b); });
  const double greatest = eigen.values(order[0]);
  const double middle = eigen.values(order[1]);
  const double least = eigen.values(order[2]);
  const Eigen::Vector3d across = std::sqrt(greatest - middle) * eigen.vectors.col(order[0]);
  const Eigen::Vector3d along = std::sqrt(middle - least) * eigen.vectors.col(order[2]);
  return {(along + across).normalized(), (along - across).normalized()};
}

Eigen::Vector2d center_by_normal(const Conic& conic, const Eigen::Vector3d& normal) {
  return Eigen::Vector3d(conic.inverse() * normal).hnormalized();
}

}  // namespace tubesight::core::pose
