#include "core/calibration/base_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/base/assert.h"
#include "core/calibration/angle_slope.h"
#include "core/calibration/base_start.h"
#include "core/math/rotation.h"

namespace tubesight::core::calibration {
namespace {

constexpr std::int32_t kLeastPairs = 3;  // two cannot be checked against each other
constexpr double kOnePlace_mm = 20.0;
constexpr double kLine_mm = 20.0;
// "Typically less than 5 mm over the generator" [Fallon sec. 5.3] is three of these at most.
constexpr double kMostScatter_mm = 3.0;
constexpr double kMostTurn_rad = 0.03;
// The scatter of a rotation against a base of three pairs' places: 0.5 mm in 100 mm.
constexpr double kTurnGate_rad = 5e-3;
constexpr double kMostScale = 0.02;
constexpr double kSameDistance_mm = 5.0;
// Chi-square of three: one in 10^5 beyond. Of few misses the scatter itself is uncertain.
constexpr double kMiss2 = 26.0;
constexpr double kMissOfFew = 8.0;
// Of two leans: one in 10^6.
constexpr double kLean2 = 27.6;
constexpr double kVague_mm = 5.0;
constexpr double kCalibration_mm = 0.5;  // [Fallon sec. 1.1.2]
constexpr double kPositioning_mm = 1.25;

constexpr double kDegrees = 180.0 / std::numbers::pi;

using Indices = StaticVector<std::int32_t, kMaxPairs>;

/// The extent of the places, mm: along, and across their longest direction.
Eigen::Vector2d extent_of(const BasePairs& pairs, std::span<const std::int32_t> chosen) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::int32_t i : chosen) {
    middle += pairs[i].T_base_tool.translation_mm();
  }
  middle /= static_cast<double>(chosen.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::int32_t i : chosen) {
    const Eigen::Vector3d off = pairs[i].T_base_tool.translation_mm() - middle;
    scatter += off * off.transpose();
  }
  Eigen::Vector3d values = math::SymmetricEigen<3>(scatter).values;
  std::sort(values.data(), values.data() + 3);
  return {std::sqrt(std::max(0.0, values(2))), std::sqrt(std::max(0.0, values(1)))};
}

