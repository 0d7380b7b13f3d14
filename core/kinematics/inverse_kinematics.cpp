#include "core/kinematics/inverse_kinematics.h"

#include <cmath>
#include <cstdint>

#include "core/base/scalar.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::kinematics {
namespace {

using math::Matrix6d;
using math::Vector6d;

// A turn of one radian counts as much as this many millimetres: about half the length of an arm, so
// that no row of the equations outweighs the others by far.
constexpr double kTurn_mm = 500.0;
constexpr int kIterations = 80;  // of one start; near starts need five, far ones twenty

std::size_t at(std::int32_t joint) { return static_cast<std::size_t>(joint); }

struct Miss {
  Vector6d weighted = Vector6d::Zero();  ///< what is missing, turns in mm of kTurn_mm
  double mm = 0.0;
  double rad = 0.0;
  double square = 0.0;
};

class Search {
 public:
  Search(const SerialArm& arm, const Transform<frames::Base, frames::Tool>& goal,
         const InverseOptions& options)
      : arm_(arm), goal_(goal), options_(options) {}

  // From one start until nothing gets better. True: the pose is reached.
  bool run(const JointVector& start_rad) {
    angles_ = arm_.limited(start_rad);
    miss_ = miss(angles_);
    double damping = 1.0;
    for (int i = 0; i < kIterations && !reached(); ++i) {
      ++iterations_;
      const JointVector tried = stepped(damping);
      const Miss next = miss(tried);
      if (next.square < miss_.square) {
        const bool stuck = next.square > 0.9999 * miss_.square && i > 20;
        angles_ = tried;
        miss_ = next;
        damping = damping > 1e-5 ? 0.1 * damping : damping;
        if (stuck) {
          break;
        }
      } else {
        damping *= 10.0;
        if (damping > 1e12) {
          break;
        }
      }
    }
    return reached();
  }

  [[nodiscard]] InverseSolution solution(std::int32_t restarts) const {
    return {angles_, miss_.mm, miss_.rad, iterations_, restarts};
  }

 private:
  [[nodiscard]] bool reached() const {
    return miss_.mm <= options_.tolerance_mm &&
           (options_.position_only || miss_.rad <= options_.tolerance_rad);
  }

  [[nodiscard]] Miss miss(const JointVector& angles_rad) const {
    const Transform<frames::Base, frames::Tool> here = arm_.forward(angles_rad);
    Miss result;
    const Eigen::Vector3d way = goal_.translation_mm() - here.translation_mm();
    const Eigen::Vector3d turn = turn_between(here.rotation(), goal_.rotation());
    result.mm = square_root(way.squaredNorm());
    result.rad = square_root(turn.squaredNorm());
    result.weighted.head<3>() = way;
    if (!options_.position_only) {
      result.weighted.tail<3>() = kTurn_mm * turn;
    }
    result.square = result.weighted.squaredNorm();
    return result;
  }

  // dq = Jt (J Jt + damping D)^-1 miss. Joints that it would push beyond a limit are held and the
  // rest solved again, so that at most joints() + 1 rounds are needed.
  [[nodiscard]] JointVector stepped(double damping) const {
    ArmJacobian J = arm_.jacobian(angles_);
    J.bottomRows<3>() *= options_.position_only ? 0.0 : kTurn_mm;
    JointVector tried = angles_;
    for (std::int32_t round = 0; round <= arm_.joints(); ++round) {
      Matrix6d normal = Matrix6d::Zero();
      for (int r = 0; r < 6; ++r) {
        for (int c = 0; c <= r; ++c) {
          normal(r, c) = J.row(r).dot(J.row(c));
        }
        // In mm² per rad²: 1 is a thousandth of what an arm of a metre moves, squared.
        normal(r, r) += damping;
      }
      // Far above what rounding makes of a singular matrix's pivots, also for very large arms.
      const double least = 1e-12 * normal.trace();
      for (int r = 0; r < 6; ++r) {
        normal(r, r) += least;
      }
      math::Cholesky<6> factor;
      if (!factor.factor(normal)) {
        return tried;
      }
      const Vector6d pull = factor.solve(miss_.weighted);
      bool held = false;
      for (std::int32_t i = 0; i < arm_.joints(); ++i) {
        const double angle = angles_[at(i)] + J.col(i).dot(pull);
        const Link& link = arm_.links()[at(i)];
        const bool at_low = angles_[at(i)] <= link.lowest_rad && angle < link.lowest_rad;
        const bool at_high = angles_[at(i)] >= link.highest_rad && angle > link.highest_rad;
        if (at_low || at_high) {
          J.col(i).setZero();
          held = true;
        }
        tried[at(i)] = angle;
      }
      if (!held) {
        break;
      }
    }
    return arm_.limited(tried);
  }

