#include "board/bench/calibrate/camera_command.h"

#include <memory>
#include <vector>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/camera_text.h"
#include "board/bench/calibrate/camera_views.h"
#include "board/bench/calibrate/points_file.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/camera_type.h"
#include "drivers/settings/target_settings.h"

namespace tubesight::board {
namespace {

using core::calibration::CalibrationRefusal;

/// What a calibration works in: too large for a stack.
struct Workspace {
  core::calibration::CalibrationData data;
  core::calibration::CalibrationState state;
  core::calibration::FitScratch scratch;
};

std::string find_conflict(const CalibrateCameraOptions& options, const drivers::TargetFile& file) {
  std::vector<NamedPath> inputs = {{"the target's file", options.target}};
  for (const drivers::ViewSettings& view : file.views) {
    inputs.push_back({"a points file", view.points});
    for (const std::string& image : view.images) {
      inputs.push_back({"a picture", image});
    }
  }
  std::vector<NamedPath> outputs = {{"--out", options.out}};
  if (!options.points.empty()) {
    for (const std::string& path : points_files(options.points, file.views.size())) {
      outputs.push_back({"--write-points", path});
    }
  }
  return find_clash(inputs, outputs);
}

/// Whether there is anything to tell beside the reason why it is refused.
bool tells_what_it_found(const core::calibration::CalibrationOutcome& outcome) {
  switch (outcome.refusal) {
    case CalibrationRefusal::kNone:
    case CalibrationRefusal::kTooUncertain:
    case CalibrationRefusal::kPattern:
    case CalibrationRefusal::kOtherLens: return true;
    case CalibrationRefusal::kOneView: return outcome.assumed;
    default: return false;
  }
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
  if (!options.points.empty() && !write_points(options.points, file, work->data)) {
    return ExitStatus::kJobFailed;
  }
  auto outcome = core::calibration::calibrate_camera(work->data, work->state, work->scratch);
  if (options.type && outcome.refusal == CalibrationRefusal::kNone) {
    core::calibration::widen_to_type(work->data.sensor, work->state.camera, {}, outcome);
    file.device.serial.clear();
  }
  if (tells_what_it_found(outcome)) {
    if (!write_out(camera_text(work->data, work->state, outcome, options.type))) {
      return ExitStatus::kJobFailed;
    }
  }
  if (outcome.refusal != CalibrationRefusal::kNone) {
    tell(options.target + ": no calibration: " + std::string(explain(outcome.refusal)));
    return ExitStatus::kJobFailed;
  }
  const core::CameraSettings camera = calibrated(file.camera, work->state.camera);
  return options.out.empty() ||
                 write_settings(options.out,
                                camera_settings_text(camera, outcome, file.device, options.type))
             ? ExitStatus::kDone
             : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
