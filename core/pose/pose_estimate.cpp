#include "core/pose/pose_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/pose/pose_seed.h"
#include "core/pose/tool_answer.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

// A bore seen this much larger or smaller than it is: the addresses' scale is wrong.
constexpr double kBoreTolerance = 0.15;
// A tube-end this share of the shortest step beside its place stands at another address.
constexpr double kAddressShare = 0.25;

PoseRefusal check_addresses(const PoseModel& model, const picture::RimList& rims) {
  for (std::int32_t i = 0; i < rims.size(); ++i) {
    if (!model.lattice.has(rims[i].address)) {
      return PoseRefusal::kAddressesContradict;
    }
    for (std::int32_t j = 0; j < i; ++j) {
      if (rims[i].address == rims[j].address) {
        return PoseRefusal::kAddressesContradict;
      }
    }
  }
  return PoseRefusal::kNone;
}

// Millimetres of the sheet to a pixel at a seed, roughly: the depth over the greater scale.
double mm_per_px(const PoseModel& model, const CameraSheet& T, const PoseSeeds& seeds) {
  double depth = 0.0;
  for (const PointPair& pair : seeds.pairs) {
    depth = std::max(depth, (T * pair.object_mm).z());
  }
  return depth / model.camera.parameters().scale_px.x;
}

// Whether every ellipse lies where the seed puts its tube-end, to a share of the lattice's step.
bool places_fit(const PoseModel& model, const CameraSheet& T, const PoseSeeds& seeds) {
  const double limit = kAddressShare * model.lattice.parameters().shortest_step;
  const double to_mm = model.camera.parameters().scale_px.x * mm_per_px(model, T, seeds);
  return std::all_of(seeds.pairs.begin(), seeds.pairs.end(), [&](const PointPair& pair) {
    const Eigen::Vector3d p = T * pair.object_mm;
    return p.z() > 0.0 && (p.head<2>() / p.z() - pair.plane).norm() * to_mm < limit;
  });
}

// Whether the ellipses are as large as bores at the seed: addresses of another pitch are found so.
bool bores_fit(const PoseModel& model, const CameraSheet& T, const PoseSeeds& seeds) {
  const double nominal = 0.5 * model.bore_mm;
  double sum = 0.0;
  for (const SeenCircle& circle : seeds.circles) {
    sum += apparent_radius(T, circle, nominal) / static_cast<double>(seeds.circles.size());
  }
  return std::abs(sum / nominal - 1.0) < kBoreTolerance;
}

// Leaves out candidates that see the sheet from behind, or tube-ends elsewhere or of another size.
void keep_upright(const PoseModel& model, PoseSeeds& seeds) {
  std::int32_t kept = 0;
  for (const PoseCandidate& candidate : seeds.candidates) {
    if (candidate.T_camera_sheet.rotation()(2, 2) > 0.0 &&
        places_fit(model, candidate.T_camera_sheet, seeds) &&
        bores_fit(model, candidate.T_camera_sheet, seeds)) {
      seeds.candidates[kept++] = candidate;
    }
  }
  seeds.candidates.truncate(kept);
}

// The best candidate fitted, and what the others came to.
struct Contest {
  RimFit fit;
  double second_rms_px = 0.0;
  bool ambiguous = false;
};

// Whether two fits ended at one pose, as well. What they took for outliers may differ, and with it
// the pose by some of its standard deviations.
bool same_pose(const RimFit& a, const RimFit& b, double rms_ratio) {
  constexpr double kSigmas = 3.0;
  const auto spread = [&](Eigen::Index from) {
    const double of_a = a.covariance.block<3, 3>(from, from).trace();
    const double of_b = b.covariance.block<3, 3>(from, from).trace();
    return kSigmas * std::sqrt(std::max(of_a, of_b));
  };
  const Eigen::Vector3d apart_mm =
      a.T_sheet_tool.translation_mm() - b.T_sheet_tool.translation_mm();
  const Eigen::Matrix3d turned = a.T_sheet_tool.rotation() - b.T_sheet_tool.rotation();
  const auto rms = std::minmax(a.rms_px, b.rms_px);
  return rms.second < rms_ratio * rms.first && apart_mm.norm() < 0.05 + spread(0) &&
         turned.norm() < 2e-3 + spread(3);
}

