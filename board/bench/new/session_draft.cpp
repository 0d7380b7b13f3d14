#include "board/bench/new/session_draft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/base/tube_address.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using drivers::toml_number;

constexpr int kInset_share = 20;        // of the picture, between its edge and the window
constexpr std::int32_t kRows = 100;     // to both sides of the address in the middle
constexpr std::size_t kCommentAt = 44;  // columns before a comment

template <std::size_t N>
std::string list(const std::array<double, N>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "[" : ", ") + toml_number(value, drivers::TomlManner::kPlain);
  }
  return text + "]";
}

std::string places(const Eigen::Vector2d& place_px) {
  return "[" + drivers::rounded_text(place_px.x(), 5) + ", " +
         drivers::rounded_text(place_px.y(), 5) + "]";
}

/// A key with what it means behind it.
std::string line(std::string_view key, const std::string& value, std::string_view comment = {}) {
  std::string text = std::string(key) + " = " + value;
  if (!comment.empty()) {
    text.resize(std::max(text.size() + 1, kCommentAt), ' ');
    text += "# " + std::string(comment);
  }
  return text + "\n";
}

std::string quoted(std::string_view word) { return '"' + std::string(word) + '"'; }

std::string number(double value) { return toml_number(value, drivers::TomlManner::kPlain); }

std::string camera_table(const SessionDraft& draft) {
  const core::CameraSettings& camera = draft.camera;
  const auto scan = static_cast<std::size_t>(camera.scan);
  return "\n# The camera: " + draft.camera_from + ".\n[camera]\n" +
         line("width_px", std::to_string(camera.width_px)) +
         line("height_px", std::to_string(camera.height_px)) +
         line("scan", quoted(drivers::kScanWords[scan]),
              draft.facts.scan ? "as the video says" : "even-first, odd-first or progressive") +
         line("focal_length_mm", number(camera.focal_length_mm), "EFL, of the lens") +
         line("cell_width_mm", number(camera.cell_width_mm), "a cell of the sensor") +
         line("cell_height_mm", number(camera.cell_height_mm)) +
         line("sensor_columns", std::to_string(camera.sensor_columns),
              "cells in a line of the sensor") +
         line("frame_columns", std::to_string(camera.frame_columns), "pixels made of them") +
         line("horizontal_scale", number(camera.horizontal_scale), "1 of a digital camera") +
         line("center_px", list(camera.center_px), "where the optical axis meets the picture") +
         line("distortion_per_mm2", number(camera.distortion_per_mm2),
              "above 0: barrel; 0: not known") +
         line("distortion2_per_mm4", number(camera.distortion2_per_mm4));
}

const char* tool_words(const SessionDraft& draft) {
  if (draft.tool_known) {
    return "# as it was told.\n";
  }
  return draft.tool_seen
             ? "# NOT KNOWN YET. This stands for a guidetube square to the plate as the first "
               "frame "
               "shows it,\n# 50 mm below the tube-end that is clicked first. `tubesight calibrate "
               "tool` finds the true one.\n"
             : "# NOT KNOWN YET. This stands for a camera that looks square at the plate, with the "
               "tip "
               "straight\n# before it. `tubesight calibrate tool` finds the true one.\n";
}

std::string tool_table(const SessionDraft& draft) {
  return std::string(
             "\n# Where the guidetube's tip is, seen from the camera (x right, y down, z "
             "forward), and how it\n# is turned:\n") +
         tool_words(draft) + "[tool]\n" + line("position_mm", list(draft.tool_mm)) +
         line("rotation_deg", list(draft.tool_deg), "alpha, beta, gamma");
}

std::string tubesheet_table(const SessionDraft& draft) {
  // Seen from the tool, the sheet's z axis points away: x right, y down is right-handed then.
  const double height_mm = draft.pitch_mm * std::numbers::sqrt3 / 2.0;
  const bool obtuse = draft.facts.lattice && draft.facts.lattice->angle_deg > 90.0;
  const std::array<double, 2> row =
      draft.triangular
          ? std::array{(obtuse ? -0.5 : 0.5) * draft.pitch_mm, std::round(height_mm * 1e6) / 1e6}
          : std::array{0.0, draft.pitch_mm};
  const auto range = [](std::int32_t middle) {
    return "[" + std::to_string(middle - kRows) + ", " + std::to_string(middle + kRows) + "]";
  };
  return "\n# The plate. Tube (row, column) stands at row * row_step_mm + column * "
         "column_step_mm.\n[tubesheet]\n" +
         line("row_step_mm", list(row), "from a tube to that of the next row") +
         line("column_step_mm", list(std::array{draft.pitch_mm, 0.0}), "and of the next column") +
         line("bore_mm", number(draft.bore_mm), "inside diameter of a tube-end") +
         line("weld", quoted(drivers::kWeldWords[static_cast<std::size_t>(draft.weld)]),
              "flush or fillet") +
         line("rows", range(draft.address.row), "first and last: give the plate's own") +
         line("columns", range(draft.address.column)) +
         line("# missing", "[[50, 61]]", "no tube there: stays, voids, beyond the rim") +
         line("# plugged", "[[48, 60]]");
}

