#include "core/pose/three_point.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/math/polynomial.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

// Squares of the sides and cosines between the rays; index pairs 01, 02, 12.
struct Triangle {
  std::array<double, 3> side2{};
  std::array<double, 3> cosine{};
};

constexpr std::array<std::array<int, 2>, 3> kSides = {{{0, 1}, {0, 2}, {1, 2}}};

// What the laws of cosines leave over [Fallon eq. 5.22-5.24]:
//   F_ab = x_a^2 + x_b^2 - 2 x_a x_b cos(a, b) - d_ab^2
Eigen::Vector3d excess(const Triangle& triangle, const RayLengths& x) {
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    const auto [a, b] = kSides[static_cast<std::size_t>(i)];
    result(i) = x(a) * x(a) + x(b) * x(b) -
                2.0 * x(a) * x(b) * triangle.cosine[static_cast<std::size_t>(i)] -
                triangle.side2[static_cast<std::size_t>(i)];
  }
  return result;
}

// Newton: x <- x - J^-1 F, with dF_ab / dx_a = 2 (x_a - x_b cos(a, b)).
bool polish(const Triangle& triangle, RayLengths& x) {
  const double size = std::max({triangle.side2[0], triangle.side2[1], triangle.side2[2]});
  for (int step = 0; step < 20; ++step) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = kSides[static_cast<std::size_t>(i)];
      const double cosine = triangle.cosine[static_cast<std::size_t>(i)];
      J(i, a) = 2.0 * (x(a) - x(b) * cosine);
      J(i, b) = 2.0 * (x(b) - x(a) * cosine);
    }
    if (J.determinant() == 0.0) {
      break;
    }
    const Eigen::Vector3d change = J.inverse() * excess(triangle, x);
    x -= change;
    if (!(change.norm() > 1e-14 * x.norm())) {
      break;
    }
  }
  return x.minCoeff() > 0.0 && excess(triangle, x).norm() < 1e-9 * size;
}

// The quartic in v = x_2 / x_0 [Haralick1991 eq. 9], a, b, c being the sides 12, 02, 01.
math::Quartic quartic_of(const Triangle& t) {
  const double a2 = t.side2[2] / t.side2[1];
  const double c2 = t.side2[0] / t.side2[1];
  const double q = a2 - c2;
  const double s = a2 + c2;
  const double ca = t.cosine[2];
  const double cb = t.cosine[1];
  const double cg = t.cosine[0];
  return {(1.0 + q) * (1.0 + q) - 4.0 * a2 * cg * cg,
          4.0 * (-q * (1.0 + q) * cb + 2.0 * a2 * cg * cg * cb - (1.0 - s) * ca * cg),
          2.0 * (q * q - 1.0 + 2.0 * q * q * cb * cb + 2.0 * (1.0 - c2) * ca * ca -
                 4.0 * s * ca * cb * cg + 2.0 * (1.0 - a2) * cg * cg),
          4.0 * (q * (1.0 - q) * cb - (1.0 - s) * ca * cg + 2.0 * c2 * ca * ca * cb),
          (q - 1.0) * (q - 1.0) - 4.0 * c2 * ca * ca};
}

void add(const Triangle& triangle, RayLengths x, StaticVector<RayLengths, 4>& solutions) {
  if (!polish(triangle, x)) {
    return;
  }
  for (const RayLengths& known : solutions) {
    if ((known - x).norm() < 1e-6 * x.norm()) {
      return;
    }
  }
  static_cast<void>(solutions.try_push_back(x));
}

}  // namespace

StaticVector<RayLengths, 4> solve_ray_lengths(const std::array<Eigen::Vector3d, 3>& rays,
                                              const std::array<double, 3>& sides_mm) {
  Triangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(kSides[i][0]);
    const auto b = static_cast<std::size_t>(kSides[i][1]);
    triangle.side2[i] = sides_mm[i] * sides_mm[i];
    triangle.cosine[i] = rays[a].dot(rays[b]);
  }
  StaticVector<RayLengths, 4> solutions;
  // Lengths differ a thousandfold at most for anything a camera sees.
  for (const double v : math::real_roots(quartic_of(triangle), 1e-3, 1e3)) {
    // The law of cosines of side 02 with x_2 = v x_0: x_0^2 (1 + v^2 - 2 v cos) = d_02^2.
    const double span2 = 1.0 + v * v - 2.0 * v * triangle.cosine[1];
    const double x0 = std::sqrt(triangle.side2[1] / span2);
    // x_1 from its law of cosines with x_0, x_1 = x_0 cos +- sqrt(d_01^2 - x_0^2 sin^2); of the two
    // the third law keeps the right one.
    const double cosine = triangle.cosine[0];
    const double root2 = triangle.side2[0] - x0 * x0 * (1.0 - cosine * cosine);
    const double root = std::sqrt(std::max(root2, 0.0));
    for (const double x1 : {x0 * cosine + root, x0 * cosine - root}) {
      const RayLengths x(x0, x1, v * x0);
      if (x1 > 0.0 && std::abs(excess(triangle, x)(2)) < 1e-2 * triangle.side2[2]) {
        add(triangle, x, solutions);
      }
    }
  }
  return solutions;
}

Eigen::Matrix3d triangle_axes(const std::array<Eigen::Vector3d, 3>& points) {
  const Eigen::Vector3d base = points[2] - points[1];
  const Eigen::Vector3d side = points[0] - points[1];
  Eigen::Matrix3d axes;
  axes.col(0) = base.normalized();
  axes.col(2) = base.cross(side).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

StaticVector<CameraSheet, 4> solve_three_points(const std::array<PointPair, 3>& pairs) {
  std::array<Eigen::Vector3d, 3> rays;
  std::array<Eigen::Vector3d, 3> object;
  for (std::size_t i = 0; i < 3; ++i) {
    rays[i] = pairs[i].plane.homogeneous().normalized();
    object[i] = pairs[i].object_mm;
  }
  StaticVector<CameraSheet, 4> poses;
  const Eigen::Vector3d base = object[2] - object[1];
  const Eigen::Vector3d side = object[0] - object[1];
  if (base.cross(side).norm() <= 1e-6 * base.norm() * side.norm()) {
    return poses;
  }
  const std::array<double, 3> sides = {(object[1] - object[0]).norm(),
                                       (object[2] - object[0]).norm(),
                                       (object[2] - object[1]).norm()};
  for (const RayLengths& x : solve_ray_lengths(rays, sides)) {
    const std::array<Eigen::Vector3d, 3> seen = {x(0) * rays[0], x(1) * rays[1], x(2) * rays[2]};
    // The axes of the triangle as seen are R times its own; a corner then gives t = P - R Q.
    const Eigen::Matrix3d R = triangle_axes(seen) * triangle_axes(object).transpose();
    static_cast<void>(poses.try_push_back({R, seen[1] - R * object[1]}));
  }
  return poses;
}

}  // namespace tubesight::core::pose
