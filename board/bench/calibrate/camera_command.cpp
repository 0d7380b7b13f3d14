#include "board/bench/calibrate/camera_command.h"

#include <array>
#include <memory>
#include <vector>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/camera_text.h"
#include "board/bench/calibrate/camera_views.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/camera_calibration.h"
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
  return find_clash(inputs, std::array{NamedPath{"--out", options.out}});
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
  const auto outcome = core::calibration::calibrate_camera(work->data, work->state, work->scratch);
  if (outcome.refusal == CalibrationRefusal::kNone ||
      outcome.refusal == CalibrationRefusal::kTooUncertain) {
    if (!write_out(camera_text(work->data, work->state, outcome))) {
      return ExitStatus::kJobFailed;
    }
  }
  if (outcome.refusal != CalibrationRefusal::kNone) {
    tell(options.target + ": no calibration: " + std::string(explain(outcome.refusal)));
    return ExitStatus::kJobFailed;
  }
  const core::CameraSettings camera = calibrated(file.camera, work->state.camera);
  return options.out.empty() ||
                 write_settings(options.out, camera_settings_text(camera, outcome, file.device))
             ? ExitStatus::kDone
             : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
