#include "board/bench/calibrate/points_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::calibration::CalibrationData;
using core::calibration::CalibrationView;
using core::calibration::SeenDot;

// A start needs more, a fit many more; fewer are a wrong file.
constexpr std::int32_t kLeastPoints = 12;

bool has_depth(const CalibrationData& data, const CalibrationView& view) {
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    if (data.dots[i].place_mm.z() != 0.0) {
      return true;
    }
  }
  return false;
}

std::string points_text(const CalibrationData& data, const CalibrationView& view) {
  const bool depth = has_depth(data, view);
  std::string text = depth ? "x_mm,y_mm,z_mm,u_px,v_px\n" : "x_mm,y_mm,u_px,v_px\n";
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    const SeenDot& dot = data.dots[i];
    drivers::print(text, "%.6f,%.6f,", dot.place_mm.x(), dot.place_mm.y());
    if (depth) {
      drivers::print(text, "%.6f,", dot.place_mm.z());
    }
    drivers::print(text, "%.6f,%.6f\n", dot.seen_px.x(), dot.seen_px.y());
  }
  return text;
}

}  // namespace

std::string read_points(
    const std::string& path,
    core::StaticVector<core::calibration::SeenDot, core::calibration::kMaxDots>& dots) {
  std::string text;
  drivers::Messages messages;
  if (!read_whole(path, text, messages)) {
    return messages.front();
  }
  drivers::Messages ignored;
  drivers::CsvReader csv(text, path);
  std::size_t columns = 5;
  if (!csv.read_header({"x_mm", "y_mm", "z_mm", "u_px", "v_px"}, ignored)) {
    csv = drivers::CsvReader(text, path);
    columns = 4;
    if (!csv.read_header({"x_mm", "y_mm", "u_px", "v_px"}, messages)) {
      return messages.front();
    }
  }
  std::int32_t count = 0;
  while (csv.next(messages)) {
    constexpr std::int32_t kDigits = 9;
    constexpr double kUnit = 1e-9;
    std::array<double, 5> values{};
    for (std::size_t i = 0; i < columns; ++i) {
      std::int64_t value = 0;
      if (!drivers::parse_decimal(csv.cells()[i], kDigits, value)) {
        return csv.place() + drivers::in_quotes(csv.cells()[i]) +
               ", expected a number with up to 9 decimals";
      }
      values[i] = kUnit * static_cast<double>(value);
    }
    SeenDot dot;
    dot.place_mm << values[0], values[1], columns == 5 ? values[2] : 0.0;
    dot.seen_px << values[columns - 2], values[columns - 1];
    if (!dots.try_push_back(dot)) {
      return csv.place() + "more than " + std::to_string(core::calibration::kMaxDots) +
             " points, expected at most that many";
    }
    ++count;
  }
  if (!messages.empty()) {
    return messages.front();
  }
  return count >= kLeastPoints ? ""
                               : path + ": " + std::to_string(count) +
                                     " points, expected at least " + std::to_string(kLeastPoints);
}

std::vector<std::string> points_files(const std::string& folder, std::size_t views) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < views; ++i) {
    const std::string name = "view-" + std::to_string(i) + ".csv";
    files.push_back((std::filesystem::path(folder) / name).string());
  }
  files.push_back((std::filesystem::path(folder) / "target.toml").string());
  return files;
}

bool write_points(const std::string& folder, const drivers::TargetFile& file,
                  const CalibrationData& data) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    tell(folder + ": cannot be made: " + error.message());
    return false;
  }
  const std::vector<std::string> paths = points_files(folder, file.views.size());
  const std::vector<std::string> names = points_files("", file.views.size());
  std::vector<drivers::AtomicFile> files(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string text = i < file.views.size()
                                 ? points_text(data, data.views[static_cast<std::int32_t>(i)])
                                 : drivers::target_text(file, names);
    if (!files[i].open(paths[i]) || !files[i].write(text) || !files[i].flush()) {
      tell(files[i].message());
      return false;
    }
  }
  for (drivers::AtomicFile& each : files) {
    if (!each.commit_to_disk()) {
      tell(each.message());
      return false;
    }
  }
  return true;
}

}  // namespace tubesight::board
