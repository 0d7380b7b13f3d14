#include "core/pose/rim_equations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/math/rotation.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::pose {
namespace {

// A point's residual changes with the unknowns by
//   w . tau + ((q - p) x w) . theta - b - r / g - (u . d) / g,   w = (u_x, u_y, -(u . ray) / ray_z)
//   / g
// with u the direction from the tube-end's centre to q, ray the line of sight in the sheet frame
// and p the tool's tip. As q - p is the centre plus r u less p, all of it lies in seven functions
// of the point, whose sums are all that a pass leaves of the points:
//   u_x/g, u_y/g, w_z, w_z u_x, w_z u_y, 1/g, 1
constexpr int kUx = 0;
constexpr int kUy = 1;
constexpr int kWz = 2;
constexpr int kWzUx = 3;
constexpr int kWzUy = 4;
constexpr int kInverseG = 5;
constexpr int kOne = 6;
// The unknowns shared by all tube-ends.
constexpr int kTheta = 3;
constexpr int kOffset = 6;
// Those of one tube-end: r, d_x, d_y; the residual falls with them by the functions here.
constexpr std::array<int, 3> kOwn = {kInverseG, kUx, kUy};

// Tube-ends' worth of confidence in the given center_sigma_mm, two components each.
constexpr double kPriorTubes = 1.0;
// One point's residual, the cosine between its measured normal and the rim's, and the functions.
struct Terms {
  double residual_px = 0.0;
  double cosine = 0.0;
  std::array<double, 7> row{};
};

// The residual is the distance of q, where the ray from the camera's origin o meets the sheet, from
// the rim, in pixels: (|q - c| - r) / g - b, with q = o - (o_z / ray_z) ray and g the length of the
// gradient of |q - c| by the pixel (u, v).
Terms terms_of(const RimProblem& problem, const Sight& sight, const RimState& rim,
               const Eigen::Vector2d& center, const PlanePoint& p) {
  const Eigen::Matrix3d& R = sight.R_sheet_camera;
  const double ray_x = R(0, 0) * p.x + R(0, 1) * p.y + R(0, 2);
  const double ray_y = R(1, 0) * p.x + R(1, 1) * p.y + R(1, 2);
  const double ray_z = R(2, 0) * p.x + R(2, 1) * p.y + R(2, 2);
  const double inverse_z = 1.0 / ray_z;
  const double along = -sight.origin_mm.z() * inverse_z;
  const double qx = sight.origin_mm.x() + along * ray_x - center.x();
  const double qy = sight.origin_mm.y() + along * ray_y - center.y();
  const double distance = std::sqrt(qx * qx + qy * qy);
  const double ux = qx / distance;
  const double uy = qy / distance;
  const double wz = -(ux * ray_x + uy * ray_y) * inverse_z;
  const double gx = along * (ux * R(0, 0) + uy * R(1, 0) + wz * R(2, 0));
  const double gy = along * (ux * R(0, 1) + uy * R(1, 1) + wz * R(2, 1));
  const double gu = p.x_u * gx + p.y_u * gy;
  const double gv = p.x_v * gx + p.y_v * gy;
  const double inverse_g = 1.0 / std::sqrt(gu * gu + gv * gv);
  Terms terms;
  terms.residual_px = (distance - rim.radius_mm) * inverse_g - problem.offset_px;
  terms.cosine = (gu * p.normal_u + gv * p.normal_v) * inverse_g;
  terms.row = {ux * inverse_g,
               uy * inverse_g,
               wz * inverse_g,
               wz * ux * inverse_g,
               wz * uy * inverse_g,
               inverse_g,
               1.0};
  return terms;
}

// How the functions' coefficients change with the shared unknowns.
SharedMatrix basis_by_shared(const RimProblem& problem, const RimState& rim) {
  const double cx = rim.center_mm.x() + rim.displacement_mm.x() - problem.tip_mm.x();
  const double cy = rim.center_mm.y() + rim.displacement_mm.y() - problem.tip_mm.y();
  const double tip_z = problem.tip_mm.z();
  SharedMatrix A = SharedMatrix::Zero();
  A(kUx, 0) = 1.0;
  A(kUy, 1) = 1.0;
  A(kWz, 2) = 1.0;
  A(kWz, kTheta) = cy;
  A(kWzUy, kTheta) = rim.radius_mm;
  A(kUy, kTheta) = tip_z;
  A(kUx, kTheta + 1) = -tip_z;
  A(kWz, kTheta + 1) = -cx;
  A(kWzUx, kTheta + 1) = -rim.radius_mm;
  A(kUy, kTheta + 2) = cx;
  A(kUx, kTheta + 2) = -cy;
  A(kOne, kOffset) = -1.0;
  return A;
}

// Eliminates the tube-end's own unknowns (Schur's complement): what is left for the shared ones.
// With G and m the sums over the functions, B the rows of G for the own unknowns, C the inverse of
// their own block with its priors, and g their moment with its priors:
//   N = At (G - Bt C B) A,  moment = At (m - Bt C g)
void reduce(const RimProblem& problem, RimState& rim) {
  const double inverse2 = 1.0 / problem.scale2;
  const double nominal = 0.5 * problem.model->bore_mm;
  const double radius_prior = 1.0 / (problem.radius_sigma_mm * problem.radius_sigma_mm);
  const double center_prior = 1.0 / (problem.center_sigma_mm * problem.center_sigma_mm);
  Eigen::Matrix<double, 3, 7> rows;
  Eigen::Matrix3d own;
  for (int i = 0; i < 3; ++i) {
    const int row = kOwn[static_cast<std::size_t>(i)];
    rim.own_gradient(i) = inverse2 * rim.moment(row);
    rows.row(i) = inverse2 * rim.gram.row(row);
    for (int j = 0; j < 3; ++j) {
      own(i, j) = rows(i, kOwn[static_cast<std::size_t>(j)]);
    }
  }
  own.diagonal() += Eigen::Vector3d(radius_prior, center_prior, center_prior);
  rim.own_gradient -= Eigen::Vector3d(radius_prior * (rim.radius_mm - nominal),
                                      center_prior * rim.displacement_mm.x(),
                                      center_prior * rim.displacement_mm.y());
  rim.own_covariance = own.inverse();
  const Eigen::Matrix<double, 3, 7> share = rim.own_covariance.lazyProduct(rows);
  const SharedMatrix A = basis_by_shared(problem, rim);
  const SharedMatrix gram = inverse2 * rim.gram - rows.transpose().lazyProduct(share);
  const SharedVector moment =
      inverse2 * rim.moment - share.transpose().lazyProduct(rim.own_gradient);
  rim.own_by_shared = share.lazyProduct(A);
  const SharedMatrix product = gram.lazyProduct(A);
  rim.shared_normal = A.transpose().lazyProduct(product);
  rim.shared_moment = A.transpose().lazyProduct(moment);
}

// What the tube-end's own unknowns change by when the shared ones change by `step`: C (g + B A
// step).
Eigen::Vector3d own_step(const RimState& rim, const SharedVector& step) {
  return rim.own_covariance * rim.own_gradient + rim.own_by_shared.lazyProduct(step);
}

// The normal equations of the shared unknowns over all tube-ends in use.
struct Shared {
  SharedMatrix normal = SharedMatrix::Zero();
  SharedVector moment = SharedVector::Zero();
};

Shared shared_equations(const RimProblem& problem, std::span<RimState> rims) {
  Shared s;
  const double prior = 1.0 / (problem.options->offset_sigma_px * problem.options->offset_sigma_px);
  s.normal(kOffset, kOffset) = prior;
  s.moment(kOffset) = prior * problem.offset_px;
  for (RimState& rim : rims) {
    if (rim.used) {
      reduce(problem, rim);
      s.normal += rim.shared_normal;
      s.moment += rim.shared_moment;
    }
  }
  return s;
}

// The spread of the displacements as found, the given one counting as kPriorTubes tube-ends; what
// the prior alone holds of a displacement does not count [MacKay1992 eq. 2.17].
void update_center_sigma(RimProblem& problem, std::span<const RimState> rims,
                         const SharedVector& step, const SharedMatrix& covariance) {
  const double given2 = problem.options->center_sigma_mm * problem.options->center_sigma_mm;
  const double now2 = problem.center_sigma_mm * problem.center_sigma_mm;
  double squares = 2.0 * kPriorTubes * given2;
  double freedom = 2.0 * kPriorTubes;
  for (const RimState& rim : rims) {
    if (!rim.used) {
      continue;
    }
    const Eigen::Matrix<double, 3, 7> spread = rim.own_by_shared.lazyProduct(covariance);
    double variance = 0.0;
    for (int i = 1; i < 3; ++i) {
      variance += rim.own_covariance(i, i) + spread.row(i).dot(rim.own_by_shared.row(i));
    }
    squares += (rim.displacement_mm + own_step(rim, step).tail<2>()).squaredNorm();
    freedom += std::max(2.0 - variance / now2, 0.0);
  }
  problem.center_sigma_mm = std::clamp(std::sqrt(squares / freedom), 1e-4, 1.0);
}

}  // namespace

