#include "board/bench/calibrate/zones_file.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "board/bench/output/csv_cells.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/text_files.h"

namespace tubesight::board {
namespace {

using core::calibration::ZonePoint;

const std::vector<std::string_view> kColumns = {"sheet_x_mm", "sheet_y_mm", "dx_mm",
                                                "dy_mm",      "dz_mm",      "sigma_mm"};
constexpr std::array<double, 6> kMost = {100000.0, 100000.0, 100.0, 100.0, 100.0, 100.0};

}  // namespace

bool read_zones(const std::string& path, core::calibration::ZonePoints& points,
                std::vector<std::string>& messages) {
  points.clear();
  drivers::DiskFiles files;
  std::string text;
  std::string message;
  if (!files.read(path, text, message)) {
    messages.push_back(path + ": " + message);
    return false;
  }
  drivers::CsvReader reader(text, path);
  const std::size_t before = messages.size();
  if (!reader.read_header(kColumns, messages)) {
    return false;
  }
  while (reader.next(messages) && messages.size() < drivers::CsvReader::kMostMessages) {
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      constexpr std::int32_t kDigits = 9;
      std::int64_t value = 0;
      const std::string& cell = reader.cells()[i];
      const bool number = drivers::parse_decimal(cell, kDigits, value);
      values[i] = 1e-9 * static_cast<double>(value);
      if (!number || std::abs(values[i]) > kMost[i] || (i == 5 && !(values[i] > 0.0))) {
        messages.push_back(reader.place() + std::string(kColumns[i]) + ": " +
                           drivers::in_quotes(cell) + ", expected a number up to " +
                           drivers::number_text(kMost[i]) + (i == 5 ? " and above 0" : "") +
                           " with at most 9 decimals");
        break;
      }
    }
    ZonePoint point;
    point.at_mm << values[0], values[1];
    point.off_mm << values[2], values[3], values[4];
    point.sigma_mm = values[5];
    if (!points.try_push_back(point)) {
      messages.push_back(reader.place() + "more than " +
                         std::to_string(core::calibration::kMaxZones) +
                         " corrections, expected at most that many");
      return false;
    }
  }
  return messages.size() == before;
}

std::string zones_text(const core::calibration::ZonePoints& points) {
  std::string text = "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n";
  for (const ZonePoint& point : points) {
    std::string row;
    for (const double value : {point.at_mm.x(), point.at_mm.y(), point.off_mm.x(), point.off_mm.y(),
                               point.off_mm.z(), point.sigma_mm}) {
      append_cell(row, value, 4);
    }
    text += row.substr(1) + "\n";
  }
  return text;
}

}  // namespace tubesight::board