/// Middle ratio of distances, sheet to base, between neighbours in the list.
double scale_of(const BasePairs& pairs, std::span<const std::int32_t> chosen) {
  std::array<double, kMaxPairs> ratios{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    // The one half the list away: not its neighbour on the sheet.
    const BasePair& a = pairs[chosen[k]];
    const BasePair& b = pairs[chosen[(k + (chosen.size() + 1) / 2) % chosen.size()]];
    const double base = (a.T_base_tool.translation_mm() - b.T_base_tool.translation_mm()).norm();
    const double sheet = (a.T_sheet_tool.translation_mm() - b.T_sheet_tool.translation_mm()).norm();
    if (base > 0.0) {
      // Near places are apart by an uncertain multiple.
      ratios[count++] = std::abs(sheet - base) < kSameDistance_mm ? 1.0 : sheet / base;
    }
  }
  if (count == 0) {
    return 1.0;
  }
  auto* const middle = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ratios.begin(), middle, ratios.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

ToolDeviation deviation(const BasePose& pose, const math::Matrix6d& covariance,
                        const Eigen::Vector3d& place) {
  const Eigen::Matrix<double, 3, 6> slope = place_slope(pose, place);
  const Eigen::Matrix<double, 3, 6> half = slope * covariance;
  const Eigen::Matrix3d spread = half * slope.transpose();
  return {std::sqrt(std::max(0.0, spread(0, 0) + spread(1, 1))),
          std::sqrt(std::max(0.0, spread(2, 2)))};
}

/// Root mean squares and the worst over places.
struct Summary {
  ToolDeviation mean;
  ToolDeviation worst;
  Eigen::Vector2d worst_at = Eigen::Vector2d::Zero();
};

Summary summarise(const BasePose& pose, const math::Matrix6d& covariance, double height_mm,
                  std::span<const Eigen::Vector2d> places) {
  Summary all;
  for (const Eigen::Vector2d& at : places) {
    const ToolDeviation here = deviation(pose, covariance, {at.x(), at.y(), height_mm});
    all.mean.across_mm += here.across_mm * here.across_mm;
    all.mean.along_mm += here.along_mm * here.along_mm;
    if (here.across_mm > all.worst.across_mm) {
      all.worst.across_mm = here.across_mm;
      all.worst_at = at;
    }
    all.worst.along_mm = std::max(all.worst.along_mm, here.along_mm);
  }
  const auto count = static_cast<double>(places.size());
  all.mean.across_mm = std::sqrt(all.mean.across_mm / count);
  all.mean.along_mm = std::sqrt(all.mean.along_mm / count);
  return all;
}

/// Of the base's z axis from the sheet's normal.
double lean_of(const BasePose& pose) {
  const Eigen::Vector3d z = pose.T_sheet_base.rotation().col(2);
  return std::asin(std::min(1.0, std::hypot(z.x(), z.y())));
}

class Calibrator {
 public:
  Calibrator(const BasePairs& pairs, const BaseKnowledge& knowledge, BaseCalibration& result,
             PairOutcomes& outcomes)
      : pairs_(pairs), knowledge_(knowledge), result_(result), outcomes_(outcomes) {}

  [[nodiscard]] BaseRefusal run(std::span<const Eigen::Vector2d> places) {
    for (std::int32_t i = 0; i < pairs_.size(); ++i) {
      if (pairs_[i].use) {
        static_cast<void>(all_.try_push_back(i));
        any_turned_ = any_turned_ || pairs_[i].turned;
      }
    }
    if (all_.size() < kLeastPairs) {
      return BaseRefusal::kTooFew;
    }
    std::sort(all_.begin(), all_.end(),
              [&](std::int32_t a, std::int32_t b) { return comes_before(pairs_[a], pairs_[b]); });
    if (const BaseRefusal refusal = look_at_places(); refusal != BaseRefusal::kNone) {
      return refusal;
    }
    if (const BaseRefusal refusal = fit(); refusal != BaseRefusal::kNone) {
      return refusal;
    }
    if (const BaseRefusal refusal = look_at_lean(); refusal != BaseRefusal::kNone) {
      return refusal;
    }
    tell(places);
    return result_.worst.across_mm > kVague_mm ? BaseRefusal::kVague : BaseRefusal::kNone;
  }

 private:
  BaseRefusal look_at_places() {
    result_.scale = scale_of(pairs_, all_.view());
    if (std::abs(result_.scale - 1.0) > kMostScale) {
      return BaseRefusal::kOtherUnit;
    }
    return look_at_extent();
  }

  BaseRefusal look_at_extent() {
    const Eigen::Vector2d extent = extent_of(pairs_, good_.empty() ? all_.view() : good_.view());
    if (extent(0) < kOnePlace_mm) {
      return BaseRefusal::kOnePlace;
    }
    // Of a level base a line does not tell which way up it is.
    return extent(1) < kLine_mm && !any_turned_ ? BaseRefusal::kCollinear : BaseRefusal::kNone;
  }

  BaseRefusal fit() {
    double scatter_mm = 0.0;
    const BasePose start = base_of_most(pairs_, all_.view(), knowledge_, scatter_mm);
    if (scatter_mm > kMostScatter_mm) {
      return contradiction(scatter_mm);
    }
    const double gate = 6.0 * std::max(scatter_mm, 0.5);
    for (const std::int32_t i : all_) {
      if (place_miss(pairs_[i], start).norm() < gate) {
        static_cast<void>(good_.try_push_back(i));
      }
    }
    gate_turns(start);
    // The set settles in two or three rounds; one that does not has a pair on the limit.
    for (int round = 0; round < 10; ++round) {
      if (good_.size() < std::max(kLeastPairs, all_.size() - most_outliers(all_.size()))) {
        return contradiction(scatter_mm);
      }
      if (const BaseRefusal refusal = look_at_extent(); refusal != BaseRefusal::kNone) {
        return refusal;
      }
      if (!fit_base(pairs_, good_.view(), knowledge_,
                    base_in_closed_form(pairs_, good_.view(), knowledge_), result_.fit)) {
        return BaseRefusal::kOnePlace;
      }
      if (!choose_again()) {
        break;
      }
    }
    if (result_.fit.scatter.across_mm > kMostScatter_mm) {
      return contradiction(result_.fit.scatter.across_mm);
    }
    return result_.fit.scatter.turn_rad > kMostTurn_rad ? BaseRefusal::kTurnContradiction
                                                        : BaseRefusal::kNone;
  }

  /// Places that contradict each other do so by themselves, or because of what was said of them.
  BaseRefusal contradiction(double scatter_mm) {
    result_.worst_mm = scatter_mm;
    if (extent_of(pairs_, all_.view())(1) < kLine_mm) {
      return BaseRefusal::kContradiction;
    }
    double without_mm = 0.0;
    if (knowledge_.level) {
      BaseKnowledge leaning = knowledge_;
      leaning.level = false;
      const BasePose pose = base_of_most(pairs_, all_.view(), leaning, without_mm);
      if (without_mm < kMostScatter_mm) {
        result_.lean_rad = lean_of(pose);
        return BaseRefusal::kNotLevel;
      }
    }
    BaseKnowledge places = knowledge_;
    places.places_only = true;
    static_cast<void>(base_of_most(pairs_, all_.view(), places, without_mm));
    return any_turned_ && without_mm < kMostScatter_mm ? BaseRefusal::kTurnContradiction
                                                       : BaseRefusal::kContradiction;
  }

  /// Leaves out of `good_` the pairs whose rotation most others do not agree with.
  void gate_turns(BasePose pose) {
    const Indices fitting = good_;
    std::array<double, kMaxPairs> misses{};
    BasePose best = pose;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t candidate : fitting) {
      if (!pairs_[candidate].turned) {
        continue;
      }
      if (!knowledge_.tool_known) {
        pose.X = turn_of_tool(pairs_, std::span(&candidate, 1), pose.T_sheet_base.rotation());
      }
      std::size_t count = 0;
      for (const std::int32_t i : fitting) {
        if (pairs_[i].turned) {
          misses[count++] = turn_miss(pairs_[i], pose).norm();
        }
      }
      auto* const middle = misses.begin() + static_cast<std::ptrdiff_t>(count / 2);
      std::nth_element(misses.begin(), middle, misses.begin() + static_cast<std::ptrdiff_t>(count));
      if (*middle < least) {
        least = *middle;
        best = pose;
      }
    }
    const double gate = 6.0 * std::max(least, kTurnGate_rad);
    good_.clear();
    for (const std::int32_t i : fitting) {
      if (turn_miss(pairs_[i], best).norm() < gate) {
        static_cast<void>(good_.try_push_back(i));
      }
    }
  }

  /// Takes in what fits and leaves out what does not; false: nothing changed.
  bool choose_again() {
    const double limit = kMiss2 * (1.0 + kMissOfFew / std::max(1.0, result_.fit.redundancy));
    Indices next;
    for (const std::int32_t i : all_) {
      const bool fitted = std::find(good_.begin(), good_.end(), i) != good_.end();
      const PairMiss miss = miss_of(pairs_[i], result_.fit, knowledge_, fitted);
      if (miss.place2 < limit && miss.turn2 < limit) {
        static_cast<void>(next.try_push_back(i));
      }
    }
    const bool changed = !std::equal(next.begin(), next.end(), good_.begin(), good_.end());
    good_ = next;
    return changed;
  }

  BaseRefusal look_at_lean() {
    const BaseKnowledge free{false, knowledge_.tool_known};
    BaseFit leaning;
    const bool told = any_turned_ || extent_of(pairs_, good_.view())(1) > 10.0 * kLine_mm;
    if (!told || !fit_base(pairs_, good_.view(), free, result_.fit.pose, leaning)) {
      return BaseRefusal::kNone;
    }
    result_.lean_rad = lean_of(leaning.pose);
    const Eigen::Matrix2d spread = leaning.covariance.block<2, 2>(3, 3);
    result_.lean_sigma_rad = std::sqrt(std::max(spread(0, 0), spread(1, 1)));
    const double lean2 =
        result_.lean_rad * result_.lean_rad / (result_.lean_sigma_rad * result_.lean_sigma_rad);
    return knowledge_.level && lean2 > kLean2 ? BaseRefusal::kNotLevel : BaseRefusal::kNone;
  }

  void tell(std::span<const Eigen::Vector2d> places) {
    const BaseFit& fit = result_.fit;
    result_.good = good_;
    result_.used = good_.size();
    result_.outliers = all_.size() - good_.size();
    double height = 0.0;
    for (const std::int32_t i : good_) {
      height += pairs_[i].T_sheet_tool.translation_mm().z();
    }
    result_.height_mm = height / good_.size();
    result_.R_sheet_tool = pairs_[good_[0]].T_sheet_tool.rotation();
    for (std::int32_t i = 0; i < pairs_.size(); ++i) {
      const bool fitted = std::find(good_.begin(), good_.end(), i) != good_.end();
      PairOutcome outcome;
      outcome.place_mm = place_miss(pairs_[i], fit.pose);
      outcome.turn_rad = turn_miss(pairs_[i], fit.pose);
      outcome.miss = miss_of(pairs_[i], fit, knowledge_, fitted);
      outcome.outlier = pairs_[i].use && !fitted;
      static_cast<void>(outcomes_.try_push_back(outcome));
    }
    const Eigen::Matrix3d& rotation = fit.pose.T_sheet_base.rotation();
    const std::array<double, 3> angles = math::angles_of(rotation);
    result_.values << fit.pose.T_sheet_base.translation_mm(), kDegrees * angles[0],
        kDegrees * angles[1], kDegrees * angles[2];
    math::Matrix6d slope = math::Matrix6d::Identity();
    slope.bottomRightCorner<3, 3>() = angle_slope_deg(rotation);
    const math::Matrix6d half = slope * fit.covariance;
    result_.covariance = half * slope.transpose();
    const Summary all = summarise(fit.pose, fit.covariance, result_.height_mm, places);
    result_.mean = all.mean;
    result_.worst = all.worst;
    result_.worst_mm_at = all.worst_at;
    result_.verdict = all.worst.across_mm <= kCalibration_mm   ? BaseVerdict::kCalibration
                      : all.worst.across_mm <= kPositioning_mm ? BaseVerdict::kPositioning
                                                               : BaseVerdict::kZones;
  }

  const BasePairs& pairs_;
  BaseKnowledge knowledge_;
  BaseCalibration& result_;
  PairOutcomes& outcomes_;
  Indices all_;   ///< those to be used, in an order of their own
  Indices good_;  ///< of them those that fit, in the same order
  bool any_turned_ = false;
};

}  // namespace