std::string click(std::int32_t row, std::int32_t column, const Eigen::Vector2d& place_px) {
  return "{ row = " + std::to_string(row) + ", column = " + std::to_string(column) +
         ", at_px = " + places(place_px) + " }";
}

std::string start_table(const SessionDraft& draft) {
  std::string text =
      "\n# Three tube-ends of the first frame, each with a place inside its dark, not in one line "
      "(an L).\n";
  std::string tubes = "[]";
  if (draft.has_address && draft.facts.lattice) {
    const auto& [row, column] = draft.address;
    text +=
        "# CHECK THESE: they were found in the picture, and numbered from the address that was "
        "told for\n# the middle, with columns growing rightwards and rows downwards. The plant "
        "may number otherwise.\n";
    tubes = "[ " + click(row, column, draft.facts.lattice->middle_px) + ",\n          " +
            click(row + 1, column, draft.facts.lattice->next_row_px) + ",\n          " +
            click(row, column + 1, draft.facts.lattice->next_column_px) + " ]";
  } else {
    text +=
        "# NONE YET, so that a replay waits for a start. `tubesight look` shows places to click "
        "on;\n# for example: tubes = [ { row = 40, column = 60, at_px = [313, 196] }, ... ]\n";
  }
  const std::int32_t left = draft.camera.width_px / kInset_share;
  const std::int32_t top = draft.camera.height_px / kInset_share;
  const std::string window = "[" + std::to_string(left) + ", " + std::to_string(top) + ", " +
                             std::to_string(draft.camera.width_px - 1 - left) + ", " +
                             std::to_string(draft.camera.height_px - 1 - top) + "]";
  return text + "[start]\n" + line("tubes", tubes) +
         line("window_px", window, "left, top, right, bottom of what is tracked: the sheet alone");
}

std::string limit_tables(const SessionDraft& draft) {
  return "\n# What the tool can do at most. A faster one is lost, and says so.\n[motion]\n" +
         line("max_speed_mm_s", number(draft.motion.max_speed_mm_s)) +
         line("max_acceleration_mm_s2", number(draft.motion.max_acceleration_mm_s2),
              draft.motion.max_acceleration_mm_s2 < core::MotionSettings{}.max_acceleration_mm_s2
                  ? "all that so few fields a second can follow"
                  : "") +
         "\n[verification]\n" +
         (draft.tool_known
              ? line("aligned_within_mm", number(core::VerificationSettings{}.aligned_within_mm),
                     "up to this offset the guidetube counts as under a tube")
              // The least there is: of a guidetube that nobody has measured, nothing is vouched for
              // but by chance.
              : line("aligned_within_mm", number(0.1),
                     "the least there is, until the tool is known; 2.5 then"));
}

}  // namespace

void fit_motion(const core::TubesheetSettings& sheet, SessionDraft& draft) {
  if (draft.facts.rate_hz <= 0.0) {
    return;
  }
  const double fields = draft.camera.scan == core::Scan::kProgressive ? 1.0 : 2.0;
  const double span_s = 1.0 / (draft.facts.rate_hz * fields);
  constexpr double kLeast_mm_s2 = 10.0;
  while (draft.motion.max_acceleration_mm_s2 > kLeast_mm_s2 &&
         !drivers::why_fields_too_seldom(draft.motion, sheet, span_s).empty()) {
    draft.motion.max_acceleration_mm_s2 /= 2.0;
  }
}

std::string draft_text(const SessionDraft& draft) {
  std::string text =
      drivers::toml_comment("A session for " + draft.video + ", begun by `tubesight new`.");
  text += "# docs/file-formats.md tells every key with its range.\nformat = 1\n";
  if (draft.camera_file.empty()) {
    text += camera_table(draft);
  } else {
    drivers::TomlWriter name;
    name.text("", draft.camera_file);
    const std::string value = name.take();
    text += "include = [" + value.substr(value.find('"'), value.rfind('"') - value.find('"') + 1) +
            "]    # [camera], as it was calibrated\n";
  }
  return text + tool_table(draft) + tubesheet_table(draft) + start_table(draft) +
         limit_tables(draft);
}

}  // namespace tubesight::board
