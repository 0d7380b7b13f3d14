#include "drivers/settings/session_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "drivers/settings/session_checks.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;

// Limits wide enough for any plant, narrow enough to catch a wrong unit or a slipped point.
constexpr WholeRange kSide_px{64, 4096};
constexpr WholeRange kCells{16, 16384};  // cells or samples of a line
constexpr NumberRange kFocalLength{0.1, 1000.0, " mm"};
constexpr NumberRange kCell{0.0005, 0.1, " mm"};  // half a micrometre to 100
constexpr NumberRange kScale{0.5, 2.0, ""};
constexpr NumberRange kDistortion{-10.0, 10.0, " per mm2"};
constexpr NumberRange kDistortion2{-10.0, 10.0, " per mm4"};
constexpr NumberRange kToolPosition{-1000.0, 1000.0, " mm"};
constexpr NumberRange kAngle{-360.0, 360.0, " degrees"};
constexpr NumberRange kSheetPlace{-kLargestSheet_mm, kLargestSheet_mm, " mm"};
constexpr NumberRange kStep{-500.0, 500.0, " mm"};
constexpr NumberRange kShift{-1.0, 1.0, " of a column step"};
constexpr NumberRange kBore{1.0, 200.0, " mm"};
constexpr WholeRange kAddress{-9999, 9999};
constexpr NumberRange kSpeed{1.0, 1600.0, " mm/s"};
constexpr NumberRange kAcceleration{1.0, 1000000.0, " mm/s2"};
constexpr WholeRange kInitialThreshold{0, 24 * 255};  // a sum of 24 grey values
constexpr WholeRange kRegionThreshold{0, 255};
constexpr NumberRange kGate{0.1, 50.0, " mm"};
constexpr NumberRange kClaimSpan{0.001, 1.0, " s"};  // the last second of fields is kept
constexpr NumberRange kAnyNumber{std::numeric_limits<double>::lowest(),
                                 std::numeric_limits<double>::max(), ""};

constexpr std::array<std::string_view, 3> kScanWords = {"even-first", "odd-first", "progressive"};
constexpr std::array<std::string_view, 2> kWeldWords = {"flush", "fillet"};
constexpr std::array<std::string_view, 3> kAddressWords = {"all", "even-sum", "odd-sum"};

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

/// Reads an optional word; absent, the first of `words` holds. T's enumerators stand in their
/// order.
template <typename T, std::size_t N>
T optional_word(TableReader& table, std::string_view key,
                const std::array<std::string_view, N>& words) {
  std::size_t index = 0;
  table.optional_word(key, words, index);
  return static_cast<T>(index);
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
    } else if (ranges_known && !in_ranges(tubesheet, address)) {
      table.complain_entry(key, i, entry,
                           address_text(address) + ", expected " + ranges_text(tubesheet));
    } else {
      static_cast<void>(list.try_push_back(address));  // fits: counted above
    }
  }
}

bool read_range(TableReader& table, std::string_view key, std::array<std::int32_t, 2>& range) {
  if (!table.wholes(key, kAddress, range)) {
    return false;
  }
  if (range[0] > range[1]) {
    table.complain(key, "the first, " + std::to_string(range[0]) + ", is above the last, " +
                            std::to_string(range[1]) + ", expected [first, last]");
    return false;
  }
  return true;
}

