#include "board/bench/calibrate/tool_text.h"

#include <array>
#include <cmath>
#include <numbers>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/honest_text.h"
#include "board/bench/calibrate/tool_silhouette.h"
#include "core/math/covariance.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_text.h"
#include "drivers/settings/silhouette_settings.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

void append_focal(const ToolReport& report, std::string& text) {
  const FreedFocal& freed = *report.focal;
  drivers::print(text, "  EFL                   %.4f +- %.4f mm, freed from %.4f\n",
                 report.camera.focal_length_mm, std::sqrt(freed.covariance(0, 0)),
                 report.focal_before_mm);
  Eigen::Index most = 0;
  static_cast<void>(report.focal_correlation.cwiseAbs().maxCoeff(&most));
  constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "alpha", "beta", "gamma"};
  constexpr int kWidth = 21;
  text += correlation_text(report.focal_correlation(most), "EFL",
                           kNames[static_cast<std::size_t>(most)], kWidth);
  text += map_text(freed.map, kWidth);
  drivers::print(text,
                 "  tip by this camera    %.3f mm across (one sigma), %.0f mm below the sheet\n",
                 freed.tip_mm, kFreedGap_mm);
  text += use_text(kFreedFocalUse, kWidth);
}

std::string verdict_of(const ToolReport& report) {
  std::string verdict;
  if (report.dockings == 0) {
    drivers::print(verdict, "%d points on the guidetube", report.points);
    return verdict;
  }
  drivers::print(verdict, "%d %s, %s, heading %.3f deg taken", report.dockings,
                 report.dockings == 1 ? "docking" : "dockings",
                 report.assumption.clearance_mm > 0.0 ? "with clearance" : "offset given",
                 report.assumption.heading_rad * kDegrees);
  if (report.focal) {
    verdict += "; " + std::string(kFreedFocalUse);
  }
  return verdict;
}

}  // namespace

std::string tool_report_text(const ToolReport& report) {
  std::string text;
  const core::calibration::ToolCalibration& tool = report.tool;
  const auto sigma = [&](int i) { return core::math::sigma_of(tool.covariance, i); };
  const auto& v = tool.values;
  const bool clearance = report.dockings > 0 && report.assumption.clearance_mm > 0.0;
  drivers::print(text, "  tip in the camera     x %.4f  y %.4f  z %.4f mm\n", v(0), v(1), v(2));
  drivers::print(text, "    one sigma             %.4f    %.4f    %.4f mm", sigma(0), sigma(1),
                 sigma(2));
  if (clearance) {
    drivers::print(text, ", with %.2f mm of clearance in the tube", report.assumption.clearance_mm);
  }
  text += '\n';
  drivers::print(text, "  axis                  alpha %.4f  beta %.4f  gamma %.4f deg\n", v(3),
                 v(4), v(5));
  drivers::print(text, "    one sigma             %.4f       %.4f       %.4f deg\n", sigma(3),
                 sigma(4), sigma(5));
  if (report.dockings > 1) {
    drivers::print(text,
                   "  dockings              tips within %.3f mm, axes within %.3f deg of all\n",
                   tool.tip_spread_mm, tool.axis_spread_rad * kDegrees);
  }
  if (report.dockings > 1 && clearance) {
    drivers::print(text,
                   "  docked off the middle dx %.3f +- %.3f  dy %.3f +- %.3f mm, as the headings "
                   "tell it\n",
                   tool.offset_mm.x(), tool.offset_sigma_mm.x(), tool.offset_mm.y(),
                   tool.offset_sigma_mm.y());
  }
  if (report.focal) {
    append_focal(report, text);
  }
  if (report.shape) {
    text += silhouette_line(report.silhouette, report.dockings > 0);
  }
  return text;
}

std::string tool_settings_text(const ToolReport& report,
                               const drivers::CalibrationQuality& device) {
  std::string text;
  if (report.focal) {
    drivers::TomlWriter camera(drivers::TomlManner::kPlain);
    drivers::write_camera(camera, report.camera);
    text = with_quality(camera.take(), {"camera_quality", report.focal->covariance, kFreedFocalUse,
                                        device.serial, device.model}) +
           "\n";
  }
  core::ToolSettings tool;
  for (int i = 0; i < 3; ++i) {
    tool.position_mm[static_cast<std::size_t>(i)] = report.tool.values(i);
    tool.rotation_deg[static_cast<std::size_t>(i)] = report.tool.values(i + 3);
  }
  drivers::TomlWriter toml(drivers::TomlManner::kPlain);
  drivers::write_tool(toml, tool);
  text += with_quality(toml.take(),
                       {"tool_quality", report.tool.covariance, verdict_of(report), {}, {}});
  if (report.focal) {
    std::string list;
    for (const double value : report.focal_correlation) {
      drivers::print(list, list.empty() ? "%.6f" : ", %.6f", value);
    }
    text += "focal_length_correlation = [" + list + "]\n";
  }
  if (report.shape) {
    text += "\n" + drivers::silhouette_text(silhouette_settings(*report.shape, report.silhouette));
  }
  return text;
}

}  // namespace tubesight::board
