#include "drivers/replay/replay_meta.h"

#include <algorithm>

#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

/// Under half of what 64 bits hold (292 years), so that differences fit.
constexpr std::int64_t kLargestTime_ns = 4'000'000'000'000'000'000;
/// Half of what 64 bits hold, so that differences fit.
constexpr std::int64_t kLargestSequence = std::int64_t{1} << 62;

bool parse_row(const CsvReader& csv, FieldMeta& row, Messages& messages) {
  const auto& cells = csv.cells();
  bool good = true;
  const auto complain = [&](const char* column, const std::string& cell, const char* expected) {
    messages.push_back(csv.place() + column + ": " + in_quotes(cell) + ", expected " + expected);
    good = false;
  };
  if (!parse_whole(cells[0], row.field) || row.field < 0) {
    complain("field", cells[0], "a whole number from 0");
  }
  if (!parse_whole(cells[1], row.sequence) || row.sequence < -kLargestSequence ||
      row.sequence > kLargestSequence) {
    complain("sequence", cells[1], "a whole number");
  }
  std::int64_t time_ns = 0;
  if (!parse_decimal(cells[2], 9, time_ns) || time_ns < -kLargestTime_ns ||
      time_ns > kLargestTime_ns) {
    complain("time_s", cells[2], "seconds with at most 9 decimals");
  }
  row.time = core::FieldTime(time_ns);
  if (cells[3] == "good" || cells[3] == "ok") {
    row.status = core::FieldStatus::kGood;
  } else if (cells[3] == "damaged") {
    row.status = core::FieldStatus::kDamaged;
  } else {
    complain("status", cells[3], "good or damaged");
  }
  if (!cells[4].empty()) {
    std::int32_t lamp = 0;
    if (!parse_whole(cells[4], lamp) || lamp < 0 || lamp > 1000) {
      complain("lamp_permille", cells[4], "a whole number from 0 to 1000, or nothing");
    }
    row.lamp_permille = lamp;
  }
  return good;
}

}  // namespace

core::Result<void> ReplayMeta::parse(std::string_view text, const std::string& name,
                                     Messages& messages) {
  rows_.clear();
  Messages found;
  CsvReader csv(text, name);
  if (csv.read_header({"field", "sequence", "time_s", "status", "lamp_permille"}, found)) {
    while (found.size() < CsvReader::kMostMessages && csv.next(found)) {
      FieldMeta row;
      if (!parse_row(csv, row, found)) {
        continue;
      }
      if (!rows_.empty() && row.field <= rows_.back().field) {
        found.push_back(csv.place() + "field: " + std::to_string(row.field) +
                        ", expected more than in the row before (" +
                        std::to_string(rows_.back().field) + ")");
        continue;
      }
      row.line = csv.line_number();
      rows_.push_back(row);
    }
  }
  messages.insert(messages.end(), found.begin(), found.end());
  return found.empty() ? core::Result<void>() : core::Unexpected(core::Error::kInvalidArgument);
}

const FieldMeta* ReplayMeta::find(std::int64_t field) const {
  const auto row = std::lower_bound(
      rows_.begin(), rows_.end(), field,
      [](const FieldMeta& candidate, std::int64_t wanted) { return candidate.field < wanted; });
  return row != rows_.end() && row->field == field ? &*row : nullptr;
}

}  // namespace tubesight::drivers
