#include "core/calibration/base_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/calibration/base_start.h"
#include "core/math/rotation.h"

namespace tubesight::core::calibration {
namespace {

using Unknowns = Eigen::Matrix<double, kBaseUnknowns, 1>;

constexpr int kLean = 6;  // and 7
constexpr int kTurn = 8;
constexpr int kMostSteps = 200;

/// A row of the equations: what one coordinate of one pair says.
struct Row {
  Unknowns slope = Unknowns::Zero();
  double miss = 0.0;
  double known_variance = 0.0;  ///< by vision
  int group = 0;                ///< of RobotScatter
};

/// Which of the unknowns are looked for.
std::array<bool, kBaseUnknowns> free_of(const BaseKnowledge& knowledge, bool any_turned) {
  std::array<bool, kBaseUnknowns> is_free{};
  is_free.fill(true);
  is_free[3] = is_free[4] = !knowledge.level;
  is_free[kLean] = is_free[kLean + 1] = any_turned;
  is_free[kTurn] = any_turned && !knowledge.tool_known;
  return is_free;
}

/// The rows of a pair: three of its place, three more of its turn. Returns how many.
int rows_of(const BasePair& pair, const BasePose& pose,
            const std::array<bool, kBaseUnknowns>& is_free, std::array<Row, 6>& rows) {
  const Eigen::Vector3d place = place_miss(pair, pose);
  const Eigen::Matrix<double, 3, 6> by_base =
      place_slope(pose, pose.T_sheet_base * pair.T_base_tool.translation_mm());
  for (int k = 0; k < 3; ++k) {
    Row& row = rows[static_cast<std::size_t>(k)];
    row = {};
    row.slope.head<6>() = by_base.row(k).transpose();
    row.miss = place(k);
    row.known_variance = pair.sigma_mm(k) * pair.sigma_mm(k);
    row.group = k < 2 ? 0 : 1;
  }
  const int count = pair.turned ? 6 : 3;
  if (pair.turned) {
    const Eigen::Vector3d turn = turn_miss(pair, pose);
    // X turns on the right by small angles about the tool's axes.
    const Eigen::Matrix3d axes =
        pose.T_sheet_base.rotation() * pair.T_base_tool.rotation() * pose.X;
    for (int k = 0; k < 3; ++k) {
      Row& row = rows[static_cast<std::size_t>(k) + 3];
      row = {};
      row.slope(3 + k) = 1.0;
      row.slope.tail<3>() = axes.row(k).transpose();
      row.miss = turn(k);
      row.group = 2;
    }
  }
  for (int k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < is_free.size(); ++i) {
      if (!is_free[i]) {
        rows[static_cast<std::size_t>(k)].slope(static_cast<Eigen::Index>(i)) = 0.0;
      }
    }
  }
  return count;
}

double variance_of(const Row& row, const std::array<double, 3>& variances) {
  return variances[static_cast<std::size_t>(row.group)] + row.known_variance;
}

std::array<double, 3> variances_of(const RobotScatter& scatter) {
  return {scatter.across_mm * scatter.across_mm, scatter.along_mm * scatter.along_mm,
          scatter.turn_rad * scatter.turn_rad};
}

/// a^T N^-1 a.
double spread_of(const Unknowns& slope, const BaseCholesky& factor) {
  return factor.forward(slope).squaredNorm();
}

void add_row(const Row& row, double weight, BaseCholesky::Matrix& information) {
  for (int i = 0; i < kBaseUnknowns; ++i) {
    for (int k = 0; k <= i; ++k) {
      information(i, k) += weight * row.slope(i) * row.slope(k);
    }
  }
}

/// The base's part of the inverse; what is held is known exactly.
math::Matrix6d base_covariance(const BaseCholesky& factor,
                               const std::array<bool, kBaseUnknowns>& is_free) {
  math::Matrix6d covariance;
  for (int column = 0; column < 6; ++column) {
    covariance.col(column) = factor.solve(Unknowns::Unit(column)).head<6>();
  }
  for (int i = 0; i < 6; ++i) {
    if (!is_free[static_cast<std::size_t>(i)]) {
      covariance.row(i).setZero();
      covariance.col(i).setZero();
    }
  }
  return covariance;
}

class Fitter {
 public:
  Fitter(const BasePairs& pairs, std::span<const std::int32_t> chosen,
         const BaseKnowledge& knowledge, BaseFit& fit)
      : pairs_(pairs), chosen_(chosen), fit_(fit) {
    bool any_turned = false;
    for (const std::int32_t i : chosen) {
      any_turned = any_turned || pairs[i].turned;
    }
    free_ = free_of(knowledge, any_turned);
  }

  [[nodiscard]] bool run() {
    variances_ = variances_of(kExpectedScatter);
    for (int step = 0; step < kMostSteps; ++step) {
      if (!gather()) {
        return false;
      }
      const double moved = move();
      const double changed = learn_scatter();
      if (moved < 1e-9 && changed < 1e-6) {
        break;
      }
    }
    return gather() && finish();
  }

 private:
  template <typename Each>
  void for_rows(Each&& each) const {
    std::array<Row, 6> rows;
    for (const std::int32_t i : chosen_) {
      const int count = rows_of(pairs_[i], fit_.pose, free_, rows);
      for (int k = 0; k < count; ++k) {
        each(rows[static_cast<std::size_t>(k)]);
      }
    }
  }

