#include "core/pose/planar_pose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/math/rotation.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::pose {
namespace {

// Mean and spread of points, so that numbers near one enter the normal equations.
struct Normal {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double scale = 1.0;
};

template <typename Get>
Normal normal_of(std::span<const PointPair> pairs, Get get) {
  Normal normal;
  for (const PointPair& pair : pairs) {
    normal.mean += get(pair);
  }
  const auto count = static_cast<double>(pairs.size());
  normal.mean /= count;
  double sum = 0.0;
  for (const PointPair& pair : pairs) {
    sum += (get(pair) - normal.mean).squaredNorm();
  }
  normal.scale = sum > 0.0 ? std::sqrt(2.0 * count / sum) : 1.0;
  return normal;
}

// The rotation that takes the z axis to the direction (v, 1).
Eigen::Matrix3d rotation_to(const Eigen::Vector2d& v) {
  const double length2 = v.squaredNorm();
  if (length2 < 1e-20) {
    return Eigen::Matrix3d::Identity();
  }
  const double length = std::sqrt(length2);
  const double angle = std::atan(length);
  return math::exp_rotation(Eigen::Vector3d(-v.y(), v.x(), 0.0) * (angle / length));
}

// Both rotations whose first-order projection at the origin is v + J q [Collins2014 eq. 9-17].
std::array<Eigen::Matrix3d, 2> rotations_of(const Eigen::Matrix2d& J, const Eigen::Vector2d& v) {
  const Eigen::Matrix3d R_v = rotation_to(v);
  Eigen::Matrix<double, 2, 3> line_of_sight;
  line_of_sight << 1.0, 0.0, -v.x(), 0.0, 1.0, -v.y();
  const Eigen::Matrix2d B = line_of_sight * R_v.leftCols<2>();
  const Eigen::Matrix2d A = B.inverse() * J;
  // A is a multiple of the upper left block of the rotation left of R_v. The greater singular value
  // of A is that multiple: the scale of what is not foreshortened; its square is the greater
  // eigenvalue of A At = [p q; q r], (p + r + sqrt((p - r)^2 + 4 q^2)) / 2.
  const Eigen::Matrix2d square = A * A.transpose();
  const double difference = square(0, 0) - square(1, 1);
  const double largest2 =
      0.5 *
      (square.trace() + std::sqrt(difference * difference + 4.0 * square(0, 1) * square(0, 1)));
  const Eigen::Matrix2d upper = A / std::sqrt(largest2);
  // Columns of a rotation are of length 1: what the block U lacks is the lower row b,
  // b bt = I - Ut U, whose sign the picture leaves open.
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - upper.transpose() * upper;
  const double b0 = std::sqrt(std::max(rest(0, 0), 0.0));
  const double b1 = std::sqrt(std::max(rest(1, 1), 0.0));
  const Eigen::Vector2d lower(b0, rest(0, 1) < 0.0 ? -b1 : b1);
  std::array<Eigen::Matrix3d, 2> result;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d row = i == 0 ? lower : Eigen::Vector2d(-lower);
    Eigen::Matrix3d local;
    local.topLeftCorner<2, 2>() = upper;
    local.bottomLeftCorner<1, 2>() = row.transpose();
    local.col(2) = local.col(0).cross(local.col(1));
    result[static_cast<std::size_t>(i)] = math::orthonormal(R_v * local);
  }
  return result;
}

}  // namespace

