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
#include "board/bench/calibrate/tool_focal.h"
#include "board/bench/calibrate/tool_inputs.h"
#include "board/bench/calibrate/tool_picture.h"
#include "board/bench/calibrate/tool_silhouette.h"
#include "board/bench/calibrate/tool_text.h"
#include "board/bench/output/text_output.h"
#include "core/camera/camera_setup.h"
#include "core/pose/tool_answer.h"
#include "core/tubesheet/sheet_places.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::Silhouette;
using core::calibration::ToolCalibration;

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Docked guidetubes stand within their clearance; a wrong tube is a pitch off.
constexpr double kMostSpread_mm = 2.0;
// Of a docking that is only compared: seven sigma of two clearances.
constexpr double kMostCheck_mm = 1.5;
// What [tool] may hold: no tip is farther from its camera.
constexpr double kMostTip_mm = 1000.0;

/// One run of the command; on the heap, as the settings are large.
class ToolRun {
 public:
  explicit ToolRun(const CalibrateToolOptions& options) : options_(options) {}

  ExitStatus run() {
    if (!read_tool_inputs(options_, inputs_, poses_)) {
      return ExitStatus::kWrongInput;
    }
    tell_files(inputs_.file.files);
    report_.camera = inputs_.file.settings.camera;
    report_.assumption = inputs_.assumption;
    report_.shape = inputs_.shape;
    if (const ExitStatus status = options_.points.empty() ? by_dockings() : by_points();
        status != ExitStatus::kDone) {
      return status;
    }
    tell_tool();
    for (std::size_t i = 0; i < inputs_.checks.size(); ++i) {
      const ExitStatus status = check(inputs_.checks[i], inputs_.starts[inputs_.docks.size() + i]);
      if (status != ExitStatus::kDone) {
        return status;
      }
    }
    progress_.erase();
    if (!write_out(text_)) {
      return ExitStatus::kJobFailed;
    }
    if (!drawn_) {
      tell(message_);
      return ExitStatus::kJobFailed;
    }
    return options_.out.empty() ||
                   write_settings(options_.out,
                                  tool_settings_text(report_, inputs_.file.camera_quality))
               ? ExitStatus::kDone
               : ExitStatus::kJobFailed;
  }

 private:
  ExitStatus failed(const std::string& message, ExitStatus status = ExitStatus::kJobFailed) {
    progress_.erase();
    tell(message);
    return status;
  }

  void show(const std::string& words) {
    const std::size_t all = inputs_.docks.size() + inputs_.checks.size();
    progress_.update(ProgressLine::Clock::now(), words,
                     static_cast<double>(pictures_done_++) / static_cast<double>(all));
  }

  ExitStatus by_points() {
    const core::CameraSettings& settings = inputs_.file.settings.camera;
    const auto camera = core::camera::make_camera_model<double>(settings);
    if (!camera) {
      return failed(options_.session + ": camera: no picture within 60 degrees of the optical axis",
                    ExitStatus::kWrongInput);
    }
    const auto outcome = core::calibration::tool_from_points(*camera, inputs_.points.points);
    if (outcome.refusal != core::calibration::ToolPointsRefusal::kNone) {
      return failed(options_.points + ": no calibration: " + std::string(explain(outcome.refusal)));
    }
    report_.tool = outcome.tool;
    report_.points = outcome.used;
    text_ = points_text(inputs_.points, outcome);
    if (report_.shape) {
      report_.silhouette = calibrated_silhouette(settings, report_.tool, *report_.shape, nullptr);
    }
    ToolPicture picture;
    for (std::int32_t i = 0; i < outcome.points.size(); ++i) {
      const auto& point = outcome.points[i];
      picture.misses.push_back(
          {inputs_.points.points[i].seen_px - point.off_px, point.off_px, point.used});
    }
    draw(picture);
    return ExitStatus::kDone;
  }

