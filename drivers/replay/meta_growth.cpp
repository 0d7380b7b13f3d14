#include "drivers/replay/meta_growth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

using core::FieldStatus;
using core::FieldTime;

std::string seconds_text(FieldTime time) {
  std::string text;
  append_decimal(text, time.count(), 1'000'000'000, 9);
  return text;
}

/// Whether two rows are those of one interlaced frame.
bool of_one_frame(const FieldMeta& before, const FieldMeta& row) {
  return row.field % 2 == 1 && before.field == row.field - 1;
}

/// A column whose values grow from row to row, as far as they exist.
class GrowingColumn {
 public:
  GrowingColumn(std::string name, std::string column, Messages& messages)
      : name_(std::move(name)), column_(std::move(column)), messages_(messages) {}

  void tell(const FieldMeta& row, const std::string& what) {
    if (messages_.size() < CsvReader::kMostMessages) {
      messages_.push_back(name_ + ":" + std::to_string(row.line) + ": " + column_ + ": " + what);
    }
  }

  /// Tells a value that is the one of the row before too; of all frames only the first.
  void tell_same(const FieldMeta& before, const FieldMeta& row, const std::string& value,
                 const char* expected) {
    if (!of_one_frame(before, row)) {
      tell(row, value + ", expected more than in the row before");
    } else if (!told_frame_) {
      tell(row, value + " for both fields of a frame, expected " + expected);
      told_frame_ = true;
    }
  }

 private:
  std::string name_;
  std::string column_;
  Messages& messages_;
  bool told_frame_ = false;
};

void check_times(const std::vector<FieldMeta>& rows, GrowingColumn column) {
  if (rows.size() > 2 && std::all_of(rows.begin(), rows.end(), [&](const FieldMeta& row) {
        return row.time == rows.front().time;
      })) {
    column.tell(rows[1], seconds_text(rows[1].time) + " in all " + std::to_string(rows.size()) +
                             " rows, expected more in each");
    return;
  }
  std::size_t came = 0;  // the last row of a field that came
  for (std::size_t i = 1; i < rows.size(); ++i) {
    // A field that comes after it was given up may be older than its giving up.
    const bool missing = rows[i].status == core::FieldStatus::kMissing;
    const FieldMeta& before = rows[missing ? i - 1 : came];
    came = missing ? came : i;
    if (!missing && &before == rows.data() && before.status == core::FieldStatus::kMissing) {
      continue;
    }
    if (rows[i].time == before.time) {
      column.tell_same(before, rows[i], seconds_text(rows[i].time),
                       "each field's own mid-exposure");
    } else if (rows[i].time < before.time) {
      column.tell(rows[i], seconds_text(rows[i].time) + ", expected more than in the row before (" +
                               seconds_text(before.time) + ")");
    }
  }
}

/// Time from one field to the next, by the rows whose numbers follow each other: the middle one of
/// all, so that rows with lost fields or wrong times do no harm. 0 when there are none.
std::int64_t usual_step_ns(const std::vector<FieldMeta*>& counted) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < counted.size(); ++i) {
    if (counted[i]->sequence - counted[i - 1]->sequence == 1) {
      steps.push_back((counted[i]->time - counted[i - 1]->time).count());
    }
  }
  if (steps.empty()) {
    return 0;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max<std::int64_t>(*middle, 0);
}

/// Takes the numbers of a counter that may wrap, in turn.
class Unwrapper {
 public:
  explicit Unwrapper(std::int64_t step_ns) : step_ns_(step_ns) {}

  /// By how many the counter grew over a time; empty when it went back or stood still.
  std::optional<std::int64_t> grown(std::int64_t before, std::int64_t now, FieldTime over) {
    least_ = std::min({least_, before, now});
    most_ = std::max({most_, before, now});
    if (now > before) {
      return now - before;
    }
    if (now == before || least_ < 0) {
      return std::nullopt;
    }
    for (const std::int64_t values : kCounters) {
      if (most_ < values) {
        return over_the_wrap(now - before + values, now, over);
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::array<std::int64_t, 3> kCounters = {
      std::int64_t{1} << 8, std::int64_t{1} << 16, std::int64_t{1} << 32};

  std::optional<std::int64_t> over_the_wrap(std::int64_t numbers, std::int64_t now,
                                            FieldTime over) const {
    if (numbers == 1) {
      return numbers;  // from the largest value to 0
    }
    if (step_ns_ == 0 || over.count() <= 0) {
      return std::nullopt;
    }
    const std::int64_t fields =
        over.count() / step_ns_ + (over.count() % step_ns_ > step_ns_ / 2 ? 1 : 0);
    if (fields == numbers) {
      return numbers;
    }
    // One number less when the counter passes over 0.
    return now >= 1 && std::max<std::int64_t>(fields, 1) == numbers - 1 ? std::optional(numbers - 1)
                                                                        : std::nullopt;
  }

  std::int64_t step_ns_;
  std::int64_t least_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t most_ = std::numeric_limits<std::int64_t>::min();
};

/// Checks the numbers of the rows that have some, and unwraps them.
void check_numbers(const std::vector<FieldMeta*>& counted, GrowingColumn column) {
  if (counted.size() > 2 && std::all_of(counted.begin(), counted.end(), [&](const FieldMeta* row) {
        return row->sequence == counted.front()->sequence;
      })) {
    column.tell(*counted[1], std::to_string(counted[1]->sequence) + " in all " +
                                 std::to_string(counted.size()) +
                                 " rows, expected 1 more in each (the driver does not count)");
    return;
  }
  Unwrapper unwrapper(usual_step_ns(counted));
  std::int64_t last = counted.empty() ? 0 : counted.front()->sequence;  // as it stands in the file
  for (std::size_t i = 1; i < counted.size(); ++i) {
    const FieldMeta& before = *counted[i - 1];
    FieldMeta& row = *counted[i];
    const std::int64_t now = row.sequence;
    const auto grown = unwrapper.grown(last, now, row.time - before.time);
    if (grown) {
      row.sequence = before.sequence + *grown;
    } else if (now == last) {
      column.tell_same(before, row, std::to_string(now), "1 more for the later");
    } else {
      column.tell(row, std::to_string(now) + ", expected more than in the row before (" +
                           std::to_string(last) +
                           "), or 0 or 1 where a counter of 8, 16 or 32 bits wraps");
    }
    last = now;
  }
}

}  // namespace

void check_growth(std::vector<FieldMeta>& rows, const std::string& name, Messages& messages) {
  std::vector<FieldMeta*> counted;
  for (FieldMeta& row : rows) {
    if (row.status != FieldStatus::kMissing) {
      counted.push_back(&row);
    }
  }
  check_numbers(counted, {name, "sequence", messages});
  check_times(rows, {name, "time_s", messages});
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].status == FieldStatus::kMissing) {
      rows[i].sequence = rows[i - 1].sequence;
    }
  }
}

}  // namespace tubesight::drivers