Sight sight_of(const RimProblem& problem) {
  const Transform<frames::Camera, frames::Tool>& T = problem.model->T_camera_tool;
  const Eigen::Matrix3d R = problem.R_sheet_tool * T.rotation().transpose();
  return {R, problem.tip_mm - R * T.translation_mm()};
}

void accumulate(const RimProblem& problem, const Sight& sight, std::span<PlanePoint> points,
                RimState& rim) {
  const std::size_t stride = problem.stride_for(points.size());
  const double limit = problem.limit_px;
  const double inverse_limit2 = limit > 0.0 ? 1.0 / (limit * limit) : 0.0;
  const Eigen::Vector2d center = rim.center_mm + rim.displacement_mm;
  std::array<double, 28> sums{};
  std::array<double, 7> moment{};
  rim.square = 0.0;
  rim.weight = 0.0;
  rim.points = 0;
  for (std::size_t index = 0; index < points.size(); index += stride) {
    PlanePoint& p = points[index];
    const Terms terms = terms_of(problem, sight, rim, center, p);
    const double e = terms.residual_px;
    const bool unmeasured = p.normal_u == 0.0 && p.normal_v == 0.0;
    const double rest = 1.0 - e * e * inverse_limit2;
    const bool counts =
        rest > 0.0 && (unmeasured || terms.cosine >= problem.options->normal_cosine);
    p.residual_px = e;
    p.robust = counts ? rest * rest : 0.0;
    if (!counts) {
      continue;
    }
    const double w = p.weight * p.robust;
    std::size_t next = 0;
    for (std::size_t i = 0; i < 7; ++i) {
      const double wi = w * terms.row[i];
      moment[i] += wi * e;
      for (std::size_t j = 0; j <= i; ++j) {
        sums[next++] += wi * terms.row[j];
      }
    }
    rim.square += w * e * e;
    rim.weight += p.robust;
    ++rim.points;
  }
  std::size_t next = 0;
  for (int i = 0; i < 7; ++i) {
    rim.moment(i) = moment[static_cast<std::size_t>(i)];
    for (int j = 0; j <= i; ++j) {
      rim.gram(i, j) = sums[next];
      rim.gram(j, i) = sums[next++];
    }
  }
}