  ExitStatus by_dockings() {
    if (options_.free_focal) {
      report_.focal_before_mm = report_.camera.focal_length_mm;
      report_.focal =
          free_focal(poses_, inputs_.docks, inputs_.starts, inputs_.file.camera_quality, progress_);
      if (report_.focal->status != ExitStatus::kDone) {
        const bool whole = report_.focal->message.starts_with("no calibration");
        return failed((whole ? options_.session + ": " : "") + report_.focal->message,
                      report_.focal->status);
      }
      report_.camera.focal_length_mm = poses_.model().camera_settings.focal_length_mm;
    }
    // The first docking last: its picture is what silhouette and drawing are made of.
    report_.dockings = static_cast<std::int32_t>(inputs_.docks.size());
    std::vector<std::string> lines(inputs_.docks.size());
    std::vector<core::calibration::Docking> dockings(inputs_.docks.size());
    by_focal_.resize(inputs_.docks.size());
    for (std::size_t i = inputs_.docks.size(); i-- > 0;) {
      const ExitStatus status = dock(i, dockings[i], lines[i]);
      if (status != ExitStatus::kDone) {
        return status;
      }
    }
    for (std::size_t i = 0; i < dockings.size(); ++i) {
      static_cast<void>(dockings_.try_push_back(dockings[i]));
      text_ += lines[i];
    }
    return calibrate();
  }

  ExitStatus calibrate() {
    report_.tool = core::calibration::calibrate_tool(dockings_, inputs_.assumption);
    if (report_.tool.tip_spread_mm > kMostSpread_mm) {
      std::string message =
          options_.session + ": no calibration: the dockings contradict each other";
      drivers::print(message, " by %.1f mm, expected the tube named on which each was docked",
                     2.0 * report_.tool.tip_spread_mm);
      return failed(message);
    }
    if (report_.focal) {
      add_focal();
      if (std::string why = why_no_tracking(); !why.empty()) {
        return failed(options_.session + ": no calibration: " + why);
      }
    }
    if (report_.shape) {
      report_.silhouette =
          calibrated_silhouette(report_.camera, report_.tool, *report_.shape, &poses_.average());
    }
    ToolPicture picture;
    picture.still = poses_.picture();
    picture.outcome = &poses_.outcome();
    picture.rims = &poses_.rims();
    picture.model = &poses_.model();
    picture.misses = tube_misses(poses_.outcome(), poses_.model());
    draw(picture);
    return ExitStatus::kDone;
  }

  /// What the EFL's uncertainty adds to the tool's, and how the two belong together.
  void add_focal() {
    const core::math::Vector6d slope =
        core::calibration::tool_by_focal(dockings_, by_focal_, inputs_.assumption);
    const double variance = report_.focal->covariance(0, 0);
    report_.tool.covariance += variance * slope * slope.transpose();
    for (int i = 0; i < 6; ++i) {
      const double sigma = std::sqrt(std::max(report_.tool.covariance(i, i), 1e-30));
      report_.focal_correlation(i) = slope(i) * std::sqrt(variance) / sigma;
    }
  }

  /// Tracking and correction have to find the tube that the tool is under: three standard
  /// deviations of the tip stay within what counts as under a tube. Empty: they do.
  std::string why_no_tracking() {
    const core::SessionSettings& settings = inputs_.file.settings;
    report_.focal->tip_mm = tip_by_freed(*report_.focal, report_.camera, report_.tool.T_camera_tool,
                                         settings.tubesheet);
    const double most_mm = settings.verification.aligned_within_mm / 3.0;
    std::string why;
    if (report_.focal->tip_mm < 0.0) {
      drivers::print(why,
                     "%.0f mm below the sheet this camera sees fewer than four tube-ends, expected "
                     "the [tool] of a camera that sees the sheet from there",
                     kFreedGap_mm);
    } else if (report_.focal->tip_mm > most_mm) {
      drivers::print(why,
                     "%.0f mm below the sheet the tip is known to %.2f mm only, expected a third "
                     "of aligned_within_mm, %.2f mm: more dockings, a type whose cameras differ "
                     "less (sigma in [camera_quality]), or a template",
                     kFreedGap_mm, report_.focal->tip_mm, most_mm);
    }
    return why;
  }

  void draw(const ToolPicture& picture) {
    if (!options_.picture.empty()) {
      drawn_ = write_tool_picture(options_.picture, report_, picture, message_);
    }
  }

