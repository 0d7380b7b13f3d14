#include "board/bench/calibrate/zones_file.h"

#include <cstddef>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/output/csv_cells.h"
#include "drivers/files/zones_file.h"

namespace tubesight::board {

using core::calibration::ZonePoint;

bool read_zones(const std::string& path, core::calibration::ZonePoints& points,
                std::vector<std::string>& messages) {
  points.clear();
  std::string text;
  if (!read_whole(path, text, messages)) {
    return false;
  }
  std::vector<drivers::ZoneRow> rows;
  const bool good = drivers::read_zone_rows(
      text, path, static_cast<std::size_t>(core::calibration::kMaxZones), rows, messages);
  for (const drivers::ZoneRow& row : rows) {
    // As many as were read have room.
    static_cast<void>(
        points.try_push_back(core::calibration::zone_point(row.at_mm, row.off_mm, row.sigma_mm)));
  }
  return good;
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
