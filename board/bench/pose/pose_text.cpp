#include "board/bench/pose/pose_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Core>

#include "board/bench/pose/pose_words.h"
#include "core/math/rotation.h"
#include "core/pose/tool_answer.h"
#include "core/verification/position_correction.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using drivers::print;

using core::TubeState;

constexpr double kDegrees = 180.0 / std::numbers::pi;

double sigma(const PoseRow& row, int i) { return std::sqrt(std::max(0.0, row.covariance(i, i))); }

/// Standard deviation of the place where the guidetube's axis meets the sheet, along the larger of
/// its two main directions.
double offset_sigma_mm(const PoseRow& row) {
  const Eigen::Matrix2d covariance =
      core::verification::axis_covariance(row.estimate->T_sheet_tool, row.covariance);
  const double difference = (covariance(0, 0) - covariance(1, 1)) / 2.0;
  return std::sqrt(
      std::max(0.0, covariance.trace() / 2.0 + std::hypot(difference, covariance(0, 1))));
}

/// Of the guidetube's tilt, the mean of its two directions, rad.
double tilt_sigma_rad(const PoseRow& row) {
  return std::sqrt(std::max(0.0, row.covariance.block<2, 2>(3, 3).trace() / 2.0));
}

void print_six(std::string& out, const char* name, const Eigen::Vector3d& place,
               const Eigen::Matrix3d& rotation) {
  const auto angles = core::math::angles_of(rotation);
  print(out, "  %s   x %.4f  y %.4f  z %.4f mm   alpha %.4f  beta %.4f  gamma %.4f deg\n", name,
        place.x(), place.y(), place.z(), angles[0] * kDegrees, angles[1] * kDegrees,
        angles[2] * kDegrees);
}

void print_tool(std::string& out, const PoseFacts& facts) {
  const core::pose::PoseEstimate& pose = *facts.row.estimate;
  print_six(out, "tool in the sheet  ", pose.T_sheet_tool.translation_mm(),
            pose.T_sheet_tool.rotation());
  const Eigen::Vector3d angles = angle_sigmas(pose.T_sheet_tool.rotation(), facts.row.covariance);
  print(out,
        "    one sigma%s      %.4f    %.4f    %.4f mm         %.4f       %.4f        %.4f deg\n",
        facts.total ? ", total" : "       ", sigma(facts.row, 0), sigma(facts.row, 1),
        sigma(facts.row, 2), angles(0) * kDegrees, angles(1) * kDegrees, angles(2) * kDegrees);
  const core::pose::TubeOffset offset =
      core::pose::offset_from(facts.model, pose.T_sheet_tool, pose.nearest);
  const TubeState state = facts.map.state(pose.nearest);
  std::string where = "under a tube of the lattice";
  if (!facts.middle_px) {
    where = state == TubeState::kAbsent ? "where no tube stands, at" : "under tube";
    print(where, " (%d, %d)%s", pose.nearest.row, pose.nearest.column,
          state == TubeState::kPlugged ? ", plugged" : "");
  }
  print(out,
        "  guidetube            %s: offset %.4f mm (dx %.4f, dy %.4f; sigma %.4f), "
        "tilt %.4f deg (sigma %.4f), tip %.4f mm below the sheet\n",
        where.c_str(), offset.distance_mm, offset.offset_mm.x(), offset.offset_mm.y(),
        offset_sigma_mm(facts.row), offset.tilt_rad * kDegrees,
        tilt_sigma_rad(facts.row) * kDegrees, -pose.T_sheet_tool.translation_mm().z());
}

/// Tube-ends that were looked for and did not count, by reason.
void print_left_out(std::string& out, const core::pose::PictureOutcome& outcome) {
  std::map<std::string, std::string> by_reason;
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    if (!tube.used && tube.finding != core::picture::RimFinding::kTooSmall &&
        tube.finding != core::picture::RimFinding::kOutside) {
      const bool measured = tube.finding == core::picture::RimFinding::kMeasured ||
                            tube.finding == core::picture::RimFinding::kPartly;
      const std::string reason(tube.rim >= 0 ? "measured, but at odds with the others"
                               : measured    ? "measured, beyond what one pose takes"
                                             : explain(tube.finding));
      print(by_reason[reason], " (%d, %d)", tube.address.row, tube.address.column);
    }
  }
  for (const auto& [reason, tubes] : by_reason) {
    out += "    left out, " + reason + ":" + tubes + '\n';
  }
}

}  // namespace

std::string pose_text(const PoseFacts& facts) {
  const core::pose::PoseEstimate& pose = *facts.row.estimate;
  std::string out = facts.row.image;
  if (facts.pictures > 1) {
    print(out, ": average of %d pictures, at rest within %.3f px", facts.pictures,
          facts.frame_shift_px);
  }
  out += '\n';
  if (facts.middle_px) {
    print(out,
          "  no address was given: the sheet's frame begins at the tube-end at (%.1f, %.1f) px, "
          "which is called (0, 0), and its directions are a choice\n",
          (*facts.middle_px)[0], (*facts.middle_px)[1]);
  }
  if (facts.row.has_tool) {
    print_tool(out, facts);
  }
  print_six(out, "sheet in the camera", pose.T_camera_sheet.translation_mm(),
            pose.T_camera_sheet.rotation());
  print(out,
        "  tube-ends            %d used of %d looked for, %d edge points, RMS %.3f px across the "
        "edge, edges %+.3f px off\n",
        pose.tubes, facts.outcome.tubes.size(), pose.points, pose.rms_px, pose.edge_offset_px);
  print_left_out(out, facts.outcome);
  return out;
}

std::string correction_text(const core::verification::PositionCorrection& correction,
                            const core::verification::CorrectionRequest& request) {
  std::string out;
  const Eigen::Vector3d& move = correction.move.translation_mm();
  print(out,
        "  correction           to tube (%d, %d): move the tool by x %.4f  y %.4f  z %.4f mm in "
        "its own axes (%.4f mm)\n",
        request.tube.row, request.tube.column, move.x(), move.y(), move.z(),
        correction.distance_mm);
  print(out,
        "    now %.3f mm off, within %.3f mm for sure: %s the limit of %.3f mm; after the move "
        "within %.3f mm: %s\n",
        correction.offset_mm, correction.offset_bound_mm,
        correction.met_now ? "meets" : "does not meet", request.limit_mm, correction.left_mm,
        correction.met_after ? "meets it" : "does not meet it");
  return out;
}

}  // namespace tubesight::board
