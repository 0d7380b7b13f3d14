#pragma once

#include <map>
#include <string>

#include "drivers/settings/text_files.h"

namespace tubesight::drivers {

/// Settings files in memory.
class MemoryFiles final : public TextFiles {
 public:
  std::map<std::string, std::string> texts;

  core::Result<void> read(const std::string& path, std::string& text,
                          std::string& message) override {
    const auto found = texts.find(path);
    if (found == texts.end()) {
      message = "No such file or directory";
      return core::Unexpected(core::Error::kIo);
    }
    text = found->second;
    return {};
  }
};

const std::string kCameraTable =
    "[camera]\n"
    "width_px = 635\n"
    "height_px = 480\n"
    "scan = \"even-first\"\n"
    "focal_length_mm = 5.06\n"
    "cell_width_mm = 0.0084\n"
    "cell_height_mm = 0.0098\n"
    "sensor_columns = 768\n"
    "frame_columns = 635\n"
    "horizontal_scale = 1.021\n"
    "center_px = [324.3, 233.8]\n"
    "distortion_per_mm2 = 0.0092\n";

const std::string kToolTable =
    "[tool]\n"
    "position_mm = [-3.074, 31.629, 112.789]\n"
    "rotation_deg = [-0.0639, -0.8174, 47.9947]\n";

const std::string kTubesheetTable =
    "[tubesheet]\n"
    "row_step_mm = [0.0, 25.4]\n"
    "column_step_mm = [25.4, 0.0]\n"
    "bore_mm = 18.6\n"
    "rows = [0, 120]\n"
    "columns = [0, 120]\n"
    "missing = [[50, 61],\n"
    "           [50, 62]]\n"
    "plugged = [[48, 60]]\n";

const std::string kStartTable =
    "[start]\n"
    "tubes = [ { row = 40, column = 60, at_px = [313, 196] },\n"
    "          { row = 41, column = 60, at_px = [321, 251] },\n"
    "          { row = 40, column = 61, at_px = [387, 186] } ]\n"
    "window_px = [40, 40, 595, 330]\n";

}  // namespace tubesight::drivers
