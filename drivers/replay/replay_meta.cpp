#include "drivers/replay/replay_meta.h"

#include <algorithm>

#include "drivers/files/csv_reader.h"
#include "drivers/replay/field_time.h"
#include "drivers/replay/meta_growth.h"

namespace tubesight::drivers {
namespace {

/// Under half of what 64 bits hold, so that differences fit.
constexpr std::int64_t kLargestSequence = (std::int64_t{1} << 62) - 1;

/// Whether the text is a whole number of any size, as which it is too large where it does not fit.
bool is_whole(std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
}

bool parse_row(const CsvReader& csv, FieldMeta& row, Messages& messages) {
  const auto& cells = csv.cells();
  bool good = true;
  const auto complain = [&](const char* column, const std::string& cell, const char* expected) {
    messages.push_back(csv.place() + column + ": " + in_quotes(cell) + ", expected " + expected);
    good = false;
  };
  if (!parse_whole(cells[0], row.field) || row.field < 0) {
    complain("field", cells[0],
             is_whole(cells[0]) && !cells[0].starts_with('-') ? "a smaller number"
                                                              : "a whole number from 0");
  }
  // Who writes a missing field's row has no number of it.
  const bool has_sequence = cells[3] != "missing" || !cells[1].empty();
  if (has_sequence && (!parse_whole(cells[1], row.sequence) || row.sequence < -kLargestSequence ||
                       row.sequence > kLargestSequence)) {
    complain("sequence", cells[1],
             is_whole(cells[1]) ? "a number below 2^62 either way" : "a whole number");
  }
  const char* expected = nullptr;
  if (!parse_time(cells[2], row.time, expected)) {
    complain("time_s", cells[2], expected);
  }
  if (cells[3] == "good" || cells[3] == "ok") {
    row.status = core::FieldStatus::kGood;
  } else if (cells[3] == "damaged") {
    row.status = core::FieldStatus::kDamaged;
  } else if (cells[3] == "missing") {
    row.status = core::FieldStatus::kMissing;
  } else {
    complain("status", cells[3], "good, damaged or missing");
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
                                     Messages& messages, Writer writer) {
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
    if (writer == Writer::kAnybody) {
      check_growth(rows_, name, found);
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
