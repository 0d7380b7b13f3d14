#include "drivers/settings/session_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "core/tubesheet/sheet_places.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_keys.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;

/// Takes a list over when it holds just as many finite numbers.
bool take_numbers(const toml::array* list, std::span<double> values) {
  if (list == nullptr || list->size() != values.size()) {
    return false;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto number = (*list)[i].value<double>();
    if (!number || !std::isfinite(*number)) {
      return false;
    }
    values[i] = *number;
  }
  return true;
}

/// Takes a list of six lists of six numbers over; else `values` is left as it is.
void take_matrix(const toml::array* list, std::array<double, 36>& values) {
  if (list == nullptr || list->size() != 6) {
    return;
  }
  std::array<double, 36> read{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (!take_numbers((*list)[i].as_array(), std::span(read).subspan(6 * i, 6))) {
      return;
    }
  }
  values = read;
}

using AddressList = core::StaticVector<TubeAddress, core::kMaxListedTubes>;

void read_addresses(TableReader& table, std::string_view key,
                    const core::TubesheetSettings& tubesheet, bool ranges_known,
                    AddressList& list) {
  list.clear();
  const toml::array* const entries = table.list(key, false, "[[row, column], ...]");
  if (entries == nullptr) {
    return;
  }
  if (std::cmp_greater(entries->size(), AddressList::capacity())) {
    table.complain(key, std::to_string(entries->size()) + " tubes, expected at most " +
                            std::to_string(AddressList::capacity()));
    return;
  }
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const toml::node& entry = (*entries)[i];
    TubeAddress address;
    if (!read_address(entry, address)) {
      table.complain_entry(key, i, entry, why_no_address(entry));
    } else if (ranges_known && !core::tubesheet::in_ranges(tubesheet, address)) {
      table.complain_entry(key, i, entry,
                           address_text(address) + ", expected " + ranges_text(tubesheet));
    } else {
      static_cast<void>(list.try_push_back(address));  // fits: counted above
    }
  }
}

/// Complains of a range that is none; `range` was read without mistake.
void check_range(TableReader& table, std::string_view key,
                 const std::array<std::int32_t, 2>& range) {
  if (table.sound(key) && range[0] > range[1]) {
    table.complain(key, "the first, " + std::to_string(range[0]) + ", is above the last, " +
                            std::to_string(range[1]) + ", expected [first, last]");
  }
}

void read_click(TableReader& table, std::size_t index, const toml::node& entry,
                const StartContext& context, core::StartSettings& start) {
  const toml::table* const click = entry.as_table();
  if (click == nullptr) {
    table.complain_entry(kClicksKey, index, entry,
                         describe(entry) + ", expected { row = R, column = C, at_px = [U, V] }");
    return;
  }
  const std::size_t before = table.problems().size();
  TableReader reader(*click, table.place_of(entry),
                     table.name() + ".tubes[" + std::to_string(index) + "]", table.problems());
  core::StartPoint point;
  const core::CameraSettings* const camera = context.camera;
  const double most =
      camera == nullptr ? kSide_px.most : std::max(camera->width_px, camera->height_px);
  read_keys(reader, kAddressKeys, point.address);
  if (reader.numbers(kClickPlaceKey, {0.0, most - 1, " px"}, point.at_px) && camera != nullptr &&
      !in_picture(*camera, point.at_px)) {
    reader.complain(kClickPlaceKey, point_text(point.at_px) +
                                        ", expected a place in the picture of " +
                                        std::to_string(camera->width_px) + " x " +
                                        std::to_string(camera->height_px));
  }
  reader.finish();
  if (table.problems().size() != before) {
    return;
  }
  if (context.tubesheet != nullptr) {
    const std::string wrong = why_no_tube(*context.tubesheet, point.address);
    if (!wrong.empty()) {
      table.complain_entry(kClicksKey, index, entry, wrong);
    }
  }
  if (!start.tubes.try_push_back(point)) {
    table.complain_entry(
        kClicksKey, index, entry,
        "too many clicks, expected at most " + std::to_string(core::kMaxStartPoints));
  }
}

}  // namespace

void read_camera(TableReader& table, core::CameraSettings& camera) {
  const std::size_t before = table.problems().size();
  read_keys(table, kCameraKeys, camera);
  if (table.sound("width_px") && table.sound("height_px") && table.sound("center_px") &&
      !in_picture(camera, camera.center_px)) {
    table.complain("center_px",
                   point_text(camera.center_px) + ", expected a place in the picture of " +
                       std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px));
  }
  if (table.problems().size() == before) {
    const std::string wrong = why_picture_folds(camera);
    if (!wrong.empty()) {
      table.complain("distortion_per_mm2", wrong);
    }
  }
}

void read_tool(TableReader& table, core::ToolSettings& tool) { read_keys(table, kToolKeys, tool); }

