#include "board/visionbox/camera_settings.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <arpa/inet.h>

#include "drivers/aravis/grey_format.h"

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

constexpr auto kMonoFormats = [] {
  std::array<std::string_view, drivers::aravis::kGreyFormats.size()> names;
  std::ranges::transform(drivers::aravis::kGreyFormats, names.begin(),
                         &drivers::aravis::GreyFormat::name);
  return names;
}();
constexpr drivers::WholeRange kSensor{0, 65'535};
constexpr drivers::WholeRange kBinning{1, 8};
constexpr drivers::NumberRange kGain{0.0, 1000.0, ""};
/// From the least that every path takes to the most that a packet of UDP holds.
constexpr drivers::WholeRange kPacket{576, 65'535};
constexpr drivers::NumberRange kReadout{0.001, 1000.0, " ms"};

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

void read_address(TableReader& table, std::string& device) {
  if (!table.text("device", device)) {
    return;
  }
  constexpr std::string_view kAddress = "address:";
  in_addr address{};
  const bool by_address = device.starts_with(kAddress) &&
                          inet_pton(AF_INET, device.substr(kAddress.size()).c_str(), &address) == 1;
  if (!by_address && !(device.starts_with("serial:") && device.size() > 7)) {
    table.complain("device", "'" + device + "', expected address:FOUR.NUMBERS or serial:NUMBER");
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

void read_aravis(TableReader& table, drivers::AravisSettings& camera) {
  read_address(table, camera.device);
  std::size_t index = 0;
  if (table.has("format") && table.optional_word("format", kMonoFormats, index)) {
    camera.format = kMonoFormats[index];
  }
  table.ignore("format");
  table.optional_number("fields_per_s", kFieldsPerS, camera.fields_per_s);
  table.optional_number("exposure_ms", kExposure, camera.exposure_ms);
  table.optional_whole("left_px", kSensor, camera.left_px);
  table.optional_whole("top_px", kSensor, camera.top_px);
  table.optional_whole("binning", kBinning, camera.binning);
  double gain = 0.0;
  if (table.has("gain") && table.optional_number("gain", kGain, gain)) {
    camera.gain = gain;
  }
  table.ignore("gain");
  table.optional_text("trigger", camera.trigger);
  if (!camera.trigger.empty() && !table.has("fields_per_s")) {
    table.complain("trigger", "a rate that nobody says, expected fields_per_s beside it");
  }
  table.optional_whole("packet_bytes", kPacket, camera.packet_bytes);
  table.optional_switch("resend", camera.resend);
  table.optional_number("readout_ms", kReadout, camera.readout_ms);
}

}  // namespace tubesight::board
