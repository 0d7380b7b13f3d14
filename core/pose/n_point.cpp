#include "core/pose/n_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/rotation.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
constexpr int kFocal = 6;

// The unknowns: the pose of the object's middle, and the logarithm of EFL found over EFL given.
struct State {
  CameraSheet T;
  double log_focal = 0.0;
};

// What is minimised: pairs seen from their middle, so that turning and shifting come apart.
struct Problem {
  std::span<const PointPair> pairs;
  Eigen::Vector3d middle_mm = Eigen::Vector3d::Zero();
  const NPointOptions* options = nullptr;
  double scale = 1.0;  // of the residuals, for outliers; below 0: all count alike
};

// Tukey's weight (1 - e^2 / c^2)^2 with c = outlier_sigmas times the scale; 0 beyond c.
double robust_weight(const Problem& problem, double square) {
  if (problem.scale < 0.0) {
    return 1.0;
  }
  const double limit = problem.options->outlier_sigmas * problem.scale;
  const double rest = 1.0 - square / (limit * limit);
  return rest > 0.0 ? rest * rest : 0.0;
}

// Tukey's loss c^2 / 3 (1 - (1 - e^2 / c^2)^3), whose derivative by e^2 is the weight; the plain
// square without a limit.
double robust_loss(const Problem& problem, double square) {
  if (problem.scale < 0.0) {
    return square;
  }
  const double limit2 = std::pow(problem.options->outlier_sigmas * problem.scale, 2);
  const double rest = std::max(1.0 - square / limit2, 0.0);
  return limit2 / 3.0 * (1.0 - rest * rest * rest);
}

double prior_weight(const NPointOptions& options) {
  const double sigma = options.focal_length_sigma;
  return sigma > 0.0 ? 1.0 / (sigma * sigma) : 0.0;
}

// Squares of the residuals in units of sigma; infinite when a point lies behind the camera.
double cost_of(const Problem& problem, const State& state) {
  const double focal = std::exp(state.log_focal);
  double cost = prior_weight(*problem.options) * state.log_focal * state.log_focal;
  for (const PointPair& pair : problem.pairs) {
    const Eigen::Vector3d p = state.T * (pair.object_mm - problem.middle_mm);
    if (!(p.z() > 1e-6)) {
      return HUGE_VAL;
    }
    const double square =
        (focal * p.head<2>() / p.z() - pair.plane).squaredNorm() / (pair.sigma * pair.sigma);
    cost += robust_loss(problem, square);
  }
  return cost;
}

// Sums of w Jt J and w Jt e for e = f (x / z, y / z) - plane with (x, y, z) = R q + t: the focal
// length's logarithm enters by de / d(log f) = f (x / z, y / z).
void build(const Problem& problem, const State& state, Matrix7& normal, Vector7& moment) {
  normal.setZero();
  moment.setZero();
  const double focal = std::exp(state.log_focal);
  for (const PointPair& pair : problem.pairs) {
    const PointProjection projection = project_point(state.T, pair.object_mm - problem.middle_mm);
    Eigen::Matrix<double, 2, 7> J;
    J.leftCols<6>() = focal * projection.by_pose;
    J.col(kFocal) = focal * projection.plane;
    const Eigen::Vector2d e = focal * projection.plane - pair.plane;
    const double inverse2 = 1.0 / (pair.sigma * pair.sigma);
    const double w = inverse2 * robust_weight(problem, e.squaredNorm() * inverse2);
    moment += w * (J.transpose() * e);
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j <= i; ++j) {
        normal(i, j) += w * (J(0, i) * J(0, j) + J(1, i) * J(1, j));
      }
    }
  }
  if (!problem.options->free_focal_length) {
    normal.row(kFocal).setZero();
    normal(kFocal, kFocal) = 1.0;
    moment(kFocal) = 0.0;
  } else {
    normal(kFocal, kFocal) += prior_weight(*problem.options);
    moment(kFocal) += prior_weight(*problem.options) * state.log_focal;
  }
}

// R <- exp([theta]x) R, t <- t + tau, log f <- log f + its step.
State moved(const State& state, const Vector7& step) {
  State next;
  next.T = {math::exp_rotation(step.segment<3>(3)) * state.T.rotation(),
            state.T.translation_mm() + step.head<3>()};
  next.log_focal = state.log_focal + step(kFocal);
  return next;
}

// Levenberg's and Marquardt's method: the diagonal is raised until a step lowers the cost.
bool descend(const Problem& problem, State& state, std::int32_t& steps) {
  double damping = 1e-6;
  double cost = cost_of(problem, state);
  if (!(cost < HUGE_VAL)) {
    return false;
  }
  while (steps < problem.options->max_steps) {
    ++steps;
    Matrix7 normal;
    Vector7 moment;
    build(problem, state, normal, moment);
    bool better = false;
    double change = 0.0;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      Matrix7 damped = normal;
      damped.diagonal() *= 1.0 + damping;
      math::Cholesky<7> cholesky;
      if (cholesky.factor(damped, 1e-15)) {
        const Vector7 step = -cholesky.solve(moment);
        const State next = moved(state, step);
        const double next_cost = cost_of(problem, next);
        if (next_cost <= cost) {
          // Millimetres and radians alike: the range of sight is some hundreds of either.
          change = step.head<3>().norm() / state.T.translation_mm().norm() + step.tail<4>().norm();
          state = next;
          cost = next_cost;
          better = true;
        }
      }
      damping = better ? std::max(damping * 0.1, 1e-12) : damping * 10.0;
    }
    if (!better || change < 1e-12) {
      return true;
    }
  }
  return true;
}

