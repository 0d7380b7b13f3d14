#include "board/bench/calibrate/tool_inputs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "board/bench/calibrate/tool_silhouette.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

bool wrong(const std::string& message) {
  tell(message);
  return false;
}

bool know_what(const CalibrateToolOptions& options) {
  if (options.docks.empty() && options.points.empty()) {
    return wrong("--dock: none is given, expected ROW,COLUMN IMAGE... of a docking");
  }
  if (!options.docks.empty() && !options.points.empty()) {
    return wrong("--points: beside --dock, expected one of the two; --check compares");
  }
  if (options.free_focal && options.docks.empty()) {
    return wrong("--free-efl: without --dock, expected dockings, which tell the EFL");
  }
  return true;
}

bool know_tubes(const ToolInputs& inputs, const DockedPoses& poses) {
  for (const auto* const list : {&inputs.docks, &inputs.checks}) {
    for (const DockedPictures& docking : *list) {
      if (!poses.stands(docking.tube)) {
        return wrong((list == &inputs.docks ? "--dock: " : "--check: ") + tube_text(docking.tube) +
                     " is no open tube-end of this tubesheet");
      }
    }
  }
  return true;
}

bool take_starts(const CalibrateToolOptions& options, ToolInputs& inputs) {
  const std::size_t count = inputs.docks.size() + inputs.checks.size();
  if (options.starts.empty()) {
    if (!inputs.file.has_start) {
      return wrong(options.session +
                   ": start: no tube-ends are named, expected [start] here or in an included "
                   "file, or --start");
    }
    PictureStarts starts;
    for (const core::StartPoint& point : inputs.file.settings.start.tubes) {
      starts.push_back({point.address, point.at_px[0], point.at_px[1]});
    }
    inputs.starts.assign(count, starts);
    return true;
  }
  if (options.starts.size() != 1 && options.starts.size() != count) {
    return wrong("--start: " + std::to_string(options.starts.size()) + " for " +
                 std::to_string(count) +
                 " dockings and checks, expected one for all or one for each");
  }
  for (std::size_t i = 0; i < count; ++i) {
    PictureStarts starts;
    std::string message;
    if (!parse_starts(options.starts[options.starts.size() == 1 ? 0 : i], starts, message)) {
      return wrong(message);
    }
    if (message = why_starts_wrong(starts, inputs.file.settings); !message.empty()) {
      return wrong("--start: " + message);
    }
    inputs.starts.push_back(starts);
  }
  return true;
}

bool take_assumption(const CalibrateToolOptions& options, ToolInputs& inputs) {
  inputs.assumption.height_mm = options.height_mm;
  inputs.assumption.heading_rad = options.heading_deg * std::numbers::pi / 180.0;
  if (options.offset_mm.empty()) {
    return true;
  }
  inputs.assumption.clearance_mm = 0.0;
  const std::size_t comma = options.offset_mm.find(',');
  constexpr std::int32_t kDigits = 6;
  std::array<std::int64_t, 2> values{};
  if (comma == std::string::npos ||
      !drivers::parse_decimal(options.offset_mm.substr(0, comma), kDigits, values[0]) ||
      !drivers::parse_decimal(options.offset_mm.substr(comma + 1), kDigits, values[1])) {
    return wrong("--dock-offset-mm: " + drivers::in_quotes(options.offset_mm) +
                 ", expected X,Y on the sheet");
  }
  inputs.offset_mm << 1e-6 * static_cast<double>(values[0]), 1e-6 * static_cast<double>(values[1]);
  const double most_mm = 0.5 * inputs.file.settings.tubesheet.bore_mm;
  if (inputs.offset_mm.norm() > most_mm) {
    return wrong("--dock-offset-mm: " + drivers::in_quotes(options.offset_mm) +
                 ", expected a tip within the tube, " + drivers::number_text(most_mm) +
                 " mm at most from its centre");
  }
  return true;
}

bool outputs_fit(const CalibrateToolOptions& options, const ToolInputs& inputs) {
  std::vector<NamedPath> read = {{"the session", options.session},
                                 {"the points file", options.points}};
  for (const auto* const list : {&inputs.docks, &inputs.checks}) {
    for (const DockedPictures& docking : *list) {
      for (const std::string& picture : docking.pictures) {
        read.push_back({"a picture", picture});
      }
    }
  }
  const std::string clash = find_clash(
      read, std::array{NamedPath{"--out", options.out}, NamedPath{"--picture", options.picture}});
  return clash.empty() || wrong(clash);
}

bool take_words(const CalibrateToolOptions& options, ToolInputs& inputs) {
  std::string message;
  if (!parse_dockings("--dock", options.docks, inputs.docks, message) ||
      !parse_dockings("--check", options.checks, inputs.checks, message)) {
    return wrong(message);
  }
  if (inputs.docks.size() > static_cast<std::size_t>(core::calibration::kMaxDockings)) {
    return wrong("--dock: more than " + std::to_string(core::calibration::kMaxDockings) +
                 " dockings, expected at most that many");
  }
  if (!options.guidetube.empty()) {
    inputs.shape.emplace();
    if (!parse_guidetube(options.guidetube, *inputs.shape, message)) {
      return wrong(message);
    }
  }
  return true;
}

}  // namespace

std::string tube_text(core::TubeAddress tube) {
  return "(" + std::to_string(tube.row) + ", " + std::to_string(tube.column) + ")";
}

bool read_tool_inputs(const CalibrateToolOptions& options, ToolInputs& inputs, DockedPoses& poses) {
  const bool pictures = options.points.empty() || !options.checks.empty();
  drivers::NeededTables needed = drivers::kCalibrateToolNeeds;
  needed.tubesheet = pictures;
  drivers::Messages messages;
  const bool good = static_cast<bool>(
      drivers::load_session_settings(options.session, needed, inputs.file, messages));
  tell(messages);
  std::string message;
  if (!good) {
    return false;
  }
  if (pictures && !poses.open(inputs.file.settings, options.ignore_scan_flag, message)) {
    return wrong(options.session + ": " + message);
  }
  if (!know_what(options) || !take_words(options, inputs) || !take_assumption(options, inputs)) {
    return false;
  }
  if (!options.points.empty() &&
      !read_tool_points(options.points, inputs.file.settings.camera, inputs.points, message)) {
    return wrong(message);
  }
  if (pictures && (!know_tubes(inputs, poses) || !take_starts(options, inputs))) {
    return false;
  }
  return outputs_fit(options, inputs);
}

}  // namespace tubesight::board
