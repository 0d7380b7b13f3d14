#include "core/pose/ellipse_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/math/small_matrix.h"

namespace tubesight::core::pose {
namespace {

using math::Matrix6d;
using math::Vector6d;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

constexpr std::int32_t kLeastPoints = 6;

// Which points a fit takes: all, all but every fourth, or only every fourth.
enum class Part : std::uint8_t { kAll, kKept, kWithheld };

bool belongs(std::size_t index, Part part) {
  return part == Part::kAll || ((index % 4 == 3) == (part == Part::kWithheld));
}

// Coordinates of zero mean and unit spread: p' = (p - mean) * scale.
struct Frame {
  double x = 0.0;
  double y = 0.0;
  double scale = 1.0;

  [[nodiscard]] Conic back(const Conic& conic) const {
    Eigen::Matrix3d inverse;  // of p = T p'
    inverse << scale, 0.0, -scale * x, 0.0, scale, -scale * y, 0.0, 0.0, 1.0;
    return transformed(conic, inverse);
  }
};

double weight_of(const PlanePoint& p) { return p.weight * p.robust; }

Frame frame_of(std::span<const PlanePoint> points) {
  Frame frame;
  double sum = 0.0;
  for (const PlanePoint& p : points) {
    frame.x += p.x;
    frame.y += p.y;
  }
  const auto count = static_cast<double>(points.size());
  frame.x /= count;
  frame.y /= count;
  for (const PlanePoint& p : points) {
    sum += (p.x - frame.x) * (p.x - frame.x) + (p.y - frame.y) * (p.y - frame.y);
  }
  frame.scale = sum > 0.0 ? std::sqrt(2.0 * count / sum) : 1.0;
  return frame;
}

// Means of x^i y^j over the points, i + j <= 4; at(i, j).
struct Moments {
  std::array<std::array<double, 5>, 5> value{};

  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return value[i][j]; }
};

Moments moments_of(std::span<const PlanePoint> points, const Frame& frame, Part part) {
  double w_sum = 0.0;
  std::array<double, 14> s{};
  for (std::size_t index = 0; index < points.size(); ++index) {
    if (!belongs(index, part)) {
      continue;
    }
    const PlanePoint& p = points[index];
    const double w = weight_of(p);
    const double x = (p.x - frame.x) * frame.scale;
    const double y = (p.y - frame.y) * frame.scale;
    const double xx = w * x * x;
    const double xy = w * x * y;
    const double yy = w * y * y;
    w_sum += w;
    s[0] += w * x;
    s[1] += w * y;
    s[2] += xx;
    s[3] += xy;
    s[4] += yy;
    s[5] += xx * x;
    s[6] += xx * y;
    s[7] += yy * x;
    s[8] += yy * y;
    s[9] += xx * x * x;
    s[10] += xx * x * y;
    s[11] += xx * y * y;
    s[12] += yy * y * x;
    s[13] += yy * y * y;
  }
  for (double& sum : s) {
    sum /= w_sum;
  }
  Moments m;
  m.value = {{{1.0, s[1], s[4], s[8], s[13]},
              {s[0], s[3], s[7], s[12], 0.0},
              {s[2], s[6], s[11], 0.0, 0.0},
              {s[5], s[10], 0.0, 0.0, 0.0},
              {s[9], 0.0, 0.0, 0.0, 0.0}}};
  return m;
}

// Powers of x and y in the six columns of [Fallon eq. 5.14].
constexpr std::array<std::array<std::size_t, 2>, 6> kPowers = {
    {{2, 0}, {1, 1}, {0, 2}, {1, 0}, {0, 1}, {0, 0}}};

// A^T A / n of [Fallon eq. 5.14].
Matrix6d scatter_of(const Moments& m) {
  Matrix6d scatter;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const auto& a = kPowers[static_cast<std::size_t>(i)];
      const auto& b = kPowers[static_cast<std::size_t>(j)];
      scatter(i, j) = m.at(a[0] + b[0], a[1] + b[1]);
    }
  }
  return scatter;
}

// Least squares of a x^2 + b x y + c y^2 + d x + e y = 1 [Fallon eq. 5.14].
bool fit_linear(const Moments& m, Vector6d& k) {
  const Matrix6d scatter = scatter_of(m);
  math::Cholesky<5> cholesky;
  if (!cholesky.factor(scatter.topLeftCorner<5, 5>())) {
    return false;
  }
  k.head<5>() = cholesky.solve(scatter.topRightCorner<5, 1>());
  k(5) = -1.0;
  return true;
}

