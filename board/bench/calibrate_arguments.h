#pragma once

#include <array>
#include <string>

#include "board/bench/calibrate/base_command.h"
#include "board/bench/calibrate/camera_command.h"
#include "board/bench/calibrate/template_command.h"
#include "board/bench/calibrate/tool_command.h"
#include "board/bench/output/exit_status.h"

namespace CLI {
class App;
}

namespace tubesight::board {

/// What `calibrate` is asked for.
inline constexpr std::array kCalibrations = {"camera", "tool",   "base",    "zones",
                                             "links",  "import", "template"};

/// The arguments of `calibrate`, some of which belong to one thing alone.
struct CalibrateArguments {
  std::string what;
  std::string file;
  std::string out;
  bool ignore_scan_flag = false;  ///< of a camera or a tool
  CalibrateCameraOptions camera;
  CalibrateToolOptions tool;
  CalibrateBaseOptions base;
  std::string of_base;  ///< the settings that zones correct
  std::string arm;      ///< the arm whose links are calibrated
  CalibrateTemplateOptions dots;
};

/// Adds `calibrate` with all its options, which are read into `arguments`.
CLI::App* add_calibrate(CLI::App& app, CalibrateArguments& arguments);

/// Runs the calibration asked for; options of another one are refused.
[[nodiscard]] ExitStatus run_calibrate(CalibrateArguments& arguments);

}  // namespace tubesight::board