  bool gather() {
    fit_.information.setZero();
    right_.setZero();
    for_rows([&](const Row& row) {
      const double weight = 1.0 / variance_of(row, variances_);
      right_ += weight * row.miss * row.slope;
      add_row(row, weight, fit_.information);
    });
    for (int i = 0; i < kBaseUnknowns; ++i) {
      if (!free_[static_cast<std::size_t>(i)]) {
        fit_.information(i, i) = 1.0;
        right_(i) = 0.0;
      } else if (i == kLean || i == kLean + 1) {
        fit_.information(i, i) += 1.0 / (kToolLean_rad * kToolLean_rad);
        right_(i) -= lean_(i - kLean) / (kToolLean_rad * kToolLean_rad);
      }
    }
    return fit_.factor.factor(fit_.information, 1e-11);
  }

  /// One step; how far it went, in mm at a metre.
  double move() {
    const Unknowns step = fit_.factor.solve(right_);
    const Eigen::Vector3d turn = step.segment<3>(3);
    fit_.pose.T_sheet_base = {
        math::orthonormal(math::exp_rotation(turn) * fit_.pose.T_sheet_base.rotation()),
        fit_.pose.T_sheet_base.translation_mm() + step.head<3>()};
    const Eigen::Vector3d tool = step.tail<3>();
    fit_.pose.X = math::orthonormal(fit_.pose.X * math::exp_rotation(tool));
    lean_ += step.segment<2>(kLean);
    return step.head<3>().norm() + 1000.0 * (turn.norm() + tool.norm());
  }

  /// One step of expectation and maximisation: a miss is the robot's and vision's, of which the
  /// robot's share is expected, given the miss and how much of it the unknowns took.
  double learn_scatter() {
    std::array<double, 3> sums{};
    std::array<double, 3> counts{};
    for_rows([&](const Row& row) {
      const auto group = static_cast<std::size_t>(row.group);
      const double own = variances_[group];
      const double all = variance_of(row, variances_);
      const double share = own / all;
      const double taken = spread_of(row.slope, fit_.factor);
      sums[group] += share * share * (row.miss * row.miss + taken) + share * row.known_variance;
      counts[group] += 1.0;
    });
    const std::array<double, 3> expected = variances_of(kExpectedScatter);
    double changed = 0.0;
    for (std::size_t g = 0; g < 3; ++g) {
      const double next = (kExpectedWeight * expected[g] + sums[g]) / (kExpectedWeight + counts[g]);
      changed = std::max(changed, std::abs(next / variances_[g] - 1.0));
      variances_[g] = next;
    }
    return changed;
  }

  bool finish() {
    fit_.scatter = {std::sqrt(variances_[0]), std::sqrt(variances_[1]), std::sqrt(variances_[2])};
    fit_.redundancy = 0.0;
    for_rows([&](const Row& row) {
      fit_.redundancy += 1.0 - spread_of(row.slope, fit_.factor) / variance_of(row, variances_);
    });
    fit_.covariance = base_covariance(fit_.factor, free_);
    fit_.turn_sigma_rad =
        free_[kTurn] ? std::sqrt(fit_.factor.solve(Unknowns::Unit(kTurn))(kTurn)) : 0.0;
    return true;
  }

  const BasePairs& pairs_;
  std::span<const std::int32_t> chosen_;
  BaseFit& fit_;
  std::array<bool, kBaseUnknowns> free_{};
  std::array<double, 3> variances_{};
  Eigen::Vector2d lean_ = Eigen::Vector2d::Zero();  ///< of X from a mere turn
  Unknowns right_ = Unknowns::Zero();
};

}  // namespace

Eigen::Matrix<double, 3, 6> place_slope(const BasePose& pose,
                                        const Eigen::Vector3d& place_sheet_mm) {
  Eigen::Matrix<double, 3, 6> slope;
  slope.leftCols<3>().setIdentity();
  slope.rightCols<3>() = -math::skew(place_sheet_mm - pose.T_sheet_base.translation_mm());
  return slope;
}

bool fit_base(const BasePairs& pairs, std::span<const std::int32_t> chosen,
              const BaseKnowledge& knowledge, const BasePose& start, BaseFit& fit) {
  fit = {};
  fit.pose = start;
  return Fitter(pairs, chosen, knowledge, fit).run();
}

PairMiss miss_of(const BasePair& pair, const BaseFit& fit, const BaseKnowledge& knowledge,
                 bool fitted) {
  std::array<Row, 6> rows;
  const int count = rows_of(pair, fit.pose, free_of(knowledge, pair.turned), rows);
  const std::array<double, 3> variances = variances_of(fit.scatter);
  PairMiss miss;
  for (int k = 0; k < count; ++k) {
    const Row& row = rows[static_cast<std::size_t>(k)];
    const double all = variance_of(row, variances);
    const double taken = spread_of(row.slope, fit.factor);
    // A fitted row's miss is what the unknowns left of it: at least a tenth, lest a pair that alone
    // tells something be called wrong for nothing.
    const double expected = fitted ? std::max(0.1 * all, all - taken) : all + taken;
    (k < 3 ? miss.place2 : miss.turn2) += row.miss * row.miss / expected;
  }
  return miss;
}

bool covariance_with(const BaseFit& fit, const BasePair& pair, const BaseKnowledge& knowledge,
                     math::Matrix6d& covariance) {
  const std::array<bool, kBaseUnknowns> is_free = free_of(knowledge, pair.turned);
  std::array<Row, 6> rows;
  const int count = rows_of(pair, fit.pose, is_free, rows);
  const std::array<double, 3> variances = variances_of(fit.scatter);
  BaseCholesky::Matrix information = fit.information;
  for (int k = 0; k < count; ++k) {
    const Row& row = rows[static_cast<std::size_t>(k)];
    add_row(row, 1.0 / variance_of(row, variances), information);
  }
  BaseCholesky factor;
  if (!factor.factor(information, 1e-11)) {
    return false;
  }
  covariance = base_covariance(factor, is_free);
  return true;
}

}  // namespace tubesight::core::calibration