// a^T S a at a minimum under 4 a c - b^2 = 1. With d, e, f eliminated, M a = lambda C1 a; C1 has
// one positive eigenvalue, so 1 / lambda is the largest eigenvalue of L^-1 C1 L^-T with M = L L^T.
bool fit_direct(const Moments& m, Vector6d& k) {
  const Matrix6d scatter = scatter_of(m);
  const Eigen::Matrix3d cross = scatter.topRightCorner<3, 3>();
  const Eigen::Matrix3d linear = scatter.bottomRightCorner<3, 3>();
  if (!(linear.determinant() > 1e-9)) {
    return false;
  }
  const Eigen::Matrix3d eliminate = -linear.inverse() * cross.transpose();
  Eigen::Matrix3d reduced = scatter.topLeftCorner<3, 3>() + cross * eliminate;
  // Points that lie on an ellipse exactly leave it singular; this moves coefficients by 1e-13.
  reduced += 1e-14 * reduced.trace() * Eigen::Matrix3d::Identity();
  math::Cholesky<3> cholesky;
  if (!cholesky.factor(reduced, 1e-16)) {
    return false;
  }
  Eigen::Matrix3d constraint;
  constraint << 0.0, 0.0, 2.0, 0.0, -1.0, 0.0, 2.0, 0.0, 0.0;
  Eigen::Matrix3d symmetric;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d column = constraint * cholesky.backward(Eigen::Vector3d::Unit(i));
    symmetric.col(i) = cholesky.forward(column);
  }
  const math::SymmetricEigen<3> eigen(0.5 * (symmetric + symmetric.transpose()));
  k.head<3>() = cholesky.backward(eigen.vector_of_greatest()).normalized();
  k.tail<3>() = eliminate * k.head<3>();
  return true;
}

// Mean of the gradients' products by the coefficients: grad f = N k.
Matrix5 gradient_scatter(const Moments& m) {
  Matrix5 g = Matrix5::Zero();
  const double x = m.at(1, 0);
  const double y = m.at(0, 1);
  const double xx = m.at(2, 0);
  const double xy = m.at(1, 1);
  const double yy = m.at(0, 2);
  g << 4 * xx, 2 * xy, 0, 2 * x, 0, 2 * xy, xx + yy, 2 * xy, y, x, 0, 2 * xy, 4 * yy, 0, 2 * y,
      2 * x, y, 0, 1, 0, 0, x, 2 * y, 0, 1;
  return g;
}

// The least of (mean of f^2) / (mean of |grad f|^2). The constant that suits the others best is
// minus their mean, which leaves S' = S - s st; then S' k = lambda G k, with G = L Lt the least
// eigenvalue of L^-1 S' L^-T.
bool fit_taubin(const Moments& m, Vector6d& k) {
  const Matrix6d scatter = scatter_of(m);
  const Vector5 constant = scatter.topRightCorner<5, 1>();
  const Matrix5 reduced = scatter.topLeftCorner<5, 5>() - constant * constant.transpose();
  math::Cholesky<5> cholesky;
  if (!cholesky.factor(gradient_scatter(m))) {
    return false;
  }
  Matrix5 half;
  for (int i = 0; i < 5; ++i) {
    half.col(i) = cholesky.forward(reduced.col(i));
  }
  Matrix5 symmetric;
  for (int i = 0; i < 5; ++i) {
    symmetric.col(i) = cholesky.forward(half.row(i).transpose());
  }
  const math::SymmetricEigen<5> eigen(0.5 * (symmetric + symmetric.transpose()));
  k.head<5>() = cholesky.backward(eigen.vector_of_least()).normalized();
  k(5) = -constant.dot(k.head<5>());
  return true;
}

// Gauss-Newton on the sum of e^2 with e = f / |grad f|, the gradient's own dependence included:
//   de / dk = (df / dk - e d|grad f| / dk) / |grad f|
// The scale of the coefficients is held by a row along them.
bool refine_sampson(std::span<const PlanePoint> points, const Frame& frame, Part part,
                    Vector6d& k) {
  k.normalize();
  for (int round = 0; round < 6; ++round) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d moment = Vector6d::Zero();
    double w_sum = 0.0;
    for (std::size_t index = 0; index < points.size(); ++index) {
      const PlanePoint& p = points[index];
      const double w = weight_of(p);
      if (!belongs(index, part) || !(w > 0.0)) {
        continue;
      }
      const double x = (p.x - frame.x) * frame.scale;
      const double y = (p.y - frame.y) * frame.scale;
      const double fx = 2.0 * k(0) * x + k(1) * y + k(3);
      const double fy = k(1) * x + 2.0 * k(2) * y + k(4);
      const double inverse = 1.0 / std::sqrt(fx * fx + fy * fy);
      const Vector6d design{x * x, x * y, y * y, x, y, 1.0};
      const double e = design.dot(k) * inverse;
      const double nx = fx * inverse;
      const double ny = fy * inverse;
      const Vector6d slope{2.0 * x * nx, y * nx + x * ny, 2.0 * y * ny, nx, ny, 0.0};
      const Vector6d row = inverse * (design - e * slope);
      w_sum += w;
      moment += w * e * row;
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) {
          normal(i, j) += w * row(i) * row(j);
        }
      }
    }
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) {
        normal(i, j) += w_sum * k(i) * k(j);
      }
    }
    math::Cholesky<6> cholesky;
    if (!cholesky.factor(normal)) {
      return false;
    }
    const Vector6d step = cholesky.solve(moment);
    k = (k - step).normalized();
    if (step.squaredNorm() < 1e-20) {
      break;
    }
  }
  return true;
}

