#include "core/detection/local_map.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/math/small_matrix.h"

namespace tubesight::core::detection {
namespace {

using Unknowns = Eigen::Matrix<double, 8, 1>;
using Normal = Eigen::Matrix<double, 8, 8>;

constexpr std::size_t kLeastPoints = 5;

}  // namespace

bool LocalMap::fit(std::span<const IndexedPoint> points, const LensBend& lens) {
  if (points.size() < kLeastPoints) {
    return false;
  }
  lens_ = lens;
  const auto count = static_cast<double>(points.size());
  origin_px_.setZero();
  for (const IndexedPoint& point : points) {
    origin_px_ += lens.straight(point.place_px) / count;
  }
  scale_px_ = 0.0;
  for (const IndexedPoint& point : points) {
    scale_px_ += (lens.straight(point.place_px) - origin_px_).norm() / count;
  }
  if (!(scale_px_ > 0.0)) {
    return false;
  }
  // u (g x + h y + 1) = a x + b y + c for each point, v alike; the sums of the normal equations of
  // m = (x, y, 1), block by block.
  Eigen::Matrix3d plain = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 2, 3> by_u = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix<double, 2, 3> by_v = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix2d by_square = Eigen::Matrix2d::Zero();
  Unknowns right = Unknowns::Zero();
  for (const IndexedPoint& point : points) {
    const Eigen::Vector3d m(point.index.x(), point.index.y(), 1.0);
    const Eigen::Vector2d p = (lens.straight(point.place_px) - origin_px_) / scale_px_;
    const double weight = point.weight;
    plain += weight * m * m.transpose();
    by_u += weight * p.x() * m.head<2>() * m.transpose();
    by_v += weight * p.y() * m.head<2>() * m.transpose();
    by_square += weight * p.squaredNorm() * m.head<2>() * m.head<2>().transpose();
    right.head<3>() += weight * p.x() * m;
    right.segment<3>(3) += weight * p.y() * m;
    right.tail<2>() -= weight * p.squaredNorm() * m.head<2>();
  }
  Normal normal = Normal::Zero();
  normal.block<3, 3>(0, 0) = plain;
  normal.block<3, 3>(3, 3) = plain;
  normal.block<2, 3>(6, 0) = -by_u;
  normal.block<2, 3>(6, 3) = -by_v;
  normal.block<2, 2>(6, 6) = by_square;
  // What a few points at a corner do not tell of the perspective is taken as little.
  constexpr double kHold = 4e-5;
  normal(6, 6) += kHold;
  normal(7, 7) += kHold;
  math::Cholesky<8> factor;
  if (!factor.factor(normal, 1e-9)) {
    return false;
  }
  const Unknowns h = factor.solve(right);
  map_ << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  return std::all_of(points.begin(), points.end(), [&](const IndexedPoint& point) {
    return map_.row(2).head<2>().dot(point.index) + 1.0 > 0.1;
  });
}

Eigen::Vector2d LocalMap::to_pixel(const Eigen::Vector2d& index) const {
  const Eigen::Vector3d p = map_ * index.homogeneous();
  return lens_.bent(origin_px_ + scale_px_ * p.head<2>() / p.z());
}

Eigen::Matrix2d LocalMap::slope() const {
  constexpr double kSmall = 0.05;
  Eigen::Matrix2d slope;
  slope << to_pixel({kSmall, 0.0}) - to_pixel({-kSmall, 0.0}),
      to_pixel({0.0, kSmall}) - to_pixel({0.0, -kSmall});
  return slope / (2.0 * kSmall);
}

Ellipse LocalMap::element(const Steps& steps) const {
  // Of an index plane in which an element is x^T M x = 1, M the steps' metric, the dual conic
  // diag(M^-1, -1) shows as H diag(M^-1, -1) H^T.
  Eigen::Matrix2d basis;
  basis << steps.column, steps.row;
  const Eigen::Matrix2d inverse = basis.inverse();
  Eigen::Matrix3d dual = Eigen::Matrix3d::Zero();
  dual.topLeftCorner<2, 2>() = inverse * inverse.transpose();
  dual(2, 2) = -1.0;
  dual = (map_ * dual * map_.transpose()).eval();
  const Eigen::Matrix3d scaled = dual / dual(2, 2);
  Ellipse ellipse;
  const Eigen::Vector2d center = scaled.topRightCorner<2, 1>();
  ellipse.center_px = origin_px_ + scale_px_ * center;
  // The dual of an ellipse about c is c c^T - S.
  ellipse.shape_px2 =
      scale_px_ * scale_px_ * (center * center.transpose() - scaled.topLeftCorner<2, 2>());
  return lens_.bent(ellipse);
}

Eigen::Vector2d LocalMap::center_of(const Ellipse& shown) const {
  const Ellipse ellipse = lens_.straight(shown);
  // C^-1 l, C^-1 being the dual conic up to a factor.
  const Eigen::Vector2d center = (ellipse.center_px - origin_px_) / scale_px_;
  Eigen::Matrix3d dual;
  dual << center * center.transpose() - ellipse.shape_px2 / (scale_px_ * scale_px_), center,
      center.transpose(), 1.0;
  const Eigen::Vector3d vanishing = map_.inverse().row(2).transpose();
  const Eigen::Vector3d pole = dual * vanishing;
  return lens_.bent(origin_px_ + scale_px_ * pole.head<2>() / pole.z());
}

double LocalMap::shorter_step_px() const {
  const Eigen::Vector2d here = to_pixel(Eigen::Vector2d::Zero());
  return std::min((to_pixel(Eigen::Vector2d::UnitX()) - here).norm(),
                  (to_pixel(Eigen::Vector2d::UnitY()) - here).norm());
}

}  // namespace tubesight::core::detection