  ExitStatus dock(std::size_t number, core::calibration::Docking& docking, std::string& line) {
    const DockedPictures& asked = inputs_.docks[number];
    show("docking on tube " + tube_text(asked.tube));
    const DockedPose pose = poses_.find(asked, inputs_.starts[number]);
    if (pose.status != ExitStatus::kDone) {
      return failed(pose.message, pose.status);
    }
    docking.T_sheet_camera = pose.T_sheet_camera;
    docking.covariance = pose.covariance;
    docking.tip_mm = poses_.model().center_mm(asked.tube) + inputs_.offset_mm;
    if (report_.focal && !poses_.by_focal(by_focal_[number])) {
      return failed(asked.pictures.front() + ": no pose with another EFL");
    }
    if (const std::string why = why_elsewhere(asked.tube, pose, docking); !why.empty()) {
      return failed(asked.pictures.front() + ": " + why);
    }
    drivers::print(line, "docked on tube %s: %d tube-ends, RMS %.3f px, %d pictures\n",
                   tube_text(asked.tube).c_str(), pose.tubes, pose.rms_px,
                   static_cast<int>(asked.pictures.size()));
    return ExitStatus::kDone;
  }

  /// Why the tube named can't be the docked one: by a [tool] that the session has, by where the tip
  /// would be, and by what the picture shows in its place. Empty: it can.
  std::string why_elsewhere(core::TubeAddress named, const DockedPose& pose,
                            const core::calibration::Docking& docking) {
    if (inputs_.file.has_tool) {
      const Eigen::Vector2d tip =
          (pose.T_sheet_camera * core::pose::tool_transform(inputs_.file.settings.tool))
              .translation_mm()
              .head<2>();
      const core::TubeAddress under =
          core::tubesheet::nearest_address(inputs_.file.settings.tubesheet, {tip.x(), tip.y()});
      if (under != named) {
        return "docked on tube " + tube_text(named) + " by --dock, under tube " + tube_text(under) +
               " by [tool], expected the two to agree; without [tool] in the session if it is of "
               "another tool";
      }
    }
    core::calibration::DockingList alone;
    static_cast<void>(alone.try_push_back(docking));
    const ToolCalibration tool = core::calibration::calibrate_tool(alone, inputs_.assumption);
    if (tool.values.head<3>().cwiseAbs().maxCoeff() > kMostTip_mm) {
      return "docked on tube " + tube_text(named) +
             " by --dock, which is more than 1000 mm away, expected the tube in the picture";
    }
    Silhouette silhouette;
    if (report_.shape) {
      silhouette = calibrated_silhouette(report_.camera, tool, *report_.shape, nullptr);
    }
    std::string why =
        why_not_docked(named, poses_.outcome(), poses_.rims(), poses_.model(),
                       inputs_.assumption.height_mm, report_.shape ? &silhouette : nullptr);
    return why.empty() && report_.shape
               ? why_not_as_wide(named, silhouette, *report_.shape, poses_.average())
               : why;
  }

  void tell_tool() {
    text_ += tool_report_text(report_);
    if (!inputs_.file.has_tool) {
      return;
    }
    const auto before = core::pose::tool_transform(inputs_.file.settings.tool);
    const auto& T = report_.tool.T_camera_tool;
    const Eigen::Vector3d axis = T.rotation().col(2);
    drivers::print(
        text_, "  [tool] of the session tip %.3f mm off, axis %.3f deg\n",
        (before.translation_mm() - T.translation_mm()).norm(),
        kDegrees * std::asin(std::min(1.0, before.rotation().col(2).cross(axis).norm())));
  }

  ExitStatus check(const DockedPictures& docking, const PictureStarts& starts) {
    show("check on tube " + tube_text(docking.tube));
    const DockedPose pose = poses_.find(docking, starts);
    if (pose.status != ExitStatus::kDone) {
      return failed(pose.message, pose.status);
    }
    const auto tool = pose.T_sheet_camera * report_.tool.T_camera_tool;
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
      progress_.erase();
      static_cast<void>(write_out(text_));
      return failed(message);
    }
    return ExitStatus::kDone;
  }

  const CalibrateToolOptions& options_;
  ToolInputs inputs_;
  DockedPoses poses_;
  ProgressLine progress_;
  std::size_t pictures_done_ = 0;  ///< dockings and checks
  core::calibration::DockingList dockings_;
  std::vector<core::math::Vector6d> by_focal_;
  ToolReport report_;
  std::string text_;
  bool drawn_ = true;
  std::string message_;  ///< why it was not drawn
};

}  // namespace

ExitStatus run_calibrate_tool(const CalibrateToolOptions& options) {
  return std::make_unique<ToolRun>(options)->run();
}

}  // namespace tubesight::board
