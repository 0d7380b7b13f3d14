#include "board/bench/pose/pose_starts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "drivers/files/csv_reader.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return part;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

bool parse_px(std::string_view text, double& px) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), px);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(px);
}

bool parse_start(std::string_view text, core::pose::PictureStart& start) {
  std::array<std::string_view, 4> parts;
  for (std::string_view& part : parts) {
    if (text.empty()) {
      return false;
    }
    part = trimmed(cut(text, ','));
  }
  return text.empty() && drivers::parse_whole(parts[0], start.address.row) &&
         drivers::parse_whole(parts[1], start.address.column) && parse_px(parts[2], start.u_px) &&
         parse_px(parts[3], start.v_px);
}

bool lists(const core::StaticVector<core::TubeAddress, core::kMaxListedTubes>& list,
           core::TubeAddress address) {
  return std::find(list.begin(), list.end(), address) != list.end();
}

std::string why_start_wrong(const core::pose::PictureStart& start,
                            const core::SessionSettings& settings) {
  const std::string tube = drivers::address_text(start.address);
  const core::TubesheetSettings& sheet = settings.tubesheet;
  if (!drivers::in_picture(settings.camera, {start.u_px, start.v_px})) {
    return tube + " is at " + drivers::point_text({start.u_px, start.v_px}) +
           ", expected a place in the picture of " + std::to_string(settings.camera.width_px) +
           " x " + std::to_string(settings.camera.height_px) + " pixels";
  }
  if (const std::string absent = drivers::why_no_tube(sheet, start.address); !absent.empty()) {
    return absent;
  }
  if (lists(sheet.plugged, start.address)) {
    return tube + " is listed as plugged, expected an open tube-end";
  }
  return {};
}

}  // namespace

bool parse_starts(std::string_view text, PictureStarts& starts, std::string& message) {
  constexpr const char* kExpected = ", expected R,C,U,V;R,C,U,V;… (row, column, pixels)";
  starts.clear();
  while (!text.empty()) {
    const std::string_view part = trimmed(cut(text, ';'));
    if (part.empty() && text.empty()) {
      break;  // a semicolon at the end
    }
    core::pose::PictureStart start;
    if (!parse_start(part, start)) {
      message = "--start: " + drivers::in_quotes(part) + kExpected;
      return false;
    }
    starts.push_back(start);
  }
  if (starts.empty()) {
    message = std::string("--start: '' names no tube") + kExpected;
    return false;
  }
  if (starts.size() > core::pose::kMaxPictureStarts) {
    message = "--start: " + std::to_string(starts.size()) + " places, expected at most " +
              std::to_string(core::pose::kMaxPictureStarts);
    return false;
  }
  return true;
}

std::string why_starts_wrong(const PictureStarts& starts, const core::SessionSettings& settings) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (const std::string why = why_start_wrong(starts[i], settings); !why.empty()) {
      return why;
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (starts[k].address == starts[i].address) {
        return drivers::address_text(starts[i].address) +
               " is named twice, expected different tubes";
      }
    }
  }
  return {};
}

bool parse_address(std::string_view text, core::TubeAddress& address) {
  const std::string_view row = trimmed(cut(text, ','));
  return drivers::parse_whole(row, address.row) &&
         drivers::parse_whole(trimmed(text), address.column);
}

}  // namespace tubesight::board
