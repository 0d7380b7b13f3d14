#include "board/bench/calibrate/camera_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/camera_exchange.h"
#include "board/bench/calibrate/camera_picture.h"
#include "board/bench/calibrate/camera_text.h"
#include "board/bench/calibrate/camera_views.h"
#include "board/bench/calibrate/honest_text.h"
#include "board/bench/calibrate/points_file.h"
#include "board/bench/calibrate/residuals_file.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/camera_type.h"
#include "core/calibration/halves.h"
#include "core/calibration/next_view.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/target_settings.h"

namespace tubesight::board {
namespace {

using core::calibration::CalibrationOutcome;
using core::calibration::CalibrationRefusal;

/// What a calibration works in: too large for a stack.
struct Workspace {
  core::calibration::CalibrationData data;
  core::calibration::CalibrationState state;
  core::calibration::FitScratch scratch;
  core::calibration::HalvesScratch halves;
};

/// How well the halves of the data agree, as lines for a person; the verdict falls where they
/// contradict each other.
std::string judge_by_halves(Workspace& work, CalibrationOutcome& outcome) {
  const auto halves =
      core::calibration::compare_halves(work.data, work.state, outcome.freed, work.halves);
  outcome.verdict = lowered_by(halves, outcome.verdict, outcome.judged_px);
  return halves_text(halves);
}

/// Whether one more view is what would help.
bool wants_a_view(const CalibrationOutcome& outcome) {
  switch (outcome.refusal) {
    case CalibrationRefusal::kNone:
      // What two heights leave unseen is not for another angle to tell.
      return outcome.verdict != core::calibration::Verdict::kBase &&
             !(outcome.unseen_lens > 0.0 && core::calibration::verdict_for(outcome.judged_px) ==
                                                core::calibration::Verdict::kBase);
    case CalibrationRefusal::kTooUncertain:
    case CalibrationRefusal::kOneView: return true;
    default: return false;
  }
}

/// What was found and what it is worth, as lines for a person.
std::string report_on(Workspace& work, const CalibrationOutcome& outcome, std::string more) {
  // A pattern, and what tangential distortion leaves, count as they do for the verdict.
  const double doubt = std::max(1.0, outcome.judged_px / outcome.map.rms_px);
  more +=
      tip_text(work.data.sensor, work.state.camera, doubt * doubt * outcome.fit.camera_covariance);
  const std::string next =
      wants_a_view(outcome)
          ? next_text(find_next_view(work.data, work.state, outcome, work.halves), outcome.map)
          : "";
  return camera_text(work.data, work.state, outcome, more, next);
}

/// Draws the views, and what there is of a calibration, where that is asked for. Of a type's it is
/// that of the camera seen.
bool draw(const CalibrateCameraOptions& options, const Workspace& work,
          const CalibrationOutcome& outcome, const CameraViews& views) {
  if (options.picture.empty()) {
    return true;
  }
  CameraPicture picture{work.data, work.state, outcome, views.thumbs(), {}};
  std::string& line = picture.caption.emplace_back();
  if (outcome.map.rms_px > 0.0) {
    drivers::print(line, "%smap known to %.3f px RMS, %.3f at (%.0f, %.0f): ",
                   options.type ? "this one's " : "", outcome.map.rms_px, outcome.map.worst_px,
                   outcome.map.worst_u_px, outcome.map.worst_v_px);
  }
  if (outcome.refusal != CalibrationRefusal::kNone) {
    line += "no calibration";
  } else if (options.type) {
    line += "its type good for " + std::string(use_of(core::calibration::Verdict::kTracking));
  } else {
    line += "good for " + std::string(use_of(outcome.verdict));
  }
  std::replace(line.begin(), line.end(), ';', ',');  // the letters drawn have no semicolon
  std::string message;
  if (!write_camera_picture(options.picture, picture, message)) {
    tell(message);
    return false;
  }
  return true;
}

std::string find_conflict(const CalibrateCameraOptions& options, const drivers::TargetFile& file) {
  std::vector<NamedPath> inputs = {{"the target's file", options.target}};
  for (const drivers::ViewSettings& view : file.views) {
    inputs.push_back({"a points file", view.points});
    for (const std::string& image : view.images) {
      inputs.push_back({"a picture", image});
    }
  }
  std::vector<NamedPath> outputs = {{"--out", options.out},
                                    {"--picture", options.picture},
                                    {"--export", options.exported},
                                    {"--residuals", options.residuals}};
  if (!options.points.empty()) {
    for (const std::string& path : points_files(options.points, file.views.size())) {
      outputs.push_back({"--write-points", path});
    }
  }
  return find_clash(inputs, outputs);
}

/// Whether there is anything to tell beside the reason why it is refused.
bool tells_what_it_found(const CalibrationOutcome& outcome) {
  switch (outcome.refusal) {
    case CalibrationRefusal::kNone:
    case CalibrationRefusal::kTooUncertain:
    case CalibrationRefusal::kPattern:
    case CalibrationRefusal::kOtherLens: return true;
    case CalibrationRefusal::kOneView: return outcome.assumed;
    default: return false;
  }
}

/// Tells and draws what was found; with `--type` the outcome becomes the type's.
bool tell_and_draw(const CalibrateCameraOptions& options, Workspace& work, const CameraViews& views,
                   CalibrationOutcome& outcome) {
  if (!tells_what_it_found(outcome)) {
    return draw(options, work, outcome, views);
  }
  const std::string halves = judge_by_halves(work, outcome);
  if (!options.type || outcome.refusal != CalibrationRefusal::kNone) {
    return write_out(report_on(work, outcome, halves)) && draw(options, work, outcome, views);
  }
  CalibrationOutcome of_type = outcome;
  widen_to_type(work.data.sensor, work.state.camera, {}, of_type);
  // What the tip would be off by stands on the EFL that only a docking tells.
  const bool good = write_out(camera_text(work.data, work.state, of_type, halves, "", true)) &&
                    draw(options, work, outcome, views);
  outcome = of_type;
  return good;
}

}  // namespace

ExitStatus run_calibrate_camera(const CalibrateCameraOptions& options) {
  drivers::TargetFile file;
  drivers::Messages messages;
  const bool good = static_cast<bool>(drivers::load_target(options.target, file, messages));
  tell(messages);
  if (!good) {
    return ExitStatus::kWrongInput;
  }
  tell_files({options.target});
  if (const std::string clash = find_conflict(options, file); !clash.empty()) {
    tell(clash);
    return ExitStatus::kWrongInput;
  }
  const auto work = std::make_unique<Workspace>();
  CameraViews views(file, options.ignore_scan_flag);
  if (const ExitStatus status = views.read(work->data); status != ExitStatus::kDone) {
    tell(views.message());
    return status;
  }
  if (!views.notes().empty() && !write_out(views.notes())) {
    return ExitStatus::kJobFailed;
  }
  if (!options.points.empty() && !write_points(options.points, file, work->data)) {
    return ExitStatus::kJobFailed;
  }
  CalibrationOutcome outcome =
      core::calibration::calibrate_camera(work->data, work->state, work->scratch);
  if (!tell_and_draw(options, *work, views, outcome)) {
    return ExitStatus::kJobFailed;
  }
  // Of what is refused, too: the dots to blame are found there.
  if (!options.residuals.empty() && outcome.fit.dots > 0 &&
      !write_residuals(options.residuals, work->data)) {
    return ExitStatus::kJobFailed;
  }
  if (outcome.refusal != CalibrationRefusal::kNone) {
    tell(options.target + ": no calibration: " + std::string(explain(outcome.refusal)));
    return ExitStatus::kJobFailed;
  }
  if (options.type) {
    file.device.serial.clear();
  }
  const core::CameraSettings camera = calibrated(file.camera, work->state.camera);
  if (!options.exported.empty()) {
    const CameraExport other = export_camera(camera, file.device.serial, options.opencv);
    if (!write_out(other.report) || !write_settings(options.exported, other.text)) {
      return ExitStatus::kJobFailed;
    }
  }
  return options.out.empty() ||
                 write_settings(options.out,
                                camera_settings_text(camera, outcome, file.device, options.type))
             ? ExitStatus::kDone
             : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
