#include "core/pose/four_point.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/math/small_matrix.h"
#include "core/pose/three_point.h"

namespace tubesight::core::pose {
namespace {

using Rays = std::array<Eigen::Vector3d, 4>;

constexpr std::array<std::array<std::size_t, 2>, 6> kSides = {
    {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}, {1, 3}}};
constexpr std::array<std::array<std::size_t, 4>, 4> kTriangles = {
    {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};

struct Quadrangle {
  Rays rays;
  std::array<double, 6> sides_mm{};
};

// F_0 .. F_5 of [Fallon eq. 5.33-5.38] and their derivatives by the lengths: with s = x_b r_b - x_a
// r_a
//   F_ab = |s| - d_ab,  dF_ab / dx_a = -s . r_a / |s|,  dF_ab / dx_b = s . r_b / |s|
void errors_of(const Quadrangle& q, const Eigen::Vector4d& lengths, Eigen::Matrix<double, 6, 1>& F,
               Eigen::Matrix<double, 6, 4>& J) {
  J.setZero();
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto a = static_cast<Eigen::Index>(kSides[i][0]);
    const auto b = static_cast<Eigen::Index>(kSides[i][1]);
    const Eigen::Vector3d side =
        lengths(b) * q.rays[kSides[i][1]] - lengths(a) * q.rays[kSides[i][0]];
    const double length = side.norm();
    F(row) = length - q.sides_mm[i];
    J(row, a) = -side.dot(q.rays[kSides[i][0]]) / length;
    J(row, b) = side.dot(q.rays[kSides[i][1]]) / length;
  }
}

double objective_of(const Quadrangle& q, const Eigen::Vector4d& lengths) {
  Eigen::Matrix<double, 6, 1> F;
  Eigen::Matrix<double, 6, 4> J;
  errors_of(q, lengths, F, J);
  return F.squaredNorm();
}

// Levenberg and Marquardt: (Jt J + damping diag(Jt J)) change = -Jt F.
double minimise(const Quadrangle& q, Eigen::Vector4d& lengths) {
  double objective = objective_of(q, lengths);
  double damping = 1e-6;
  for (int step = 0; step < 40; ++step) {
    Eigen::Matrix<double, 6, 1> F;
    Eigen::Matrix<double, 6, 4> J;
    errors_of(q, lengths, F, J);
    Eigen::Matrix4d normal = J.transpose().lazyProduct(J);
    normal.diagonal() *= 1.0 + damping;
    math::Cholesky<4> cholesky;
    if (!cholesky.factor(normal, 1e-16)) {
      damping *= 10.0;
      continue;
    }
    const Eigen::Vector4d change = -cholesky.solve(J.transpose() * F);
    const double next = objective_of(q, lengths + change);
    if (next <= objective) {
      lengths += change;
      objective = next;
      damping = std::max(0.1 * damping, 1e-12);
      if (change.norm() < 1e-12 * lengths.norm()) {
        break;
      }
    } else {
      damping *= 10.0;
    }
  }
  return objective;
}

double area_of(const std::array<PointPair, 4>& pairs, const std::array<std::size_t, 4>& t) {
  return (pairs[t[1]].object_mm - pairs[t[0]].object_mm)
      .cross(pairs[t[2]].object_mm - pairs[t[0]].object_mm)
      .norm();
}

// The best of all triangles' solutions as lengths of all four rays.
bool start_of(const std::array<PointPair, 4>& pairs, const Quadrangle& q,
              Eigen::Vector4d& lengths) {
  double best = HUGE_VAL;
  for (const auto& t : kTriangles) {
    for (const auto& T : solve_three_points({pairs[t[0]], pairs[t[1]], pairs[t[2]]})) {
      // A ray passes nearest to a point P at the length P . r.
      Eigen::Vector4d candidate;
      for (std::size_t i = 0; i < 4; ++i) {
        candidate(static_cast<Eigen::Index>(i)) = (T * pairs[i].object_mm).dot(q.rays[i]);
      }
      const double objective = objective_of(q, candidate);
      if (candidate.minCoeff() > 0.0 && objective < best) {
        best = objective;
        lengths = candidate;
      }
    }
  }
  return best < HUGE_VAL;
}

}  // namespace

Result<FourPointPose> solve_four_points(const std::array<PointPair, 4>& pairs) {
  Quadrangle q;
  for (std::size_t i = 0; i < 4; ++i) {
    q.rays[i] = pairs[i].plane.homogeneous().normalized();
  }
  for (std::size_t i = 0; i < 6; ++i) {
    q.sides_mm[i] = (pairs[kSides[i][1]].object_mm - pairs[kSides[i][0]].object_mm).norm();
  }
  FourPointPose pose;
  if (!start_of(pairs, q, pose.lengths_mm)) {
    return Unexpected(Error::kIllConditioned);
  }
  pose.objective_mm2 = minimise(q, pose.lengths_mm);
  const auto& widest = *std::max_element(
      kTriangles.begin(), kTriangles.end(),
      [&](const auto& a, const auto& b) { return area_of(pairs, a) < area_of(pairs, b); });
  std::array<Eigen::Vector3d, 3> seen;
  std::array<Eigen::Vector3d, 3> object;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t point = widest[i];
    seen[i] = pose.lengths_mm(static_cast<Eigen::Index>(point)) * q.rays[point];
    object[i] = pairs[point].object_mm;
  }
  const Eigen::Matrix3d R = triangle_axes(seen) * triangle_axes(object).transpose();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    t +=
        0.25 * (pose.lengths_mm(static_cast<Eigen::Index>(i)) * q.rays[i] - R * pairs[i].object_mm);
  }
  pose.T_camera_sheet = {R, t};
  return pose;
}

}  // namespace tubesight::core::pose