// Fits the first candidate, and any other that the ellipses' centres don't rule out: one whose RMS
// is within twice the first's plus a pixel, which is what eccentricity may hide.
Contest fit_candidates(const PoseModel& model, const picture::RimList& rims,
                       const PoseOptions& options, PoseWorkspace& workspace) {
  const PoseSeeds& seeds = workspace.seeds;
  const auto fit_from = [&](std::int32_t i) {
    const CameraSheet& T = seeds.candidates[i].T_camera_sheet;
    return fit_rims(model, rims, tool_pose(T, model.T_camera_tool), options.rims, workspace.points,
                    workspace.bundle);
  };
  const double scale_px = model.camera.parameters().scale_px.x;
  Contest contest;
  contest.fit = fit_from(0);
  double rival_px = std::numeric_limits<double>::max();
  std::int32_t best = 0;
  std::int32_t last = 0;
  for (std::int32_t i = 1; i < seeds.candidates.size(); ++i) {
    const double rms_px = seeds.candidates[i].rms * scale_px;
    if (rms_px > 2.0 * seeds.candidates[0].rms * scale_px + 1.0) {
      contest.second_rms_px = contest.second_rms_px > 0.0 ? contest.second_rms_px : rms_px;
      continue;
    }
    RimFit other = fit_from(i);
    last = i;
    if (!other.solved) {
      continue;
    }
    const bool same = contest.fit.solved && same_pose(other, contest.fit, options.ambiguity_ratio);
    if (!contest.fit.solved || other.rms_px < contest.fit.rms_px) {
      std::swap(contest.fit, other);
      best = i;
    }
    if (same) {
      continue;
    }
    if (other.solved && other.points > contest.fit.points * 4 / 5) {
      rival_px = std::min(rival_px, other.rms_px);
    }
    contest.second_rms_px = other.rms_px;
  }
  contest.ambiguous = rival_px < options.ambiguity_ratio * contest.fit.rms_px;
  if (best != last) {
    contest.fit = fit_from(best);  // leaves its rims in the workspace
  }
  return contest;
}

void report_rims(const PoseModel& model, const picture::RimList& rims,
                 const CameraSheet& T_camera_sheet, PoseWorkspace& workspace,
                 PoseOutcome& outcome) {
  for (std::int32_t i = 0; i < rims.size(); ++i) {
    const RimState& state = workspace.bundle.rims[static_cast<std::size_t>(i)];
    RimVerdict verdict;
    verdict.address = rims[i].address;
    verdict.used = state.used;
    double sum = 0.0;
    double weight = 0.0;
    for (const PlanePoint& p : workspace.points.of(i)) {
      sum += p.robust * p.residual_px * p.residual_px;
      weight += p.robust;
      verdict.points_used += p.robust >= 0.5 ? 1 : 0;
    }
    verdict.rms_px = weight > 0.0 ? std::sqrt(sum / weight) : 0.0;
    verdict.diameter_mm = 2.0 * state.radius_mm;
    verdict.center_off_mm = {state.displacement_mm.x(), state.displacement_mm.y()};
    const Eigen::Vector2d center = model.center_mm(rims[i].address);
    const Eigen::Vector3d p = T_camera_sheet * Eigen::Vector3d(center.x(), center.y(), 0.0);
    const auto pixel = model.camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
    if (pixel) {
      verdict.center_px = {pixel->x, pixel->y};
    }
    static_cast<void>(outcome.rims.try_push_back(verdict));
  }
}

