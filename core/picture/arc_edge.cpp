#include "core/picture/arc_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "core/math/gaussian_step.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::picture {
namespace {

// A piece 9 px long of a profile 18 px long, and some for slanted ones.
constexpr std::int32_t kMaxSamples = 320;
constexpr double kLongestHalf_px = 4.5;

// From where the profile rises steepest an edge is not found farther off than this.
constexpr double kFarthest_px = 1.5;

/// A pixel beside the arc: its distance from the outline, outwards, and its grey level.
struct ProfileSample {
  double distance;
  double grey;
};

/// Pixels beside the arc. Whether one belongs to it is decided without a branch, which no processor
/// would foresee.
class Profile {
 public:
  /// Takes the sample if it `belongs`; needs room() for one.
  void add(const ProfileSample& sample, bool belongs) {
    samples_[size_] = sample;
    size_ += static_cast<std::size_t>(belongs);
  }
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t room() const { return samples_.size() - size_; }
  [[nodiscard]] const ProfileSample* begin() const { return samples_.data(); }
  [[nodiscard]] const ProfileSample* end() const { return samples_.data() + size_; }

 private:
  std::array<ProfileSample, kMaxSamples> samples_;  // 5 KB that nobody needs cleared
  std::size_t size_ = 0;
};

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
  const bool upright = std::abs(tangent_u) < 0.1;
  const double inverse_u = upright ? 0.0 : 1.0 / tangent_u;
  const double span_u = upright ? 1e6 : half * std::abs(inverse_u) + 1.0;
  for (std::int32_t v = top; v <= bottom; ++v) {
    const std::uint16_t* const line = picture.line(v);
    const double dv = v - arc.v_px;
    // Of a slanted piece's box most pixels lie beyond its ends: a line is walked between them.
    const double middle = arc.u_px - tangent_v * dv * inverse_u;
    const auto first = static_cast<std::int32_t>(std::max<double>(left, middle - span_u));
    const auto last = static_cast<std::int32_t>(std::min<double>(right, middle + span_u));
    if (std::cmp_greater(last - first + 1, profile.room())) {
      break;
    }
    for (std::int32_t u = first; u <= last; ++u) {
      const double du = u - arc.u_px;
      const double x = tangent_u * du + tangent_v * dv;
      const double y = arc.normal_u * du + arc.normal_v * dv - (arc.slope + arc.bend * x) * x;
      profile.add({y, line[u] * (1.0 / kGreyScale)},
                  (std::abs(x) <= half) & (std::abs(y) <= reach_px));
    }
  }
  return true;
}

/// The profile in steps of half a pixel.
class CoarseProfile {
 public:
  CoarseProfile(const Profile& profile, double reach_px) : reach_px_(reach_px) {
    for (const ProfileSample& sample : profile) {
      const auto bin = static_cast<std::int32_t>((sample.distance + reach_px) * (1.0 / kStep_px));
      if (bin >= 0 && bin < kBins) {
        sums_[static_cast<std::size_t>(bin)] += sample.grey;
        counts_[static_cast<std::size_t>(bin)] += 1.0;
      }
    }
    bins_ = std::min(kBins, static_cast<std::int32_t>(2.0 * reach_px / kStep_px));
    sum_levels();
  }

