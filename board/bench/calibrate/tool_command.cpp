#include "board/bench/calibrate/tool_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>

#include <Eigen/Geometry>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/tool_dockings.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/tool_calibration.h"
#include "core/pose/tool_answer.h"
#include "core/tubesheet/sheet_places.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/session_text.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Docked guidetubes stand within their clearance; a wrong tube is a pitch off.
constexpr double kMostSpread_mm = 2.0;
// Of a docking that is only compared: seven sigma of two clearances.
constexpr double kMostCheck_mm = 1.5;

std::string tube_text(core::TubeAddress tube) {
  return "(" + std::to_string(tube.row) + ", " + std::to_string(tube.column) + ")";
}

/// One run of the command; on the heap, as the settings are large.
class ToolRun {
 public:
  explicit ToolRun(const CalibrateToolOptions& options) : options_(options) {}

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    for (std::size_t i = 0; i < docks_.size(); ++i) {
      if (const ExitStatus status = dock(docks_[i], starts_[i]); status != ExitStatus::kDone) {
        return status;
      }
    }
    tool_ = core::calibration::calibrate_tool(dockings_, assumption_);
    if (tool_.tip_spread_mm > kMostSpread_mm) {
      std::string message =
          options_.session + ": no calibration: the dockings contradict each other";
      drivers::print(message, " by %.1f mm, expected the tube named on which each was docked",
                     2.0 * tool_.tip_spread_mm);
      tell(message);
      return ExitStatus::kJobFailed;
    }
    tell_tool();
    for (std::size_t i = 0; i < checks_.size(); ++i) {
      const ExitStatus status = check(checks_[i], starts_[docks_.size() + i]);
      if (status != ExitStatus::kDone) {
        return status;
      }
    }
    if (!write_out(text_)) {
      return ExitStatus::kJobFailed;
    }
    return options_.out.empty() || write_settings(options_.out, settings_text())
               ? ExitStatus::kDone
               : ExitStatus::kJobFailed;
  }

 private:
  [[nodiscard]] bool wrong(const std::string& message) const {
    tell(message);
    return false;
  }

  bool open() {
    drivers::Messages messages;
    const bool good = static_cast<bool>(drivers::load_session_settings(
        options_.session, drivers::kCalibrateToolNeeds, file_, messages));
    tell(messages);
    std::string message;
    if (!good) {
      return false;
    }
    if (!poses_.open(file_.settings, message)) {
      return wrong(options_.session + ": " + message);
    }
    if (!parse_dockings("--dock", options_.docks, docks_, message) ||
        !parse_dockings("--check", options_.checks, checks_, message)) {
      return wrong(message);
    }
    if (docks_.empty()) {
      return wrong("--dock: none is given, expected ROW,COLUMN IMAGE... of a docking");
    }
    if (docks_.size() > static_cast<std::size_t>(core::calibration::kMaxDockings)) {
      return wrong("--dock: more than " + std::to_string(core::calibration::kMaxDockings) +
                   " dockings, expected at most that many");
    }
    return know_tubes() && take_starts() && take_assumption() && outputs_fit();
  }

  bool know_tubes() {
    for (const auto* const list : {&docks_, &checks_}) {
      for (const DockedPictures& docking : *list) {
        if (!poses_.stands(docking.tube)) {
          return wrong((list == &docks_ ? "--dock: " : "--check: ") + tube_text(docking.tube) +
                       " is no open tube-end of this tubesheet");
        }
      }
    }
    return true;
  }

  bool take_starts() {
    const std::size_t count = docks_.size() + checks_.size();
    if (options_.starts.empty()) {
      if (!file_.has_start) {
        return wrong(options_.session +
                     ": start: no tube-ends are named, expected [start] here or in an included "
                     "file, or --start");
      }
      PictureStarts starts;
      for (const core::StartPoint& point : file_.settings.start.tubes) {
        starts.push_back({point.address, point.at_px[0], point.at_px[1]});
      }
      starts_.assign(count, starts);
      return true;
    }
    if (options_.starts.size() != 1 && options_.starts.size() != count) {
      return wrong("--start: " + std::to_string(options_.starts.size()) + " for " +
                   std::to_string(count) +
                   " dockings and checks, expected one for all or one for each");
    }
    for (std::size_t i = 0; i < count; ++i) {
      PictureStarts starts;
      std::string message;
      if (!parse_starts(options_.starts[options_.starts.size() == 1 ? 0 : i], starts, message)) {
        return wrong(message);
      }
      if (message = why_starts_wrong(starts, file_.settings); !message.empty()) {
        return wrong("--start: " + message);
      }
      starts_.push_back(starts);
    }
    return true;
  }

  bool take_assumption() {
    assumption_.height_mm = options_.height_mm;
    assumption_.heading_rad = options_.heading_deg / kDegrees;
    if (options_.offset_mm.empty()) {
      return true;
    }
    assumption_.clearance_mm = 0.0;
    const std::size_t comma = options_.offset_mm.find(',');
    constexpr std::int32_t kDigits = 6;
    std::array<std::int64_t, 2> values{};
    if (comma == std::string::npos ||
        !drivers::parse_decimal(options_.offset_mm.substr(0, comma), kDigits, values[0]) ||
        !drivers::parse_decimal(options_.offset_mm.substr(comma + 1), kDigits, values[1])) {
      return wrong("--dock-offset-mm: " + drivers::in_quotes(options_.offset_mm) +
                   ", expected X,Y on the sheet");
    }
    offset_mm_ << 1e-6 * static_cast<double>(values[0]), 1e-6 * static_cast<double>(values[1]);
    return true;
  }

  bool outputs_fit() {
    std::vector<NamedPath> inputs = {{"the session", options_.session}};
    for (const auto* const list : {&docks_, &checks_}) {
      for (const DockedPictures& docking : *list) {
        for (const std::string& picture : docking.pictures) {
          inputs.push_back({"a picture", picture});
        }
      }
    }
    const std::string clash = find_clash(inputs, std::array{NamedPath{"--out", options_.out}});
    return clash.empty() || wrong(clash);
  }

  ExitStatus dock(const DockedPictures& docking, const PictureStarts& starts) {
    const DockedPose pose = poses_.find(docking, starts);
    if (pose.status != ExitStatus::kDone) {
      tell(pose.message);
      return pose.status;
    }
    if (const std::string why = why_elsewhere(docking.tube, pose); !why.empty()) {
      tell(docking.pictures.front() + ": " + why);
      return ExitStatus::kJobFailed;
    }
    drivers::print(text_, "docked on tube %s: %d tube-ends, RMS %.3f px, %d pictures\n",
                   tube_text(docking.tube).c_str(), pose.tubes, pose.rms_px,
                   static_cast<int>(docking.pictures.size()));
    core::calibration::Docking next;
    next.T_sheet_camera = pose.T_sheet_camera;
    next.covariance = pose.covariance;
    next.tip_mm = poses_.model().center_mm(docking.tube) + offset_mm_;
    static_cast<void>(dockings_.try_push_back(next));
    return ExitStatus::kDone;
  }

  /// Why the tube named can't be the docked one, by a [tool] that the session has; empty: it can.
  [[nodiscard]] std::string why_elsewhere(core::TubeAddress named, const DockedPose& pose) const {
    if (!file_.has_tool) {
      return {};
    }
    const Eigen::Vector2d tip =
        (pose.T_sheet_camera * core::pose::tool_transform(file_.settings.tool))
            .translation_mm()
            .head<2>();
    const core::TubeAddress under =
        core::tubesheet::nearest_address(file_.settings.tubesheet, {tip.x(), tip.y()});
    if (under == named) {
      return {};
    }
    return "docked on tube " + tube_text(named) + " by --dock, under tube " + tube_text(under) +
           " by [tool], expected the two to agree; without [tool] in the session if it is of "
           "another tool";
  }

  void tell_tool() {
    const auto sigma = [&](int i) { return std::sqrt(std::max(0.0, tool_.covariance(i, i))); };
    const auto& v = tool_.values;
    drivers::print(text_, "  tip in the camera     x %.4f  y %.4f  z %.4f mm\n", v(0), v(1), v(2));
    drivers::print(text_, "    one sigma             %.4f    %.4f    %.4f mm", sigma(0), sigma(1),
                   sigma(2));
    if (assumption_.clearance_mm > 0.0) {
      drivers::print(text_, ", with %.2f mm of clearance in the tube", assumption_.clearance_mm);
    }
    text_ += '\n';
    drivers::print(text_, "  axis                  alpha %.4f  beta %.4f  gamma %.4f deg\n", v(3),
                   v(4), v(5));
    drivers::print(text_, "    one sigma             %.4f       %.4f       %.4f deg\n", sigma(3),
                   sigma(4), sigma(5));
    if (dockings_.size() > 1) {
      drivers::print(text_,
                     "  dockings              tips within %.3f mm, axes within %.3f deg of all\n",
                     tool_.tip_spread_mm, tool_.axis_spread_rad * kDegrees);
    }
    if (dockings_.size() > 1 && assumption_.clearance_mm > 0.0) {
      drivers::print(text_,
                     "  docked off the middle dx %.3f +- %.3f  dy %.3f +- %.3f mm, as the headings "
                     "tell it\n",
                     tool_.offset_mm.x(), tool_.offset_sigma_mm.x(), tool_.offset_mm.y(),
                     tool_.offset_sigma_mm.y());
    }
    if (file_.has_tool) {
      const auto before = core::pose::tool_transform(file_.settings.tool);
      drivers::print(
          text_, "  [tool] of the session tip %.3f mm off, axis %.3f deg\n",
          (before.translation_mm() - tool_.T_camera_tool.translation_mm()).norm(),
          kDegrees * std::asin(std::min(
                         1.0, before.rotation()
                                  .col(2)
                                  .cross(Eigen::Vector3d(tool_.T_camera_tool.rotation().col(2)))
                                  .norm())));
    }
  }

  ExitStatus check(const DockedPictures& docking, const PictureStarts& starts) {
    const DockedPose pose = poses_.find(docking, starts);
    if (pose.status != ExitStatus::kDone) {
      tell(pose.message);
      return pose.status;
    }
    const auto tool = pose.T_sheet_camera * tool_.T_camera_tool;
    const Eigen::Vector2d off =
        tool.translation_mm().head<2>() - poses_.model().center_mm(docking.tube);
    drivers::print(
        text_,
        "check on tube %s: tip %.4f mm off its centre (dx %.4f, dy %.4f), height %.4f mm, "
        "axis %.4f deg off the normal\n",
        tube_text(docking.tube).c_str(), off.norm(), off.x(), off.y(), -tool.translation_mm().z(),
        kDegrees * std::acos(std::clamp(tool.rotation()(2, 2), -1.0, 1.0)));
    if (off.norm() > kMostCheck_mm) {
      std::string message =
          options_.session + ": no calibration: the check on tube " + tube_text(docking.tube);
      drivers::print(message, " has the tip %.1f mm off its centre, expected at most %.1f mm",
                     off.norm(), kMostCheck_mm);
      static_cast<void>(write_out(text_));
      tell(message);
      return ExitStatus::kJobFailed;
    }
    return ExitStatus::kDone;
  }

  [[nodiscard]] std::string settings_text() const {
    core::ToolSettings tool;
    for (int i = 0; i < 3; ++i) {
      tool.position_mm[static_cast<std::size_t>(i)] = tool_.values(i);
      tool.rotation_deg[static_cast<std::size_t>(i)] = tool_.values(i + 3);
    }
    drivers::TomlWriter toml(drivers::TomlManner::kPlain);
    drivers::write_tool(toml, tool);
    std::string verdict;
    drivers::print(verdict, "%d %s, %s, heading %.3f deg taken", dockings_.size(),
                   dockings_.size() == 1 ? "docking" : "dockings",
                   assumption_.clearance_mm > 0.0 ? "with clearance" : "offset given",
                   options_.heading_deg);
    return with_quality(toml.take(), {"tool_quality", tool_.covariance, verdict, {}, {}});
  }

  const CalibrateToolOptions& options_;
  drivers::SessionFile file_;
  DockedPoses poses_;
  std::vector<DockedPictures> docks_;
  std::vector<DockedPictures> checks_;
  std::vector<PictureStarts> starts_;  ///< of the dockings, then of the checks
  core::calibration::DockingAssumption assumption_;
  Eigen::Vector2d offset_mm_ = Eigen::Vector2d::Zero();
  core::calibration::DockingList dockings_;
  core::calibration::ToolCalibration tool_;
  std::string text_;
};

}  // namespace

ExitStatus run_calibrate_tool(const CalibrateToolOptions& options) {
  return std::make_unique<ToolRun>(options)->run();
}

}  // namespace tubesight::board
