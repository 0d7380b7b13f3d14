#include "drivers/settings/session_text.h"

#include <array>
#include <charconv>

namespace tubesight::drivers {
namespace {

std::string line(std::string_view key, const std::string& value) {
  return std::string(key) + " = " + value + "\n";
}

std::string whole_pair(const std::array<std::int32_t, 2>& pair) {
  return "[" + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + "]";
}

std::string camera_text(const core::CameraSettings& camera) {
  constexpr std::array<const char*, 3> kScans = {"even-first", "odd-first", "progressive"};
  return "[camera]\n" + line("width_px", std::to_string(camera.width_px)) +
         line("height_px", std::to_string(camera.height_px)) +
         line("scan", toml_text(kScans[static_cast<std::size_t>(camera.scan)])) +
         line("focal_length_mm", plain_number(camera.focal_length_mm)) +
         line("cell_width_mm", plain_number(camera.cell_width_mm)) +
         line("cell_height_mm", plain_number(camera.cell_height_mm)) +
         line("sensor_columns", std::to_string(camera.sensor_columns)) +
         line("frame_columns", std::to_string(camera.frame_columns)) +
         line("horizontal_scale", plain_number(camera.horizontal_scale)) +
         line("center_px", plain_numbers(camera.center_px)) +
         line("distortion_per_mm2", plain_number(camera.distortion_per_mm2)) +
         line("distortion2_per_mm4", plain_number(camera.distortion2_per_mm4));
}

std::string tubesheet_text(const core::TubesheetSettings& sheet) {
  constexpr std::array<const char*, 2> kWelds = {"flush", "fillet"};
  constexpr std::array<const char*, 3> kAddresses = {"all", "even-sum", "odd-sum"};
  return "[tubesheet]\n" + line("origin_mm", plain_numbers(sheet.origin_mm)) +
         line("row_step_mm", plain_numbers(sheet.row_step_mm)) +
         line("column_step_mm", plain_numbers(sheet.column_step_mm)) +
         line("bore_mm", plain_number(sheet.bore_mm)) +
         line("weld", toml_text(kWelds[static_cast<std::size_t>(sheet.weld)])) +
         line("rows", whole_pair(sheet.rows)) + line("columns", whole_pair(sheet.columns)) +
         line("addresses", toml_text(kAddresses[static_cast<std::size_t>(sheet.addresses)])) +
         (sheet.odd_row_shift != 0.0 ? line("odd_row_shift", plain_number(sheet.odd_row_shift))
                                     : "") +
         line("missing", plain_addresses(sheet.missing.view())) +
         line("plugged", plain_addresses(sheet.plugged.view()));
}

}  // namespace

std::string plain_number(double value) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr;
  std::string number(text, end);
  return number.find('.') == std::string::npos ? number + ".0" : number;
}

std::string plain_numbers(std::span<const double> values) {
  std::string list;
  for (const double value : values) {
    list += (list.empty() ? "" : ", ") + plain_number(value);
  }
  return "[" + list + "]";
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    // What is no printing character has no place in a title.
    quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return quoted + "\"";
}

std::string toml_comment(std::string_view text) {
  std::string comment = "# ";
  for (const char c : text) {
    comment += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return comment + "\n";
}

std::string plain_addresses(std::span<const core::TubeAddress> addresses) {
  std::string list;
  for (const core::TubeAddress address : addresses) {
    list += (list.empty() ? "" : ", ") + whole_pair({address.row, address.column});
  }
  return "[" + list + "]";
}

std::string start_text(const core::StartSettings& start) {
  std::string tubes;
  for (const core::StartPoint& point : start.tubes) {
    tubes += (tubes.empty() ? "" : ", ");
    tubes += "{ row = " + std::to_string(point.address.row) +
             ", column = " + std::to_string(point.address.column) +
             ", at_px = " + plain_numbers(point.at_px) + " }";
  }
  const auto& [left, top, right, bottom] = start.window_px;
  return "[start]\n" + line("tubes", "[" + tubes + "]") +
         line("window_px", "[" + std::to_string(left) + ", " + std::to_string(top) + ", " +
                               std::to_string(right) + ", " + std::to_string(bottom) + "]") +
         line("optimum_px", plain_numbers(start.optimum_px));
}

std::string session_text(const core::SessionSettings& settings) {
  return camera_text(settings.camera) + "\n[tool]\n" +
         line("position_mm", plain_numbers(settings.tool.position_mm)) +
         line("rotation_deg", plain_numbers(settings.tool.rotation_deg)) + "\n" +
         tubesheet_text(settings.tubesheet) + "\n[motion]\n" +
         line("max_speed_mm_s", plain_number(settings.motion.max_speed_mm_s)) +
         line("max_acceleration_mm_s2", plain_number(settings.motion.max_acceleration_mm_s2)) +
         "\n[edges]\n" +
         line("initial_threshold", std::to_string(settings.edges.initial_threshold)) +
         line("region_threshold", std::to_string(settings.edges.region_threshold)) +
         "\n[verification]\n" +
         line("aligned_within_mm", plain_number(settings.verification.aligned_within_mm)) +
         line("claim_within_s", plain_number(settings.verification.claim_within_s)) +
         line("claim_oldest_s", plain_number(settings.verification.claim_oldest_s));
}

}  // namespace tubesight::drivers