bool fit_once(std::span<const PlanePoint> points, const Frame& frame, Part part,
              EllipseMethod method, Conic& conic) {
  const Moments moments = moments_of(points, frame, part);
  Vector6d k = Vector6d::Zero();
  bool solved = false;
  switch (method) {
    case EllipseMethod::kLinear: solved = fit_linear(moments, k); break;
    case EllipseMethod::kDirect: solved = fit_direct(moments, k); break;
    case EllipseMethod::kTaubin: solved = fit_taubin(moments, k); break;
    case EllipseMethod::kSampson:
      solved = fit_taubin(moments, k) && refine_sampson(points, frame, part, k);
      break;
  }
  if (!solved) {
    return false;
  }
  conic = frame.back(conic_from(k));
  conic /= conic(0, 0) < 0.0 ? -conic.norm() : conic.norm();
  return is_ellipse(conic);
}

// The distance in the picture to first order, f / |grad f|: f = pt C p, grad f = 2 C p on the
// plane, turned into one by pixels.
double distance_px(const Conic& conic, const PlanePoint& p) {
  const double gx = conic(0, 0) * p.x + conic(0, 1) * p.y + conic(0, 2);
  const double gy = conic(0, 1) * p.x + conic(1, 1) * p.y + conic(1, 2);
  const double f = gx * p.x + gy * p.y + conic(0, 2) * p.x + conic(1, 2) * p.y + conic(2, 2);
  const double gu = p.x_u * gx + p.y_u * gy;
  const double gv = p.x_v * gx + p.y_v * gy;
  return f / (2.0 * std::sqrt(gu * gu + gv * gv));
}

// Weights by Tukey's function of the distances, whose scale is their median.
void reweight(std::span<PlanePoint> points, const Conic& conic, const EllipseOptions& options) {
  std::array<double, picture::kMaxRimPoints> sizes;
  const std::size_t count = std::min(points.size(), sizes.size());
  for (std::size_t i = 0; i < count; ++i) {
    points[i].residual_px = distance_px(conic, points[i]);
    sizes[i] = std::abs(points[i].residual_px);
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(count));
  const double scale = std::max(1.4826 * *middle, options.least_point_px);
  const double limit = options.outlier_sigmas * scale;
  for (PlanePoint& p : points) {
    const double share = p.residual_px / limit;
    const double rest = 1.0 - share * share;
    p.robust = rest > 0.0 ? rest * rest : 0.0;
  }
}

double rms_of(std::span<const PlanePoint> points, const Conic& conic, Part part) {
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t index = 0; index < points.size(); ++index) {
    if (belongs(index, part)) {
      const double e = distance_px(conic, points[index]);
      sum += points[index].robust * e * e;
      weight += points[index].robust;
    }
  }
  return weight > 0.0 ? std::sqrt(sum / weight) : 0.0;
}

}  // namespace

Result<EllipseFit> fit_ellipse(std::span<PlanePoint> points, const EllipseOptions& options) {
  if (points.size() < static_cast<std::size_t>(kLeastPoints)) {
    return Unexpected(Error::kBufferTooSmall);
  }
  for (PlanePoint& p : points) {
    p.robust = 1.0;
  }
  const Frame frame = frame_of(points);
  EllipseFit fit;
  if (!fit_once(points, frame, Part::kAll, options.method, fit.conic)) {
    return Unexpected(Error::kIllConditioned);
  }
  for (std::int32_t round = 0; round < options.robust_rounds; ++round) {
    reweight(points, fit.conic, options);
    if (!fit_once(points, frame, Part::kAll, options.method, fit.conic)) {
      return Unexpected(Error::kIllConditioned);
    }
  }
  for (const PlanePoint& p : points) {
    fit.points += p.robust >= 0.5 ? 1 : 0;
  }
  fit.rms_px = rms_of(points, fit.conic, Part::kAll);
  Conic without = Conic::Zero();
  if (options.withhold && points.size() >= 2 * static_cast<std::size_t>(kLeastPoints) &&
      fit_once(points, frame, Part::kKept, options.method, without)) {
    fit.withheld_rms_px = rms_of(points, without, Part::kWithheld);
  }
  return fit;
}

Result<Conic> fit_ellipse_quickly(std::span<const PlanePoint> points) {
  if (points.size() < static_cast<std::size_t>(kLeastPoints)) {
    return Unexpected(Error::kBufferTooSmall);
  }
  const Frame frame = frame_of(points);
  Conic conic = Conic::Zero();
  if (!fit_once(points, frame, Part::kAll, EllipseMethod::kLinear, conic) &&
      !fit_once(points, frame, Part::kAll, EllipseMethod::kDirect, conic)) {
    return Unexpected(Error::kIllConditioned);
  }
  return conic;
}

}  // namespace tubesight::core::pose