double plane_rms(const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                 std::span<const PointPair> pairs) {
  double sum = 0.0;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d p = T_camera_sheet * pair.object_mm;
    if (!(p.z() > 0.0)) {
      return 1e9;
    }
    sum += (p.head<2>() / p.z() - pair.plane).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

Result<Homography> fit_homography(std::span<const PointPair> pairs) {
  if (pairs.size() < 4) {
    return Unexpected(Error::kBufferTooSmall);
  }
  const Normal object =
      normal_of(pairs, [](const PointPair& p) -> Eigen::Vector2d { return p.object_mm.head<2>(); });
  const Normal image =
      normal_of(pairs, [](const PointPair& p) -> Eigen::Vector2d { return p.plane; });
  using Matrix8 = Eigen::Matrix<double, 8, 8>;
  using Vector8 = Eigen::Matrix<double, 8, 1>;
  Matrix8 normal = Matrix8::Zero();
  Vector8 moment = Vector8::Zero();
  // p_x (h_6 q_x + h_7 q_y + 1) = h_0 q_x + h_1 q_y + h_2, and p_y with h_3, h_4, h_5: linear in h.
  for (const PointPair& pair : pairs) {
    const Eigen::Vector2d q = (pair.object_mm.head<2>() - object.mean) * object.scale;
    const Eigen::Vector2d p = (pair.plane - image.mean) * image.scale;
    const Vector8 row_x{q.x(), q.y(), 1.0, 0.0, 0.0, 0.0, -q.x() * p.x(), -q.y() * p.x()};
    const Vector8 row_y{0.0, 0.0, 0.0, q.x(), q.y(), 1.0, -q.x() * p.y(), -q.y() * p.y()};
    moment += row_x * p.x() + row_y * p.y();
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j <= i; ++j) {
        normal(i, j) += row_x(i) * row_x(j) + row_y(i) * row_y(j);
      }
    }
  }
  math::Cholesky<8> cholesky;
  if (!cholesky.factor(normal, 1e-11)) {
    return Unexpected(Error::kIllConditioned);
  }
  const Vector8 h = cholesky.solve(moment);
  Eigen::Matrix3d scaled;
  scaled << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  Eigen::Matrix3d back;
  back << 1.0 / image.scale, 0.0, image.mean.x(), 0.0, 1.0 / image.scale, image.mean.y(), 0.0, 0.0,
      1.0;
  return Homography{back * scaled, object.mean, object.scale};
}

Result<Eigen::Vector3d> translation_for(const Eigen::Matrix3d& R_camera_sheet,
                                        std::span<const PointPair> pairs) {
  // x (R q + t)_z = (R q + t)_x and the same for y: two rows a pair.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d turned = R_camera_sheet * pair.object_mm;
    const Eigen::Vector3d row_x(1.0, 0.0, -pair.plane.x());
    const Eigen::Vector3d row_y(0.0, 1.0, -pair.plane.y());
    normal += row_x * row_x.transpose() + row_y * row_y.transpose();
    moment -= row_x * row_x.dot(turned) + row_y * row_y.dot(turned);
  }
  math::Cholesky<3> cholesky;
  if (!cholesky.factor(normal)) {
    return Unexpected(Error::kIllConditioned);
  }
  return cholesky.solve(moment);
}

Result<PlanarPoses> planar_poses(std::span<const PointPair> pairs) {
  const Result<Homography> homography = fit_homography(pairs);
  if (!homography) {
    return Unexpected(homography.error());
  }
  // At q = 0 the homography gives the point v = (H_02, H_12) and the derivatives
  // J_ij = H_ij - v_i H_2j.
  const Eigen::Matrix3d& H = homography->matrix;
  const Eigen::Vector2d v = H.topRightCorner<2, 1>();
  const Eigen::Matrix2d J = H.topLeftCorner<2, 2>() - v * H.bottomLeftCorner<1, 2>();
  const std::array<Eigen::Matrix3d, 2> rotations = rotations_of(J, v);
  PlanarPoses poses;
  for (std::size_t i = 0; i < 2; ++i) {
    const Result<Eigen::Vector3d> translation = translation_for(rotations[i], pairs);
    if (!translation) {
      return Unexpected(translation.error());
    }
    poses.candidates[i].T_camera_sheet = {rotations[i], *translation};
    poses.candidates[i].rms = plane_rms(poses.candidates[i].T_camera_sheet, pairs);
  }
  if (poses.candidates[1].rms < poses.candidates[0].rms) {
    std::swap(poses.candidates[0], poses.candidates[1]);
  }
  return poses;
}

}  // namespace tubesight::core::pose