  const SerialArm& arm_;
  const Transform<frames::Base, frames::Tool>& goal_;
  const InverseOptions& options_;
  JointVector angles_{};
  Miss miss_;
  std::int32_t iterations_ = 0;
};

// Share of the way from the lowest to the highest angle: the golden-ratio sequence of each joint
// covers the box evenly without repeating itself.
double spread(std::int32_t restart, std::int32_t joint) {
  constexpr double kSteps[] = {0.6180339887498949, 0.7548776662466927, 0.8191725133961645,
                               0.8566748838545029, 0.8812714616335696, 0.8986537126286993,
                               0.9115923534820549, 0.9215993196339830};
  const double turns = 0.5 + restart * kSteps[joint];
  return turns - std::floor(turns);
}

}  // namespace

Eigen::Vector3d turn_between(const Eigen::Matrix3d& R_a, const Eigen::Matrix3d& R_b) {
  // The unit quaternion of R_b R_at, from whichever component is largest.
  const Eigen::Matrix3d R = R_b * R_a.transpose();
  const double trace = R.trace();
  if (trace > 0.0) {
    const double four_w = 2.0 * square_root(1.0 + trace);
    return Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) *
           (2.0 / four_w);
  }
  const int i = R(1, 1) > R(0, 0) ? (R(2, 2) > R(1, 1) ? 2 : 1) : (R(2, 2) > R(0, 0) ? 2 : 0);
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double four = 2.0 * square_root(1.0 + R(i, i) - R(j, j) - R(k, k));
  const double sign = R(k, j) - R(j, k) < 0.0 ? -1.0 : 1.0;
  Eigen::Vector3d turn;
  turn(i) = 0.5 * four;
  turn(j) = 2.0 * (R(j, i) + R(i, j)) / four;
  turn(k) = 2.0 * (R(k, i) + R(i, k)) / four;
  return sign * turn;
}

Result<InverseSolution> inverse(const SerialArm& arm,
                                const Transform<frames::Base, frames::Tool>& T_base_tool,
                                const JointVector& start_rad, const InverseOptions& options) {
  if (arm.joints() == 0 || !T_base_tool.rotation().allFinite() ||
      !T_base_tool.translation_mm().allFinite()) {
    return Unexpected(Error::kInvalidArgument);
  }
  for (const double angle : start_rad) {
    if (!(std::abs(angle) <= 1000.0)) {
      return Unexpected(Error::kInvalidArgument);
    }
  }
  Search search(arm, T_base_tool, options);
  JointVector start = start_rad;
  for (std::int32_t restart = 0; restart <= options.restarts; ++restart) {
    if (search.run(start)) {
      return search.solution(restart);
    }
    for (std::int32_t i = 0; i < arm.joints(); ++i) {
      const Link& link = arm.links()[at(i)];
      start[at(i)] = link.lowest_rad + (link.highest_rad - link.lowest_rad) * spread(restart, i);
    }
  }
  return Unexpected(Error::kOutOfRange);
}

}  // namespace tubesight::core::kinematics
