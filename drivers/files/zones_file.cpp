#include "drivers/files/zones_file.h"

#include <cmath>
#include <cstdint>

#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

const std::vector<std::string_view> kColumns = {"sheet_x_mm", "sheet_y_mm", "dx_mm",
                                                "dy_mm",      "dz_mm",      "sigma_mm"};
constexpr std::array<double, 6> kMost = {100000.0, 100000.0, 100.0, 100.0, 100.0, 100.0};

}  // namespace

bool read_zone_rows(std::string_view text, const std::string& name, std::size_t most,
                    std::vector<ZoneRow>& rows, Messages& messages) {
  rows.clear();
  CsvReader reader(text, name);
  const std::size_t before = messages.size();
  if (!reader.read_header(kColumns, messages)) {
    return false;
  }
  while (reader.next(messages) && messages.size() < CsvReader::kMostMessages) {
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      constexpr std::int32_t kDigits = 9;
      std::int64_t value = 0;
      const std::string& cell = reader.cells()[i];
      const bool number = parse_decimal(cell, kDigits, value);
      values[i] = 1e-9 * static_cast<double>(value);
      if (!number || std::abs(values[i]) > kMost[i] || (i == 5 && !(values[i] > 0.0))) {
        messages.push_back(reader.place() + std::string(kColumns[i]) + ": " + in_quotes(cell) +
                           ", expected a number up to " + number_text(kMost[i]) +
                           (i == 5 ? " and above 0" : "") + " with at most 9 decimals");
        break;
      }
    }
    if (rows.size() >= most) {
      messages.push_back(reader.place() + "more than " + std::to_string(most) +
                         " corrections, expected at most that many");
      return false;
    }
    rows.push_back({{values[0], values[1]}, {values[2], values[3], values[4]}, values[5]});
  }
  return messages.size() == before;
}

}  // namespace tubesight::drivers