void read_tubesheet(TableReader& table, core::TubesheetSettings& tubesheet) {
  // What may be left out; a temporary of the whole would lie on the stack.
  tubesheet.origin_mm = {};
  tubesheet.weld = {};
  tubesheet.addresses = {};
  tubesheet.odd_row_shift = 0.0;
  read_keys(table, kTubesheetKeys, tubesheet);
  check_range(table, "rows", tubesheet.rows);
  check_range(table, "columns", tubesheet.columns);
  const bool ranges = table.sound("rows") && table.sound("columns");
  for (const AddressesKey& list : kTubesheetLists) {
    read_addresses(table, list.key, tubesheet, ranges, tubesheet.*list.member);
  }
  if (table.sound("row_step_mm") && table.sound("column_step_mm") && table.sound("odd_row_shift")) {
    std::string wrong = why_no_lattice(tubesheet);
    if (!wrong.empty()) {
      table.complain("column_step_mm", wrong);
      return;
    }
    wrong = table.sound("bore_mm") ? why_bore_too_wide(tubesheet) : "";
    if (!wrong.empty()) {
      table.complain("bore_mm", wrong);
    }
    wrong = ranges ? why_sheet_too_large(tubesheet) : "";
    if (!wrong.empty()) {
      table.complain("rows", wrong);
    }
  }
  if (const auto both = listed_twice(tubesheet)) {
    table.complain("plugged", address_text(*both) + " is missing as well, expected it in one list");
  }
}

void read_clicks(TableReader& table, const StartContext& context, std::size_t least,
                 core::StartSettings& start) {
  const std::string expected =
      (least > 0 ? "at least " + std::to_string(least) + " times" : "a list of") +
      " { row = R, column = C, at_px = [U, V] }";
  const toml::array* const entries = table.list(kClicksKey, least > 0, expected.c_str());
  if (entries == nullptr) {
    return;
  }
  const std::size_t before = table.problems().size();
  if (entries->size() < least) {
    table.complain(kClicksKey, describe(*entries) + ", expected " + expected);
  }
  for (std::size_t i = 0; i < entries->size() && i <= core::kMaxStartPoints; ++i) {
    read_click(table, i, (*entries)[i], context, start);
  }
  if (table.problems().size() == before) {
    const std::string wrong = why_clicks_contradict(start, context.tubesheet);
    if (!wrong.empty()) {
      table.complain(kClicksKey, wrong);
    }
  }
}

void read_start(TableReader& table, const StartContext& context, std::size_t least,
                core::StartSettings& start) {
  read_clicks(table, context, least, start);
  read_start_window(table, context, start);
}

void read_start_window(TableReader& table, const StartContext& context,
                       core::StartSettings& start) {
  read_key(table, kStartWindowKey, start);
  if (table.sound(kStartWindowKey.key)) {
    const std::string wrong = why_no_window(start.window_px, context.camera);
    if (!wrong.empty()) {
      table.complain(kStartWindowKey.key, wrong);
    }
  }
  const bool window = table.sound(kStartWindowKey.key);
  const auto& [left, top, right, bottom] = start.window_px;
  if (window) {
    start.optimum_px = {(left + right) / 2.0, (top + bottom) / 2.0};
  }
  read_key(table, kStartOptimumKey, start);
  const auto& [u, v] = start.optimum_px;
  if (window && table.has(kStartOptimumKey.key) && table.sound(kStartOptimumKey.key) &&
      (u < left || u > right || v < top || v > bottom)) {
    table.complain(kStartOptimumKey.key,
                   point_text(start.optimum_px) + ", expected a place in window_px");
  }
}

void read_heading(TableReader& table, std::optional<double>& heading_deg) {
  heading_deg.reset();
  double value = 0.0;
  if (table.optional_number(kStartHeadingKey, kAngle, value) && table.has(kStartHeadingKey)) {
    heading_deg = value;
  }
}

void read_motion(TableReader& table, core::MotionSettings& motion) {
  read_keys(table, kMotionKeys, motion);
}

void read_edges(TableReader& table, core::EdgeSettings& edges) {
  read_keys(table, kEdgeKeys, edges);
}

void read_verification(TableReader& table, core::VerificationSettings& verification) {
  read_keys(table, kVerificationKeys, verification);
}

void read_camera_device(TableReader& table, CalibrationQuality& quality) {
  quality.serial.clear();
  quality.model.clear();
  table.optional_text("serial", quality.serial);
  table.optional_text("model", quality.model);
}

void read_quality(TableReader& table, CalibrationQuality& quality) {
  table.text("id", quality.id);
  read_camera_device(table, quality);
  for (const std::string_view key : {"made_at", "sigma", "correlation", "verdict"}) {
    table.ignore(key);
  }
  if (table.has("sigma")) {
    const auto not_below_zero = [](double value) { return value >= 0.0; };
    quality.has_sigma =
        take_numbers(table.list("sigma", false, "a list of numbers"), quality.sigma) &&
        std::all_of(quality.sigma.begin(), quality.sigma.end(), not_below_zero);
  }
  quality.correlation = {};
  for (std::size_t i = 0; i < quality.sigma.size(); ++i) {
    quality.correlation[7 * i] = 1.0;
  }
  if (table.has("correlation")) {
    take_matrix(table.list("correlation", false, "a list of lists"), quality.correlation);
  }
  quality.focal_length_correlation = {};
  if (!take_numbers(table.list("focal_length_correlation", false, "a list of numbers"),
                    quality.focal_length_correlation)) {
    quality.focal_length_correlation = {};
  }
}

}  // namespace tubesight::drivers
