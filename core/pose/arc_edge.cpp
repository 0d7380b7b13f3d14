#include "core/pose/arc_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/base/static_vector.h"

namespace tubesight::core::pose {
namespace {

// A piece 9 px long of a profile 18 px long, and some for slanted ones.
constexpr std::int32_t kMaxSamples = 320;
constexpr double kLongestHalf_px = 4.5;

/// A pixel beside the arc: its distance from the outline, outwards, and its grey level.
struct ProfileSample {
  double distance = 0.0;
  double grey = 0.0;
};
using Profile = StaticVector<ProfileSample, kMaxSamples>;

bool take_profile(const AveragedPicture& picture, const OutlineArc& arc, double reach_px,
                  Profile& profile) {
  const double tangent_u = -arc.normal_v;
  const double tangent_v = arc.normal_u;
  const double half = std::clamp(arc.half_length_px, 1.0, kLongestHalf_px);
  const double extent_u = std::abs(arc.normal_u) * reach_px + std::abs(tangent_u) * half;
  const double extent_v = std::abs(arc.normal_v) * reach_px + std::abs(tangent_v) * half;
  const auto left = static_cast<std::int32_t>(std::ceil(arc.u_px - extent_u));
  const auto right = static_cast<std::int32_t>(std::floor(arc.u_px + extent_u));
  const auto top = static_cast<std::int32_t>(std::ceil(arc.v_px - extent_v));
  const auto bottom = static_cast<std::int32_t>(std::floor(arc.v_px + extent_v));
  if (left < 0 || top < 0 || right >= picture.width_px || bottom >= picture.height_px) {
    return false;
  }
  for (std::int32_t v = top; v <= bottom; ++v) {
    const std::uint16_t* const line = picture.line(v);
    const double dv = v - arc.v_px;
    for (std::int32_t u = left; u <= right; ++u) {
      const double du = u - arc.u_px;
      const double x = tangent_u * du + tangent_v * dv;
      if (std::abs(x) > half) {
        continue;
      }
      const double y = arc.normal_u * du + arc.normal_v * dv - (arc.slope + arc.bend * x) * x;
      if (std::abs(y) <= reach_px) {
        static_cast<void>(profile.try_push_back({y, line[u] / static_cast<double>(kGreyScale)}));
      }
    }
  }
  return true;
}

/// The profile in steps of half a pixel.
class CoarseProfile {
 public:
  CoarseProfile(const Profile& profile, double reach_px) : reach_px_(reach_px) {
    for (const ProfileSample& sample : profile) {
      const auto bin = static_cast<std::int32_t>((sample.distance + reach_px) / kStep_px);
      if (bin >= 0 && bin < kBins) {
        sums_[static_cast<std::size_t>(bin)] += sample.grey;
        counts_[static_cast<std::size_t>(bin)] += 1.0;
      }
    }
    bins_ = std::min(kBins, static_cast<std::int32_t>(2.0 * reach_px / kStep_px));
    fill_gaps();
  }

  /// Where the first clear rise from the inside outwards is steepest; false without any.
  bool find_rise(double search_px, double least_contrast, double& place_px) const {
    constexpr std::int32_t kHalf = 3;  // 1.5 px to either side
    double best = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::int32_t i = kHalf; i + kHalf <= bins_; ++i) {
        const double at = i * kStep_px - reach_px_;
        if (std::abs(at) > search_px) {
          continue;
        }
        const double rise = mean(i, i + kHalf) - mean(i - kHalf, i);
        if (pass == 0) {
          best = std::max(best, rise);
        } else if (rise >= 0.6 * best && rise >= mean_rise(i + 1)) {
          place_px = at;
          return true;
        }
      }
      if (best < least_contrast) {
        return false;
      }
    }
    return false;
  }

 private:
  static constexpr double kStep_px = 0.5;
  static constexpr std::int32_t kBins = 48;