void read_click(TableReader& table, std::size_t index, const toml::node& entry,
                const StartContext& context, core::StartSettings& start) {
  const toml::table* const click = entry.as_table();
  if (click == nullptr) {
    table.complain_entry("tubes", index, entry,
                         describe(entry) + ", expected { row = R, column = C, at_px = [U, V] }");
    return;
  }
  const std::size_t before = table.problems().size();
  TableReader reader(*click, table.place_of(entry), "start.tubes[" + std::to_string(index) + "]",
                     table.problems());
  core::StartPoint point;
  const core::CameraSettings* const camera = context.camera;
  const double most =
      camera == nullptr ? kSide_px.most : std::max(camera->width_px, camera->height_px);
  reader.whole("row", kAddress, point.address.row);
  reader.whole("column", kAddress, point.address.column);
  if (reader.numbers("at_px", {0.0, most - 1, " px"}, point.at_px) && camera != nullptr &&
      !in_picture(*camera, point.at_px)) {
    reader.complain("at_px", point_text(point.at_px) + ", expected a place in the picture of " +
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
      table.complain_entry("tubes", index, entry, wrong);
    }
  }
  if (!start.tubes.try_push_back(point)) {
    table.complain_entry(
        "tubes", index, entry,
        "too many clicks, expected at most " + std::to_string(core::kMaxStartPoints));
  }
}

bool read_window(TableReader& table, const core::CameraSettings* camera,
                 std::array<std::int32_t, 4>& window_px) {
  if (!table.wholes("window_px", {0, kSide_px.most - 1}, window_px)) {
    return false;
  }
  const std::string wrong = why_no_window(window_px, camera);
  if (!wrong.empty()) {
    table.complain("window_px", wrong);
  }
  return wrong.empty();
}

}  // namespace

void read_camera(TableReader& table, core::CameraSettings& camera) {
  const std::size_t before = table.problems().size();
  const bool sized = static_cast<int>(table.whole("width_px", kSide_px, camera.width_px)) +
                         static_cast<int>(table.whole("height_px", kSide_px, camera.height_px)) ==
                     2;
  std::size_t scan = 0;
  table.word("scan", kScanWords, scan);
  camera.scan = static_cast<core::Scan>(scan);
  table.number("focal_length_mm", kFocalLength, camera.focal_length_mm);
  table.number("cell_width_mm", kCell, camera.cell_width_mm);
  table.number("cell_height_mm", kCell, camera.cell_height_mm);
  table.whole("sensor_columns", kCells, camera.sensor_columns);
  table.whole("frame_columns", kCells, camera.frame_columns);
  table.number("horizontal_scale", kScale, camera.horizontal_scale);
  const NumberRange center{0.0, static_cast<double>(kSide_px.most), " px"};
  if (table.numbers("center_px", center, camera.center_px) && sized &&
      !in_picture(camera, camera.center_px)) {
    table.complain("center_px",
                   point_text(camera.center_px) + ", expected a place in the picture of " +
                       std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px));
  }
  table.number("distortion_per_mm2", kDistortion, camera.distortion_per_mm2);
  table.optional_number("distortion2_per_mm4", kDistortion2, camera.distortion2_per_mm4);
  if (table.problems().size() == before) {
    const std::string wrong = why_picture_folds(camera);
    if (!wrong.empty()) {
      table.complain("distortion_per_mm2", wrong);
    }
  }
}

void read_tool(TableReader& table, core::ToolSettings& tool) {
  table.numbers("position_mm", kToolPosition, tool.position_mm);
  table.numbers("rotation_deg", kAngle, tool.rotation_deg);
}

void read_tubesheet(TableReader& table, core::TubesheetSettings& tubesheet) {
  tubesheet.origin_mm = {};
  table.optional_numbers("origin_mm", kSheetPlace, tubesheet.origin_mm);
  const bool row_step = table.numbers("row_step_mm", kStep, tubesheet.row_step_mm);
  const bool column_step = table.numbers("column_step_mm", kStep, tubesheet.column_step_mm);
  const bool bore = table.number("bore_mm", kBore, tubesheet.bore_mm);
  tubesheet.weld = optional_word<core::Weld>(table, "weld", kWeldWords);
  const bool rows = read_range(table, "rows", tubesheet.rows);
  const bool columns = read_range(table, "columns", tubesheet.columns);
  tubesheet.addresses = optional_word<core::AddressParity>(table, "addresses", kAddressWords);
  tubesheet.odd_row_shift = 0.0;
  const bool shift = table.optional_number("odd_row_shift", kShift, tubesheet.odd_row_shift);
  read_addresses(table, "missing", tubesheet, rows && columns, tubesheet.missing);
  read_addresses(table, "plugged", tubesheet, rows && columns, tubesheet.plugged);
  if (row_step && column_step && shift) {
    std::string wrong = why_no_lattice(tubesheet);
    if (!wrong.empty()) {
      table.complain("column_step_mm", wrong);
      return;
    }
    wrong = bore ? why_bore_too_wide(tubesheet) : "";
    if (!wrong.empty()) {
      table.complain("bore_mm", wrong);
    }
    wrong = rows && columns ? why_sheet_too_large(tubesheet) : "";
    if (!wrong.empty()) {
      table.complain("rows", wrong);
    }
  }
  if (const auto both = listed_twice(tubesheet)) {
    table.complain("plugged", address_text(*both) + " is missing as well, expected it in one list");
  }
}

