#include "board/bench/calibrate/camera_command.h"

#include <array>
#include <memory>
#include <vector>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/camera_exchange.h"
#include "board/bench/calibrate/camera_picture.h"
#include "board/bench/calibrate/camera_text.h"
#include "board/bench/calibrate/camera_views.h"
#include "board/bench/calibrate/honest_text.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/camera_calibration.h"
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

/// What was found and what it is worth, as lines for a person; the verdict falls where the halves
/// of the data contradict each other.
std::string report_on(Workspace& work, CalibrationOutcome& outcome) {
  const auto halves =
      core::calibration::compare_halves(work.data, work.state, outcome.freed, work.halves);
  outcome.verdict = lowered_by(halves, outcome.verdict, outcome.map.rms_px);
  const std::string more = halves_text(halves) + tip_text(work.data.sensor, work.state.camera,
                                                          outcome.fit.camera_covariance);
  const bool for_all = outcome.refusal == CalibrationRefusal::kNone &&
                       outcome.verdict == core::calibration::Verdict::kBase;
  const std::string next =
      for_all ? ""
              : next_text(find_next_view(work.data, work.state, outcome, work.halves), outcome.map);
  return camera_text(work.data, work.state, outcome, more, next);
}

/// Draws the views, and what there is of a calibration, where that is asked for.
bool draw(const CalibrateCameraOptions& options, const Workspace& work,
          const CalibrationOutcome& outcome, const CameraViews& views) {
  if (options.picture.empty()) {
    return true;
  }
  CameraPicture picture{work.data, work.state, outcome, views.thumbs(), {}};
  std::string& line = picture.caption.emplace_back();
  if (outcome.map.rms_px > 0.0) {
    drivers::print(line, "map known to %.3f px RMS, %.3f at (%.0f, %.0f): ", outcome.map.rms_px,
                   outcome.map.worst_px, outcome.map.worst_u_px, outcome.map.worst_v_px);
  }
  line += outcome.refusal == CalibrationRefusal::kNone
              ? "good for " + std::string(use_of(outcome.verdict))
              : "no calibration";
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
  return find_clash(
      inputs, std::array{NamedPath{"--out", options.out}, NamedPath{"--picture", options.picture},
                         NamedPath{"--export", options.exported}});
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
  if (const std::string clash = find_conflict(options, file); !clash.empty()) {
    tell(clash);
    return ExitStatus::kWrongInput;
  }
  const auto work = std::make_unique<Workspace>();
  CameraViews views(file);
  if (const ExitStatus status = views.read(work->data); status != ExitStatus::kDone) {
    tell(views.message());
    return status;
  }
  CalibrationOutcome outcome =
      core::calibration::calibrate_camera(work->data, work->state, work->scratch);
  if (outcome.refusal == CalibrationRefusal::kNone ||
      outcome.refusal == CalibrationRefusal::kTooUncertain) {
    if (!write_out(report_on(*work, outcome))) {
      return ExitStatus::kJobFailed;
    }
  }
  if (!draw(options, *work, outcome, views)) {
    return ExitStatus::kJobFailed;
  }
  if (outcome.refusal != CalibrationRefusal::kNone) {
    tell(options.target + ": no calibration: " + std::string(explain(outcome.refusal)));
    return ExitStatus::kJobFailed;
  }
  const core::CameraSettings camera = calibrated(file.camera, work->state.camera);
  if (!options.exported.empty()) {
    const CameraExport other = export_camera(camera, file.device.serial, options.opencv);
    if (!write_out(other.report) || !write_settings(options.exported, other.text)) {
      return ExitStatus::kJobFailed;
    }
  }
  return options.out.empty() ||
                 write_settings(options.out, camera_settings_text(camera, outcome, file.device))
             ? ExitStatus::kDone
             : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
