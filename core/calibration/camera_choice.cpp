#include "core/calibration/camera_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace tubesight::core::calibration {
namespace {

constexpr double kAsksForTwo = 29.0;

/// What is freed where the residuals ask for it. The sum of squares falls by about sigma^2 for an
/// unknown that means nothing. 25 times that are five standard deviations of one; by chance as rare
/// are 29 of two and 32 of three.
struct Candidate {
  bool FitOptions::*option;
  double asks_for_it;
};
constexpr std::array<Candidate, 3> kCandidates = {{{&FitOptions::distortion2, 25.0},
                                                   {&FitOptions::tangential, kAsksForTwo},
                                                   {&FitOptions::bow, 32.0}}};

// Tangential distortion of real lenses: p EFL below this.
constexpr double kMostTangential = 0.005;

// A pattern of the residuals is told beyond so many standard deviations of what noise leaves.
constexpr double kPatternSigmas = 6.0;
// Dots beyond so many standard deviations are left out; one in five million is by chance.
constexpr double kOutlier = 6.0;

/// Leaves out dots that lie off; how many there are now.
std::int32_t leave_out(CalibrationData& data, double sigma_px) {
  std::int32_t count = 0;
  const double gate = std::max(kOutlier * sigma_px, 0.02);
  for (SeenDot& dot : data.dots) {
    dot.used = dot.residual_px.cwiseAbs().maxCoeff() <= gate;
    count += dot.used ? 0 : 1;
  }
  return count;
}

bool is_patterned(const ResidualPattern& pattern) {
  return pattern.ratio > 1.0 + kPatternSigmas * pattern.spread;
}

/// Frees what of the candidates explains the residuals far better than chance would, the most
/// telling first: a bow freed too early would take up what is the lens'.
void free_what_is_asked_for(std::span<const Candidate> candidates, CalibrationData& data,
                            CalibrationState& state, FitScratch& scratch,
                            CalibrationOutcome& outcome) {
  for (std::size_t round = 0; round < candidates.size(); ++round) {
    FitOptions best;
    double most = 0.0;
    for (const Candidate& candidate : candidates) {
      FitOptions options = outcome.freed;
      if (options.*candidate.option) {
        continue;
      }
      options.*candidate.option = true;
      const double gain = promised_gain(options, data, state, scratch);
      // What chance leaves once the gain is gone from the sum.
      const double sigma2 =
          (outcome.fit.sum_px2 - gain) / (2.0 * outcome.fit.dots - outcome.fit.unknowns);
      if (gain > candidate.asks_for_it * sigma2 && gain > most) {
        best = options;
        most = gain;
      }
    }
    if (!(most > 0.0)) {
      return;
    }
    scratch.more = state;
    const FitOutcome fit = fit_camera(best, data, scratch.more, scratch);
    if (!fit.converged || !fit.determined) {
      outcome.fit = fit_camera(outcome.freed, data, state, scratch);  // the residuals again
      return;
    }
    state = scratch.more;
    outcome.fit = fit;
    outcome.freed = best;
  }
}

/// Holds k2 at 0 again where it turns out to be nothing once all is fitted and cleaned.
void hold_second_distortion(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                            CalibrationOutcome& outcome) {
  const double k2 = state.camera(5);
  const double variance = outcome.fit.camera_covariance(5, 5);
  if (!outcome.freed.distortion2 || k2 * k2 > kCandidates[0].asks_for_it * variance) {
    return;
  }
  outcome.freed.distortion2 = false;
  state.camera(5) = 0.0;
  outcome.fit = fit_camera(outcome.freed, data, state, scratch);
  clean(data, state, scratch, outcome, outcome.freed);
}

/// Frees k2, a bow and tangential distortion where the residuals ask for them; the latter two only
/// if noise alone is left then. Paper that is bent anyhow asks for everything.
void free_all_that_is_asked_for(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                                CalibrationOutcome& outcome) {
  const auto all = std::span(kCandidates);
  // A dot that is none bends the lens towards itself: it asks for k2 until it is left out.
  clean(data, state, scratch, outcome, outcome.freed);
  const CalibrationOutcome before = outcome;
  scratch.before = state;
  free_what_is_asked_for(all, data, state, scratch, outcome);
  clean(data, state, scratch, outcome, outcome.freed);
  hold_second_distortion(data, state, scratch, outcome);
  if ((outcome.freed.bow || outcome.freed.tangential) && is_patterned(residual_pattern(data))) {
    outcome = before;
    outcome.left_out = 0;
    state = scratch.before;
    for (SeenDot& dot : data.dots) {
      dot.used = true;
    }
    outcome.fit = fit_camera(outcome.freed, data, state, scratch);
    free_what_is_asked_for(all.first(1), data, state, scratch, outcome);
    clean(data, state, scratch, outcome, outcome.freed);
    hold_second_distortion(data, state, scratch, outcome);
  }
}

/// Where the errors hang together, the parameters follow that part of them: the covariance is for
/// the mean square of it, which is larger than that of all.
void count_pattern(const CalibrationData& data, CalibrationOutcome& outcome) {
  outcome.pattern = residual_pattern(data);
  outcome.patterned = is_patterned(outcome.pattern);
  const double sigma2 = outcome.fit.sigma_px * outcome.fit.sigma_px;
  outcome.grown = outcome.patterned ? std::max(1.0, outcome.pattern.mean_px2 / sigma2) : 1.0;
  outcome.fit.camera_covariance *= outcome.grown;
}

/// A lens with tangential distortion: what it has, and the best camera without it.
void drop_tangential(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                     CalibrationOutcome& outcome) {
  if (!outcome.freed.tangential) {
    return;
  }
  const CalibrationState lens = state;
  outcome.tangential.p = lens.tangential;
  state.tangential.setZero();
  FitOptions without = outcome.freed;
  without.tangential = false;
  // How well the rest is known is told by the fit that leaves noise.
  const math::Matrix6d covariance = outcome.fit.camera_covariance;
  outcome.fit = fit_camera(without, data, state, scratch);
  outcome.fit.camera_covariance = covariance;
  outcome.tangential.map = map_difference(data.sensor, state.camera, lens.camera, lens.tangential);
}

/// Two heights alone don't tell a stage that leans from a lens with tangential distortion. Where
/// both explain the dots and a real lens may have as much, what that would change counts.
void find_rival(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                CalibrationOutcome& outcome) {
  if (!outcome.freed.stage_axis || outcome.freed.tangential) {
    return;
  }
  FitOptions options = outcome.freed;
  options.stage_axis = false;
  options.tangential = true;
  scratch.more = state;
  const FitOutcome fit = fit_camera(options, data, scratch.more, scratch);
  const double likely = kMostTangential / state.camera(0);
  if (fit.converged && fit.determined && scratch.more.tangential.norm() < likely &&
      fit.sum_px2 - outcome.fit.sum_px2 < kAsksForTwo * fit.sigma_px * fit.sigma_px) {
    outcome.tangential.rival = true;
    outcome.tangential.p = scratch.more.tangential;
    outcome.tangential.map =
        map_difference(data.sensor, state.camera, scratch.more.camera, scratch.more.tangential);
  }
  outcome.fit = fit_camera(outcome.freed, data, state, scratch);  // the residuals again
}

}  // namespace

void clean(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
           CalibrationOutcome& outcome, const FitOptions& options) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const std::int32_t before = outcome.left_out;
    outcome.left_out = leave_out(data, outcome.fit.sigma_px);
    if (outcome.left_out == before) {
      return;
    }
    outcome.fit = fit_camera(options, data, state, scratch);
  }
}

void choose_model(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                  CalibrationOutcome& outcome) {
  free_all_that_is_asked_for(data, state, scratch, outcome);
  find_rival(data, state, scratch, outcome);
  count_pattern(data, outcome);
  drop_tangential(data, state, scratch, outcome);
}

}  // namespace tubesight::core::calibration
