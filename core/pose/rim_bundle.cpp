#include "core/pose/rim_bundle.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/math/rotation.h"

namespace tubesight::core::pose {
namespace {

using SheetTool = Transform<frames::Sheet, frames::Tool>;

// A first pass makes do with every third point of rims that have this many.
constexpr std::size_t kFirstStride = 3;
// Until the picture has told how far centres are off, they may be off by this.
constexpr double kFirstCenterSigma_mm = 0.05;

// Passes end when a step was below a fifth of a standard deviation (this is its square): each is a
// third of the one before.
constexpr double kSettled = 0.04;
// How often the spread of centres is found anew from one pass over the points.
constexpr int kSpreadRounds = 3;

// The limit of Tukey's weights from the median distance, over all tube-ends in use.
void update_limit(RimProblem& problem, PlanePointBuffer& points, RimBundleWorkspace& workspace) {
  std::size_t count = 0;
  for (std::int32_t i = 0; i < points.rims; ++i) {
    if (workspace.rims[static_cast<std::size_t>(i)].used) {
      const std::span<const PlanePoint> rim = points.of(i);
      const std::size_t stride = problem.stride_for(rim.size());
      for (std::size_t k = 0; k < rim.size(); k += stride) {
        workspace.residuals[count++] = static_cast<float>(std::abs(rim[k].residual_px));
      }
    }
  }
  const auto begin = workspace.residuals.begin();
  const auto middle = begin + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, middle, begin + static_cast<std::ptrdiff_t>(count));
  const double median = count > 0 ? static_cast<double>(*middle) : 0.0;
  problem.limit_px =
      problem.options->outlier_sigmas * std::max(1.4826 * median, problem.options->least_point_px);
}

// Tukey's weights shorten the tails: the mean weighted square of a normal variable is this share of
// its variance, c being the limit in sigmas.
double tukey_share(double c) {
  const double c2 = c * c;
  return (1.0 - 6.0 / c2 + 15.0 / (c2 * c2)) / (1.0 - 2.0 / c2 + 3.0 / (c2 * c2));
}

// Scale of the points' deviations: weighted squares per degree of freedom.
void update_scale(RimProblem& problem, std::span<const RimState> rims) {
  if (problem.options->point_sigma_fixed) {
    return;
  }
  double square = 0.0;
  double freedom = -7.0;
  for (const RimState& rim : rims) {
    if (rim.used) {
      square += rim.square;
      freedom += rim.weight - 3.0;
    }
  }
  const double share = problem.limit_px > 0.0 ? tukey_share(problem.options->outlier_sigmas) : 1.0;
  if (freedom > 1.0) {
    problem.scale2 = std::max(square / (freedom * share), 1e-6);
  }
}

// Rims that don't belong to the sheet: too few points agree, far smaller or larger than a bore, or
// displaced far beyond what the others are. Not below three.
void drop_rims(const RimProblem& problem, PlanePointBuffer& points, RimBundleWorkspace& workspace) {
  std::array<float, kMaxTubesInView> sizes{};
  std::size_t count = 0;
  const std::span<RimState> rims(workspace.rims.data(), static_cast<std::size_t>(points.rims));
  for (const RimState& rim : rims) {
    if (rim.used) {
      sizes[count++] = static_cast<float>(rim.displacement_mm.norm());
    }
  }
  if (count <= 3) {
    return;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(count));
  const double far = std::max(6.0 * static_cast<double>(*middle), 0.1);
  for (std::size_t i = 0; i < rims.size(); ++i) {
    RimState& rim = rims[i];
    if (!rim.used || count <= 3) {
      continue;
    }
    const auto measured = static_cast<double>(points.of(static_cast<std::int32_t>(i)).size());
    const double off = std::abs(rim.radius_mm - 0.5 * problem.model->bore_mm);
    if (rim.weight < 0.4 * measured || rim.points < problem.options->min_points ||
        off > 6.0 * problem.options->radius_sigma_mm || rim.displacement_mm.norm() > far) {
      rim.used = false;
      --count;
    }
  }
}

void begin_fit(const PoseModel& model, const picture::RimList& rims,
               const RimBundleOptions& options, const SheetTool& start,
               RimBundleWorkspace& workspace, RimProblem& problem) {
  problem.model = &model;
  problem.options = &options;
  problem.R_sheet_tool = start.rotation();
  problem.tip_mm = start.translation_mm();
  problem.radius_sigma_mm = options.radius_sigma_mm;
  problem.center_sigma_mm = options.center_sigma_fixed
                                ? options.center_sigma_mm
                                : std::max(options.center_sigma_mm, kFirstCenterSigma_mm);
  for (std::int32_t i = 0; i < rims.size(); ++i) {
    RimState& rim = workspace.rims[static_cast<std::size_t>(i)];
    rim.used = rims[i].points.size() >= options.min_points;
    rim.center_mm = model.center_mm(rims[i].address);
    rim.radius_mm = 0.5 * model.bore_mm;
    rim.displacement_mm.setZero();
    rim.points = 0;
  }
}

void finish_fit(const RimProblem& problem, std::span<const RimState> rims,
                const SharedMatrix& covariance, const PlanePointBuffer& points, RimFit& result) {
  result.solved = true;
  result.T_sheet_tool = {math::orthonormal(problem.R_sheet_tool), problem.tip_mm};
  result.covariance = covariance.topLeftCorner<6, 6>();
  result.edge_offset_px = problem.offset_px;
  result.point_scale = std::sqrt(problem.scale2);
  result.center_sigma_mm = problem.center_sigma_mm;
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    if (!rims[i].used) {
      continue;
    }
    ++result.tubes;
    result.points += rims[i].points;
    const auto begin = static_cast<std::size_t>(points.first[i]);
    const auto end = static_cast<std::size_t>(points.first[i + 1]);
    for (std::size_t k = begin; k < end; ++k) {
      const PlanePoint& p = points.points[k];
      sum += p.robust * p.residual_px * p.residual_px;
      weight += p.robust;
    }
  }
  result.rms_px = weight > 0.0 ? std::sqrt(sum / weight) : 0.0;
}

}  // namespace

RimFit fit_rims(const PoseModel& model, const picture::RimList& rims, const SheetTool& start,
                const RimBundleOptions& options, PlanePointBuffer& points,
                RimBundleWorkspace& workspace) {
  RimProblem problem;
  begin_fit(model, rims, options, start, workspace, problem);
  const std::span<RimState> states(workspace.rims.data(), static_cast<std::size_t>(rims.size()));
  RimFit result;
  RimStep step;
  for (std::int32_t pass = 0; pass < options.max_passes; ++pass) {
    const Sight sight = sight_of(problem);
    problem.stride = pass == 0 ? kFirstStride : 1;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i].used) {
        accumulate(problem, sight, points.of(static_cast<std::int32_t>(i)), states[i]);
      }
    }
    const bool spread_known = pass < 2 || options.center_sigma_fixed;
    if (pass >= 2) {
      drop_rims(problem, points, workspace);
      update_scale(problem, states);
    }
    step = solve_step(problem, states, spread_known ? 0 : kSpreadRounds);
    if (!step.solved || !(step.size2 < 1e12)) {
      return result;
    }
    apply_step(problem, states, step.change);
    update_limit(problem, points, workspace);
    if (pass >= 2 && step.size2 < kSettled) {
      break;
    }
  }
  finish_fit(problem, states, step.covariance, points, result);
  return result;
}

}  // namespace tubesight::core::pose
