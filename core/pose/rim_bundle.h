#pragma once

#include <array>
#include <cstdint>

#include "core/base/sighting.h"
#include "core/base/transform.h"
#include "core/math/small_matrix.h"
#include "core/picture/rim.h"
#include "core/pose/plane_points.h"
#include "core/pose/pose_model.h"
#include "core/pose/rim_equations.h"

namespace tubesight::core::pose {

/// Scratch memory of fit_rims().
struct RimBundleWorkspace {
  std::array<RimState, kMaxTubesInView> rims;
  std::array<float, static_cast<std::size_t>(kMaxTubesInView) * picture::kMaxRimPoints> residuals;
};

/// How a fit of rims ended.
struct RimFit {
  bool solved = false;
  Transform<frames::Sheet, frames::Tool> T_sheet_tool;
  math::Matrix6d covariance = math::Matrix6d::Zero();
  double edge_offset_px = 0.0;
  double rms_px = 0.0;
  double point_scale = 1.0;
  double center_sigma_mm = 0.0;
  std::int32_t tubes = 0;
  std::int32_t points = 0;
};

/// Fits the pose to all rim points at once: circles of the lattice's centres in the sheet's plane.
///
/// Minimises over T_sheet_tool, the common edge offset b and, per tube-end, radius r and
/// displacement d, each held by its prior, the distances across the edge in the picture,
///   e = (|q - c - d| - r) / g - b,
/// where q is the point's ray met with the sheet and g the length of the gradient of |q - c - d| by
/// the pixel: the distance to the projected rim to first order, which is within e^2 / R of it (R
/// the rim's radius in the picture, px).
///
/// The perturbation is on the left, in the sheet frame: T = (exp([theta]x) R, p + tau); the
/// covariance is of (tau, theta). `start` should be within a few millimetres. Points far off are
/// left out by Tukey's weights, rims that don't agree with the others as a whole.
[[nodiscard]] RimFit fit_rims(const PoseModel& model, const picture::RimList& rims,
                              const Transform<frames::Sheet, frames::Tool>& start,
                              const RimBundleOptions& options, PlanePointBuffer& points,
                              RimBundleWorkspace& workspace);

}  // namespace tubesight::core::pose