void read_clicks(TableReader& table, const StartContext& context, core::StartSettings& start) {
  constexpr const char* kExpected = "at least 3 times { row = R, column = C, at_px = [U, V] }";
  const toml::array* const entries = table.list("tubes", true, kExpected);
  if (entries == nullptr) {
    return;
  }
  const std::size_t before = table.problems().size();
  if (entries->size() < 3) {
    table.complain("tubes", describe(*entries) + ", expected " + kExpected);
  }
  for (std::size_t i = 0; i < entries->size() && i <= core::kMaxStartPoints; ++i) {
    read_click(table, i, (*entries)[i], context, start);
  }
  if (table.problems().size() == before) {
    const std::string wrong = why_clicks_contradict(start, context.tubesheet);
    if (!wrong.empty()) {
      table.complain("tubes", wrong);
    }
  }
}

void read_start(TableReader& table, const StartContext& context, core::StartSettings& start) {
  read_clicks(table, context, start);
  read_start_window(table, context, start);
}

void read_start_window(TableReader& table, const StartContext& context,
                       core::StartSettings& start) {
  const bool window = read_window(table, context.camera, start.window_px);
  if (window) {
    start.optimum_px = {(start.window_px[0] + start.window_px[2]) / 2.0,
                        (start.window_px[1] + start.window_px[3]) / 2.0};
  }
  if (!table.has("optimum_px")) {
    table.ignore("optimum_px");
    return;
  }
  const NumberRange place{0.0, static_cast<double>(kSide_px.most), " px"};
  if (table.numbers("optimum_px", place, start.optimum_px) && window) {
    const auto& [left, top, right, bottom] = start.window_px;
    const auto& [u, v] = start.optimum_px;
    if (u < left || u > right || v < top || v > bottom) {
      table.complain("optimum_px",
                     point_text(start.optimum_px) + ", expected a place in window_px");
    }
  }
}

void read_motion(TableReader& table, core::MotionSettings& motion) {
  table.optional_number("max_speed_mm_s", kSpeed, motion.max_speed_mm_s);
  table.optional_number("max_acceleration_mm_s2", kAcceleration, motion.max_acceleration_mm_s2);
}

void read_edges(TableReader& table, core::EdgeSettings& edges) {
  table.optional_whole("initial_threshold", kInitialThreshold, edges.initial_threshold);
  table.optional_whole("region_threshold", kRegionThreshold, edges.region_threshold);
}

void read_verification(TableReader& table, core::VerificationSettings& verification) {
  table.optional_number("aligned_within_mm", kGate, verification.aligned_within_mm);
  table.optional_number("claim_within_s", kClaimSpan, verification.claim_within_s);
  table.optional_number("claim_oldest_s", kClaimSpan, verification.claim_oldest_s);
}

void read_quality(TableReader& table, CalibrationQuality& quality) {
  table.text("id", quality.id);
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
}

void read_base(TableReader& table) {
  std::array<double, 3> values{};
  table.numbers("position_mm", kAnyNumber, values);
  table.numbers("rotation_deg", kAngle, values);
}

}  // namespace tubesight::drivers
