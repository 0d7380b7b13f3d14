#include "board/visionbox/camera_settings.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tubesight::board {
namespace {

using drivers::TableReader;

constexpr std::array<std::string_view, 6> kFormats = {"GREY", "NV12", "YUYV", "UYVY", "Y10", "Y16"};
constexpr std::array<std::string_view, 4> kFields = {"any", "interlaced", "alternate",
                                                     "sequential"};
constexpr std::array<std::string_view, 2> kStandards = {"NTSC", "PAL"};
constexpr std::array<std::string_view, 2> kStamps = {"driver", "arrival"};
constexpr drivers::NumberRange kFieldsPerS{1.0, 1000.0, " a second"};
constexpr drivers::NumberRange kExposure{0.001, 1000.0, " ms"};

void read_device(TableReader& table, std::string& device) {
  if (!table.text("device", device)) {
    return;
  }
  const std::string_view text = device;
  const bool stays = (text.starts_with("serial:") && text.size() > 7) ||
                     (text.starts_with("bus:") && text.size() > 4) ||
                     text.starts_with("/dev/v4l/by-path/") || text.starts_with("/dev/v4l/by-id/");
  if (!stays) {
    table.complain("device",
                   "'" + device +
                       "' is another camera after the next start, expected serial:NUMBER, "
                       "bus:PATH or a path below /dev/v4l/by-path or /dev/v4l/by-id");
  }
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// "NAME = VALUE" each.
void read_controls(TableReader& table, std::vector<drivers::ControlSetting>& controls) {
  std::vector<std::string> lines;
  if (!table.optional_texts("controls", lines)) {
    return;
  }
  for (const std::string& line : lines) {
    const std::size_t sign = line.find('=');
    drivers::ControlSetting control;
    if (sign != std::string::npos) {
      control = {trimmed(line.substr(0, sign)), trimmed(line.substr(sign + 1))};
    }
    if (control.name.empty() || control.value.empty()) {
      table.complain("controls", "'" + line + "', expected \"NAME = VALUE\"");
      return;
    }
    controls.push_back(std::move(control));
  }
}

}  // namespace

void read_v4l2(TableReader& table, drivers::V4l2Settings& camera) {
  read_device(table, camera.device);
  std::size_t index = 0;
  if (table.has("format") && table.optional_word("format", kFormats, index)) {
    camera.format = kFormats[index];
  }
  index = 0;
  if (table.optional_word("fields", kFields, index)) {
    camera.fields = static_cast<drivers::FieldLayout>(index);
  }
  if (table.has("standard") && table.optional_word("standard", kStandards, index)) {
    camera.standard = kStandards[index];
  }
  table.optional_text("input", camera.input);
  table.optional_number("fields_per_s", kFieldsPerS, camera.fields_per_s);
  table.optional_number("exposure_ms", kExposure, camera.exposure_ms);
  index = 0;
  if (table.optional_word("stamps", kStamps, index)) {
    camera.use_stamps = index == 0;
  }
  read_controls(table, camera.controls);
  for (const std::string_view key : {"format", "standard"}) {
    table.ignore(key);
  }
}

}  // namespace tubesight::board
