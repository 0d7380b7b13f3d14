#include "board/bench/calibrate/camera_exchange.h"

#include <array>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/camera_text.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/opencv_lens.h"
#include "drivers/camera_yaml/camera_yaml.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_text.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::calibration::ConversionResidual;

constexpr double kCell_mm = 0.01;
constexpr double kMost_px = 1.0;  // what tracking allows

/// Cells as large as a pixel, for a file without millimetres.
core::CameraSettings plain_camera(const drivers::CameraYaml& yaml) {
  core::CameraSettings camera;
  camera.width_px = yaml.width_px;
  camera.height_px = yaml.height_px;
  camera.scan = core::Scan::kProgressive;
  camera.cell_width_mm = kCell_mm;
  camera.cell_height_mm = kCell_mm;
  camera.sensor_columns = yaml.width_px;
  camera.frame_columns = yaml.width_px;
  return camera;
}

ExitStatus fail(const std::string& message, ExitStatus status) {
  tell(message);
  return status;
}

}  // namespace

CameraExport export_camera(const core::CameraSettings& camera, const std::string& serial,
                           bool opencv) {
  const core::calibration::Sensor sensor = core::calibration::sensor_of(camera);
  ConversionResidual residual;
  const auto lens = core::calibration::opencv_lens_of(sensor, values_of(camera), residual);
  drivers::CameraYaml yaml;
  yaml.name = serial.empty() ? "tubesight" : serial;
  yaml.width_px = camera.width_px;
  yaml.height_px = camera.height_px;
  yaml.fx_px = lens.fx_px;
  yaml.fy_px = lens.fy_px;
  yaml.cx_px = lens.cx_px;
  yaml.cy_px = lens.cy_px;
  yaml.distortion = lens.distortion;
  CameraExport result;
  result.text =
      camera_yaml_text(yaml, opencv ? drivers::YamlManner::kOpencv : drivers::YamlManner::kRos);
  drivers::print(result.report,
                 "  exported             k1, k2, k3 follow this lens to %.4f px RMS over the "
                 "picture, %.4f px at worst\n",
                 residual.rms_px, residual.worst_px);
  return result;
}

ExitStatus import_camera(const std::string& file, core::CameraSettings& camera,
                         std::string& report) {
  std::string text;
  drivers::CameraYaml yaml;
  drivers::Messages messages;
  if (!read_whole(file, text, messages) || !read_camera_yaml(text, file, yaml, messages)) {
    tell(messages);
    return ExitStatus::kWrongInput;
  }
  const core::CameraSettings plain = plain_camera(yaml);
  ConversionResidual residual;
  const auto values = core::calibration::camera_of(
      core::calibration::sensor_of(plain),
      {yaml.fx_px, yaml.fy_px, yaml.cx_px, yaml.cy_px, yaml.distortion}, residual);
  if (!values) {
    return fail(file +
                    ": no camera: its distortion folds within the picture, expected a "
                    "pixel's ray to be one",
                ExitStatus::kJobFailed);
  }
  drivers::print(report,
                 "camera imported, %d x %d px: k and k2 follow its distortion to %.4f px RMS over "
                 "the picture, %.4f px at worst\n",
                 yaml.width_px, yaml.height_px, residual.rms_px, residual.worst_px);
  camera = calibrated(plain, *values);
  if (!(residual.rms_px <= kMost_px)) {
    static_cast<void>(write_out(report));  // what follows speaks of it
    return fail(file +
                    ": no camera: that is more than 1 px, expected a lens that k and k2 "
                    "follow; calibrate it with calibrate camera",
                ExitStatus::kJobFailed);
  }
  return ExitStatus::kDone;
}

ExitStatus run_import_camera(const ImportCameraOptions& options) {
  const std::string clash = find_clash(std::array{NamedPath{"the camera's file", options.file}},
                                       std::array{NamedPath{"--out", options.out}});
  if (!clash.empty()) {
    return fail(clash, ExitStatus::kWrongInput);
  }
  core::CameraSettings camera;
  std::string report;
  const ExitStatus imported = import_camera(options.file, camera, report);
  if (imported != ExitStatus::kDone) {
    return imported;
  }
  if (!write_out(report)) {
    return ExitStatus::kJobFailed;
  }
  drivers::TomlWriter toml(drivers::TomlManner::kPlain);
  drivers::write_camera(toml, camera);
  return options.out.empty() || write_settings(options.out, toml.take()) ? ExitStatus::kDone
                                                                         : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