  /// Where the first clear rise from the inside outwards is steepest; false without any.
  bool find_rise(double search_px, double least_contrast, double& place_px) const {
    const auto first =
        std::max(kHalf, static_cast<std::int32_t>(std::ceil((reach_px_ - search_px) / kStep_px)));
    const auto last = std::min(
        bins_ - kHalf, static_cast<std::int32_t>(std::floor((reach_px_ + search_px) / kStep_px)));
    double best = 0.0;
    for (std::int32_t i = first; i <= last; ++i) {
      best = std::max(best, rise(i));
    }
    for (std::int32_t i = first; i <= last && best >= least_contrast; ++i) {
      const double here = rise(i);
      if (here >= 0.6 * best && (i + kHalf >= bins_ || here >= rise(i + 1))) {
        place_px = i * kStep_px - reach_px_;
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kStep_px = 0.5;
  static constexpr std::int32_t kBins = 48;
  static constexpr std::int32_t kHalf = 3;  // of the rise: 1.5 px to either side

  /// Bins without a pixel take the level of the one before, the first ones that of the next.
  void sum_levels() {
    double level = 0.0;
    for (std::size_t k = 0; k < kBins && level == 0.0; ++k) {
      level = counts_[k] > 0.0 ? sums_[k] / counts_[k] : 0.0;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(bins_); ++k) {
      level = counts_[k] > 0.0 ? sums_[k] / counts_[k] : level;
      running_[k + 1] = running_[k] + level;
    }
  }
  /// Mean of the three bins from `i` on.
  [[nodiscard]] double mean(std::int32_t i) const {
    const auto k = static_cast<std::size_t>(i);
    return (running_[k + kHalf] - running_[k]) * (1.0 / kHalf);
  }
  /// From before to after place `i`.
  [[nodiscard]] double rise(std::int32_t i) const { return mean(i) - mean(i - kHalf); }

  double reach_px_;
  std::int32_t bins_ = 0;
  std::array<double, kBins> sums_{};
  std::array<double, kBins> counts_{};
  std::array<double, kBins + 1> running_{};  ///< sums of the bins' levels
};

/// Sums over the window of a step's share s and slope g and of the grey level y: all that the least
/// squares need of its samples, whatever the levels of dark and bright.
struct StepSums {
  double n = 0.0;
  double s = 0.0;
  double ss = 0.0;
  double g = 0.0;
  double gs = 0.0;
  double gg = 0.0;
  double y = 0.0;
  double ys = 0.0;
  double yg = 0.0;
  double yy = 0.0;
};

/// The samples from `inner_px` inside a place to `outer_px` outside it, by their distance from it.
void take_window(const Profile& profile, double place_px, double inner_px, double outer_px,
                 Profile& window) {
  window.clear();
  for (const ProfileSample& sample : profile) {
    const double x = sample.distance - place_px;
    window.add({x, sample.grey}, (x >= -inner_px) & (x <= outer_px));
  }
}

StepSums sum_step(const Profile& window, double blur_px) {
  const double inverse_blur = 1.0 / blur_px;
  StepSums sums;
  sums.n = static_cast<double>(window.size());
  for (const ProfileSample& sample : window) {
    const math::GaussianStep step = math::gaussian_step(sample.distance * inverse_blur);
    const double grey = sample.grey;
    sums.s += step.share;
    sums.ss += step.share * step.share;
    sums.g += step.slope;
    sums.gs += step.slope * step.share;
    sums.gg += step.slope * step.slope;
    sums.y += grey;
    sums.ys += grey * step.share;
    sums.yg += grey * step.slope;
    sums.yy += grey * grey;
  }
  return sums;
}

/// Least squares of dark + (bright - dark) Phi((d - offset) / blur) in one move from the sums at
/// `edge.offset_px`: the levels alone first, without which the place has no slope, then all three
/// together. False when the samples don't determine them.
bool move_edge(const StepSums& sums, const ArcEdgeOptions& options, ArcEdge& edge,
               double& move_px) {
  const double determinant = sums.n * sums.ss - sums.s * sums.s;
  if (!(determinant > 1e-9 * sums.n * sums.ss)) {
    return false;
  }
  const double dark = (sums.ss * sums.y - sums.s * sums.ys) / determinant;
  const double contrast = (sums.n * sums.ys - sums.s * sums.y) / determinant;
  const double by_move = -contrast / options.blur_px;
  Eigen::Matrix3d normal;  // of dark, contrast and move: the lower triangle counts
  normal << sums.n, 0.0, 0.0, sums.s, sums.ss, 0.0, by_move * sums.g, by_move * sums.gs,
      by_move * by_move * sums.gg;
  math::Cholesky<3> cholesky;
  if (!cholesky.factor(normal)) {
    return false;
  }
  // With the best levels only the move's own sum of residuals is left.
  const double right = by_move * (sums.yg - dark * sums.g - contrast * sums.gs);
  const Eigen::Vector3d change = cholesky.solve(Eigen::Vector3d(0.0, 0.0, right));
  const double squares = std::max(0.0, sums.yy - dark * sums.y - contrast * sums.ys);
  edge.dark = dark + change(0);
  edge.bright = edge.dark + contrast + change(1);
  edge.rms_grey = std::sqrt(squares / sums.n);
  const double noise = std::max(options.noise_grey, edge.rms_grey);
  edge.sigma_px = noise * cholesky.forward(Eigen::Vector3d::UnitZ())(2);
  move_px = std::clamp(change(2), -1.0, 1.0);
  edge.offset_px += move_px;
  return true;
}

ArcEdge fit_blurred_step(const Profile& profile, double start_px, const ArcEdgeOptions& options) {
  constexpr int kMoves = 6;
  constexpr std::size_t kFewestSamples = 10;
  constexpr double kSettled_px = 3e-3;  // each move is a tenth of the one before, or less
  ArcEdge edge;                         // from the start until it has settled
  Profile around;
  Profile window;
  take_window(profile, start_px, options.inner_px + kFarthest_px, options.outer_px + kFarthest_px,
              around);
  for (int i = 0; i < kMoves; ++i) {
    take_window(around, edge.offset_px, options.inner_px, options.outer_px, window);
    double move_px = 0.0;
    if (window.size() < kFewestSamples ||
        !move_edge(sum_step(window, options.blur_px), options, edge, move_px)) {
      return {ArcRefusal::kNoFit};
    }
    if (i > 0 && std::abs(move_px) < kSettled_px) {
      break;
    }
  }
  edge.offset_px += start_px;
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
  } else if (std::abs(edge.offset_px - start_px) > kFarthest_px ||
             std::abs(edge.offset_px) > options.search_px) {
    edge.refusal = ArcRefusal::kNoFit;
  } else if (is_saturated(profile, edge.offset_px)) {
    edge.sigma_px = std::hypot(edge.sigma_px, options.bloom_px);
  }
  return edge;
}

}  // namespace tubesight::core::picture