void calibrate_base(const BasePairs& pairs, const BaseKnowledge& knowledge,
                    std::span<const Eigen::Vector2d> places, BaseCalibration& result,
                    PairOutcomes& outcomes) {
  TUBESIGHT_ASSERT(!places.empty());
  result = {};
  outcomes.clear();
  result.refusal = Calibrator(pairs, knowledge, result, outcomes).run(places);
}

ToolDeviation deviation_at(const BaseCalibration& base, const Eigen::Vector2d& at_mm) {
  return deviation(base.fit.pose, base.fit.covariance, {at_mm.x(), at_mm.y(), base.height_mm});
}

NextPlace next_place(const BaseCalibration& base, const BaseKnowledge& knowledge, bool turned,
                     std::span<const Eigen::Vector2d> candidates,
                     std::span<const Eigen::Vector2d> places) {
  TUBESIGHT_ASSERT(!candidates.empty() && !places.empty());
  NextPlace best;
  bool any = false;
  for (const Eigen::Vector2d& at : candidates) {
    BasePair pair;
    pair.turned = turned;
    pair.T_sheet_tool = {base.R_sheet_tool, {at.x(), at.y(), base.height_mm}};
    const Transform<frames::Tool, frames::Tool> X_back{base.fit.pose.X.transpose(),
                                                       Eigen::Vector3d::Zero()};
    pair.T_base_tool = base.fit.pose.T_sheet_base.inverse() * pair.T_sheet_tool * X_back;
    math::Matrix6d covariance;
    if (!covariance_with(base.fit, pair, knowledge, covariance)) {
      continue;
    }
    const Summary then = summarise(base.fit.pose, covariance, base.height_mm, places);
    if (!any || then.mean.across_mm < best.mean.across_mm) {
      best = {at, then.mean, then.worst};
      any = true;
    }
  }
  return best;
}

}  // namespace tubesight::core::calibration