// The median of the residuals as a standard deviation: for two components it is 1.1774 sigma.
double residual_scale(const Problem& problem, const State& state) {
  std::array<double, kMaxTubesInView> sizes;
  const std::size_t count = std::min(problem.pairs.size(), sizes.size());
  const double focal = std::exp(state.log_focal);
  for (std::size_t i = 0; i < count; ++i) {
    const PointPair& pair = problem.pairs[i];
    const Eigen::Vector3d p = state.T * (pair.object_mm - problem.middle_mm);
    sizes[i] = (focal * p.head<2>() / p.z() - pair.plane).norm() / pair.sigma;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(*middle / 1.1774, 1.0);
}

bool fill(const Problem& problem, const State& state, NPointPose& pose) {
  Matrix7 normal;
  Vector7 moment;
  build(problem, state, normal, moment);
  math::Cholesky<7> cholesky;
  if (!cholesky.factor(normal, 1e-12)) {
    return false;
  }
  const Matrix7 inverse = cholesky.inverse();
  const Eigen::Vector3d arm = state.T.rotation() * problem.middle_mm;
  // t = t' - R middle, so tau = tau' - theta x (R middle) = tau' + [R middle]x theta.
  math::Matrix6d to_origin = math::Matrix6d::Identity();
  to_origin.topRightCorner<3, 3>() = math::skew(arm);
  const math::Matrix6d local = inverse.topLeftCorner<6, 6>();
  pose.covariance.noalias() =
      to_origin.lazyProduct(local).eval().lazyProduct(to_origin.transpose());
  pose.T_camera_sheet = {state.T.rotation(), state.T.translation_mm() - arm};
  pose.focal_length_ratio = std::exp(state.log_focal);
  pose.focal_length_sigma = problem.options->free_focal_length
                                ? std::sqrt(inverse(kFocal, kFocal)) * pose.focal_length_ratio
                                : 0.0;
  double sum = 0.0;
  for (const PointPair& pair : problem.pairs) {
    const Eigen::Vector3d p = pose.T_camera_sheet * pair.object_mm;
    const double square =
        (pose.focal_length_ratio * p.head<2>() / p.z() - pair.plane).squaredNorm();
    const double scaled = square / (pair.sigma * pair.sigma);
    const double weight = robust_weight(problem, scaled);
    sum += square;
    pose.chi_square += weight * scaled;
    pose.used += weight >= 0.5 ? 1 : 0;
  }
  pose.rms = std::sqrt(sum / static_cast<double>(problem.pairs.size()));
  return true;
}

}  // namespace

PointProjection project_point(const CameraSheet& T, const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d turned = T.rotation() * point_mm;
  const Eigen::Vector3d p = turned + T.translation_mm();
  const double inverse = 1.0 / p.z();
  PointProjection result;
  result.plane = p.head<2>() * inverse;
  // With P = R q + t: d(x / z) / dP = (1, 0, -x / z) / z, dP / dtau = I, dP / dtheta = -[R q]x.
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << inverse, 0.0, -result.plane.x() * inverse, 0.0, inverse, -result.plane.y() * inverse;
  result.by_pose.leftCols<3>() = by_point;
  result.by_pose.rightCols<3>() = -by_point * math::skew(turned);
  return result;
}

Result<NPointPose> solve_n_point(std::span<const PointPair> pairs, const CameraSheet& start,
                                 const NPointOptions& options) {
  if (pairs.size() < (options.free_focal_length ? 4U : 3U)) {
    return Unexpected(Error::kBufferTooSmall);
  }
  Problem problem{pairs, Eigen::Vector3d::Zero(), &options, -1.0};
  for (const PointPair& pair : pairs) {
    problem.middle_mm += pair.object_mm / static_cast<double>(pairs.size());
  }
  State state{{start.rotation(), start * problem.middle_mm}, 0.0};
  NPointPose pose;
  if (!descend(problem, state, pose.steps)) {
    return Unexpected(Error::kOutOfRange);
  }
  for (int round = 0; options.robust && round < 4; ++round) {
    problem.scale = residual_scale(problem, state);
    if (!descend(problem, state, pose.steps)) {
      return Unexpected(Error::kOutOfRange);
    }
  }
  if (!fill(problem, state, pose)) {
    return Unexpected(Error::kIllConditioned);
  }
  return pose;
}

}  // namespace tubesight::core::pose