  void fill_gaps() {
    double last = 0.0;
    for (std::int32_t i = 0; i < bins_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      last = counts_[k] > 0.0 ? sums_[k] / counts_[k] : last;
      levels_[k] = last;
    }
    for (std::int32_t i = bins_ - 1; i >= 0 && counts_[0] == 0.0; --i) {
      const auto k = static_cast<std::size_t>(i);
      last = counts_[k] > 0.0 ? levels_[k] : last;
      if (levels_[k] == 0.0) {
        levels_[k] = last;
      }
    }
  }
  [[nodiscard]] double mean(std::int32_t from, std::int32_t to) const {
    double sum = 0.0;
    for (std::int32_t i = from; i < to; ++i) {
      sum += levels_[static_cast<std::size_t>(i)];
    }
    return sum / (to - from);
  }
  [[nodiscard]] double mean_rise(std::int32_t i) const {
    return i + 3 <= bins_ ? mean(i, i + 3) - mean(i - 3, i) : 0.0;
  }

  double reach_px_;
  std::int32_t bins_ = 0;
  std::array<double, kBins> sums_{};
  std::array<double, kBins> counts_{};
  std::array<double, kBins> levels_{};
};

double gauss_integral(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double gauss_density(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

/// One step of the least squares: the sums over the window.
struct StepSums {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  std::int32_t count = 0;
};

StepSums sum_step(const Profile& profile, const ArcEdge& edge, const ArcEdgeOptions& options) {
  StepSums sums;
  for (const ProfileSample& sample : profile) {
    const double x = sample.distance - edge.offset_px;
    if (x < -options.inner_px || x > options.outer_px) {
      continue;
    }
    const double share = gauss_integral(x / options.blur_px);
    const double slope =
        -(edge.bright - edge.dark) * gauss_density(x / options.blur_px) / options.blur_px;
    const Eigen::Vector3d row(1.0 - share, share, slope);
    const double off = sample.grey - (edge.dark * row(0) + edge.bright * row(1));
    sums.normal += row * row.transpose();
    sums.right += row * off;
    sums.squares += off * off;
    ++sums.count;
  }
  return sums;
}

/// Least squares of dark + (bright - dark) Phi((d - offset) / blur) on a window around the edge.
ArcEdge fit_blurred_step(const Profile& profile, double start_px, const ArcEdgeOptions& options) {
  constexpr int kSteps = 7;
  constexpr std::int32_t kFewestSamples = 10;
  ArcEdge edge;
  edge.offset_px = start_px;
  for (int step = 0; step < kSteps; ++step) {
    const StepSums sums = sum_step(profile, edge, options);
    if (sums.count < kFewestSamples) {
      return {ArcRefusal::kNoFit};
    }
    if (step == 0) {
      // Levels alone first: without them the place has no slope.
      const Eigen::Vector2d levels =
          sums.normal.topLeftCorner<2, 2>().ldlt().solve(sums.right.head<2>());
      edge.dark = levels(0);
      edge.bright = levels(1);
      continue;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(sums.normal);
    const Eigen::Vector3d change = solver.solve(sums.right);
    if (solver.info() != Eigen::Success || !change.allFinite()) {
      return {ArcRefusal::kNoFit};
    }
    edge.dark += change(0);
    edge.bright += change(1);
    edge.offset_px += std::clamp(change(2), -1.0, 1.0);
    edge.rms_grey = std::sqrt(sums.squares / sums.count);
    const double noise = std::max(options.noise_grey, edge.rms_grey);
    edge.sigma_px = noise * std::sqrt(std::max(0.0, solver.solve(Eigen::Vector3d::UnitZ())(2)));
    if (std::abs(change(2)) < 1e-3 && step > 2) {
      break;
    }
  }
  return edge;
}

/// Levels of dark and bright beside the edge, and by them the area of the profile.
ArcEdge place_by_levels(const Profile& profile, double start_px, const ArcEdgeOptions& options) {
  ArcEdge edge;
  edge.offset_px = start_px;
  for (int step = 0; step < 4; ++step) {
    constexpr double kClear_px = 1.2;
    constexpr double kFar_px = 2.5;
    constexpr double kMiddle_px = 1.05;  // pixels of an upright edge stand 1 px apart
    double dark = 0.0;
    double bright = 0.0;
    double darks = 0.0;
    double brights = 0.0;
    for (const ProfileSample& sample : profile) {
      const double x = sample.distance - edge.offset_px;
      if (x >= -kFar_px && x < -kClear_px) {
        dark += sample.grey;
        darks += 1.0;
      } else if (x > kClear_px && x <= kFar_px) {
        bright += sample.grey;
        brights += 1.0;
      }
    }
    if (darks < 3.0 || brights < 3.0) {
      return {ArcRefusal::kNoFit};
    }
    edge.dark = dark / darks;
    edge.bright = bright / brights;
    // A straight line through the middle of the rise (mid level), or the lacking area (moment).
    double n = 0.0;
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    const double half = options.method == EdgeMethod::kMidLevel ? kMiddle_px : kClear_px;
    for (const ProfileSample& sample : profile) {
      const double x = sample.distance - edge.offset_px;
      if (std::abs(x) > half) {
        continue;
      }
      const double y = (sample.grey - edge.dark) / (edge.bright - edge.dark) - 0.5;
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    if (n < 5.0 || edge.bright - edge.dark < options.least_contrast) {
      return {ArcRefusal::kNoFit};
    }
    double change = 0.0;
    if (options.method == EdgeMethod::kMidLevel) {
      const double slope = (n * sxy - sx * sy) / std::max(1e-9, n * sxx - sx * sx);
      change = slope > 0.05 ? -(sy - slope * sx) / (n * slope) : 0.0;
    } else {
      change = -2.0 * half * sy / n;
    }
    edge.offset_px += std::clamp(change, -1.0, 1.0);
    edge.sigma_px = options.noise_grey * 3.0 / ((edge.bright - edge.dark) * std::sqrt(n));
  }
  return edge;
}

/// Whether the bright side is beyond what the camera tells: then it blooms, and the edge has moved
/// into the dark by up to 0.3 px.
bool is_saturated(const Profile& profile, double offset_px) {
  constexpr double kSaturated_grey = 236.0;
  constexpr double kReach_px = 3.0;
  std::int32_t bright = 0;
  std::int32_t saturated = 0;
  for (const ProfileSample& sample : profile) {
    const double x = sample.distance - offset_px;
    if (x > 0.0 && x < kReach_px) {
      ++bright;
      saturated += sample.grey > kSaturated_grey ? 1 : 0;
    }
  }
  return saturated * 10 > bright;
}

}  // namespace

ArcEdge find_arc_edge(const AveragedPicture& picture, const OutlineArc& arc,
                      const ArcEdgeOptions& options) {
  Profile profile;
  const double reach = options.search_px + std::max(options.inner_px, options.outer_px);
  if (!take_profile(picture, arc, reach, profile)) {
    return {ArcRefusal::kOutside};
  }
  double start_px = 0.0;
  const CoarseProfile coarse(profile, reach);
  if (!coarse.find_rise(options.search_px, options.least_contrast, start_px)) {
    return {ArcRefusal::kNoRise};
  }
  ArcEdge edge = options.method == EdgeMethod::kBlurredStep
                     ? fit_blurred_step(profile, start_px, options)
                     : place_by_levels(profile, start_px, options);
  if (edge.refusal != ArcRefusal::kNone) {
    return edge;
  }
  if (edge.bright - edge.dark < options.least_contrast) {
    edge.refusal = ArcRefusal::kLowContrast;
  } else if (std::abs(edge.offset_px - start_px) > 1.5 ||
             std::abs(edge.offset_px) > options.search_px) {
    edge.refusal = ArcRefusal::kNoFit;
  } else if (is_saturated(profile, edge.offset_px)) {
    edge.sigma_px = std::hypot(edge.sigma_px, options.bloom_px);
  }
  return edge;
}

}  // namespace tubesight::core::pose