RimStep solve_step(RimProblem& problem, std::span<RimState> rims, int rounds) {
  RimStep step;
  for (int round = 0;; ++round) {
    const Shared shared = shared_equations(problem, rims);
    math::Cholesky<7> cholesky;
    if (!cholesky.factor(shared.normal, 1e-12)) {
      step.solved = false;
      return step;
    }
    step.solved = true;
    step.change = -cholesky.solve(shared.moment);
    step.covariance = cholesky.inverse();
    step.size2 = -step.change.dot(shared.moment);
    if (round == rounds) {
      return step;
    }
    update_center_sigma(problem, rims, step.change, step.covariance);
  }
}

void apply_step(RimProblem& problem, std::span<RimState> rims, const SharedVector& change) {
  const double least = 0.1 * problem.model->bore_mm;
  for (RimState& rim : rims) {
    if (rim.used) {
      const Eigen::Vector3d own = own_step(rim, change);
      rim.radius_mm = std::max(rim.radius_mm + own(0), least);
      rim.displacement_mm += own.tail<2>();
    }
  }
  problem.tip_mm += change.head<3>();
  problem.R_sheet_tool = math::exp_rotation(change.segment<3>(kTheta)) * problem.R_sheet_tool;
  problem.offset_px += change(kOffset);
}

}  // namespace tubesight::core::pose