void fill_estimate(const PoseModel& model, const RimFit& fit, PoseEstimate& estimate) {
  estimate.T_sheet_tool = fit.T_sheet_tool;
  estimate.T_camera_sheet = model.T_camera_tool * fit.T_sheet_tool.inverse();
  estimate.covariance = fit.covariance;
  estimate.rms_px = fit.rms_px;
  estimate.edge_offset_px = fit.edge_offset_px;
  estimate.point_scale = fit.point_scale;
  estimate.center_sigma_mm = fit.center_sigma_mm;
  estimate.tubes = fit.tubes;
  estimate.points = fit.points;
  const TubeOffset nearest = offset_from_nearest(model, estimate.T_sheet_tool);
  estimate.nearest = nearest.address;
  estimate.offset_mm = nearest.distance_mm;
}

// The mean radius of the rims in use, over the nominal one.
double bore_ratio(const PoseModel& model, std::span<const RimState> rims) {
  double sum = 0.0;
  double count = 0.0;
  for (const RimState& rim : rims) {
    if (rim.used) {
      sum += rim.radius_mm;
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count / (0.5 * model.bore_mm) : 1.0;
}

PoseRefusal judge(const PoseModel& model, const RimFit& fit, const PoseOptions& options,
                  std::span<const RimState> rims) {
  if (fit.tubes < std::max(options.min_tubes, 3)) {
    return PoseRefusal::kTooFewTubes;
  }
  if (std::abs(bore_ratio(model, rims) - 1.0) > kBoreTolerance) {
    return PoseRefusal::kAddressesContradict;
  }
  if (!(fit.rms_px <= options.max_rms_px)) {
    return PoseRefusal::kResidualTooLarge;
  }
  const double variance = std::max(fit.covariance(0, 0), fit.covariance(1, 1));
  if (!(variance <= options.max_sigma_mm * options.max_sigma_mm)) {
    return PoseRefusal::kIllConditioned;
  }
  return PoseRefusal::kNone;
}

// The comparison methods: n points from the best candidate on.
void by_centers(const PoseModel& model, const picture::RimList& rims, const PoseOptions& options,
                PoseWorkspace& workspace, PoseOutcome& outcome) {
  const RimFit fit = fit_centers(model, rims, workspace.seeds.candidates[0].T_camera_sheet,
                                 options.method, workspace.points, workspace.centers);
  if (!fit.solved) {
    outcome.refusal = PoseRefusal::kIllConditioned;
    return;
  }
  fill_estimate(model, fit, outcome.estimate);
  outcome.refusal = judge(model, fit, options, {});
}

}  // namespace

PoseOutcome estimate_pose(const PoseModel& model, const picture::RimList& rims,
                          const PoseOptions& options, PoseWorkspace& workspace) {
  PoseOutcome outcome;
  outcome.refusal = check_addresses(model, rims);
  if (!outcome.has_value()) {
    return outcome;
  }
  to_plane_points(model.camera, rims, workspace.points);
  PoseSeeds& seeds = workspace.seeds;
  outcome.refusal =
      find_seeds(model, rims, std::max(options.min_tubes, 3), workspace.points, seeds);
  if (!outcome.has_value()) {
    return outcome;
  }
  keep_upright(model, seeds);
  if (seeds.candidates.empty()) {
    outcome.refusal = PoseRefusal::kAddressesContradict;
    return outcome;
  }
  if (options.method != PoseMethod::kRims) {
    by_centers(model, rims, options, workspace, outcome);
    return outcome;
  }
  const Contest contest = fit_candidates(model, rims, options, workspace);
  const RimFit& fit = contest.fit;
  if (!fit.solved) {
    outcome.refusal = PoseRefusal::kIllConditioned;
    return outcome;
  }
  outcome.estimate.second_rms_px = contest.second_rms_px;
  fill_estimate(model, fit, outcome.estimate);
  report_rims(model, rims, outcome.estimate.T_camera_sheet, workspace, outcome);
  if (contest.ambiguous) {
    outcome.refusal = PoseRefusal::kAmbiguous;
    return outcome;
  }
  outcome.refusal = judge(model, fit, options,
                          {workspace.bundle.rims.data(), static_cast<std::size_t>(rims.size())});
  return outcome;
}

}  // namespace tubesight::core::pose
