#pragma once

#include <array>
#include <cstdint>

#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/math/small_matrix.h"
#include "core/picture/rim.h"
#include "core/pose/center_fit.h"
#include "core/pose/plane_points.h"
#include "core/pose/pose_kinds.h"
#include "core/pose/pose_model.h"
#include "core/pose/pose_seed.h"
#include "core/pose/rim_bundle.h"

namespace tubesight::core::pose {

/// How the pose is made.
struct PoseOptions {
  PoseMethod method = PoseMethod::kRims;
  std::int32_t min_tubes = 3;    ///< 3 at least
  double max_rms_px = 0.6;       ///< of the residuals across the edge
  double max_sigma_mm = 2.0;     ///< of the tool's x, y: larger is kIllConditioned
  double ambiguity_ratio = 2.0;  ///< the second pose's RMS must exceed the first's by this
  RimBundleOptions rims;
};

/// What became of one rim; in the order of the rims given.
struct RimVerdict {
  TubeAddress address;
  bool used = false;
  std::int32_t points_used = 0;
  double rms_px = 0.0;                    ///< of the used points across the edge
  double diameter_mm = 0.0;               ///< as fitted, the common edge offset taken out
  std::array<double, 2> center_px{};      ///< image of the tube-end's centre at the pose
  std::array<double, 2> center_off_mm{};  ///< the centre's own displacement as fitted, sheet
};

/// The pose, with what it is worth.
struct PoseEstimate {
  Transform<frames::Camera, frames::Sheet> T_camera_sheet;
  Transform<frames::Sheet, frames::Tool> T_sheet_tool;
  /// Of T_sheet_tool: x, y, z in mm and a rotation vector in rad, both in the sheet frame:
  /// R_true = exp([theta]x) R_sheet_tool. From the picture alone.
  math::Matrix6d covariance = math::Matrix6d::Zero();
  double rms_px = 0.0;           ///< of the used rim points across the edge
  double edge_offset_px = 0.0;   ///< common to all rims, outwards (blooming makes it negative)
  double point_scale = 1.0;      ///< the points' deviation as found, in units of their sigma_px
  double center_sigma_mm = 0.0;  ///< the tube-ends' own displacement as found, each of x and y
  std::int32_t tubes = 0;        ///< used
  std::int32_t points = 0;       ///< used
  double second_rms_px = 0.0;    ///< of the second planar solution; 0: there is none
  TubeAddress nearest;     ///< of the lattice, to the point where the guidetube's axis meets it
  double offset_mm = 0.0;  ///< its distance from that point
};

/// A pose or the reason against one.
struct PoseOutcome {
  PoseRefusal refusal = PoseRefusal::kNone;
  PoseEstimate estimate;  ///< valid with kNone; with kResidualTooLarge it tells the RMS found
  StaticVector<RimVerdict, kMaxTubesInView> rims;

  [[nodiscard]] bool has_value() const { return refusal == PoseRefusal::kNone; }
};

/// Scratch memory of estimate_pose(), some 1.3 MB, owned by the caller; nothing is kept in it from
/// one call to the next.
struct PoseWorkspace {
  PlanePointBuffer points;
  PoseSeeds seeds;
  RimBundleWorkspace bundle;
  CenterFitWorkspace centers;
};

/// The pose of the tool from the rims of one picture at rest [Fallon 5.1.2-5.2.4].
///
/// Closed-form planar pose from the ellipses' centres, both of its solutions examined, then the
/// method asked for. Same rims, same result, on one machine to the bit.
[[nodiscard]] PoseOutcome estimate_pose(const PoseModel& model, const picture::RimList& rims,
                                        const PoseOptions& options, PoseWorkspace& workspace);

}  // namespace tubesight::core::pose
