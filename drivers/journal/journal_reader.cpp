#include "drivers/journal/journal_reader.h"

#include <algorithm>
#include <limits>
#include <string>

#include "drivers/journal/journal_columns.h"
#include "drivers/journal/journal_digest.h"

namespace tubesight::drivers {
namespace {

using core::Result;
using core::Unexpected;

constexpr std::int64_t kEndOfYear9999_us = 253'402'300'799'999'999;
constexpr std::int64_t kHundredYears_us = 100LL * 366 * 86'400 * 1'000'000;

std::string columns_text() {
  std::string text;
  for (const JournalColumn& column : kJournalColumns) {
    text += std::string(column.name) + ",";
  }
  return text + "chain";
}

/// Takes the cells of a row one after the other, in the order of kJournalColumns.
class Cells {
 public:
  explicit Cells(const SqliteStatement& row) : row_(&row) {}

  void take(std::string& text) {
    const JournalCell cell = row_->cell(next_++);
    const auto* const found = std::get_if<std::string>(&cell);
    text = found != nullptr ? *found : std::string();
  }

  void take(std::optional<std::int64_t>& number,
            std::int64_t least = std::numeric_limits<std::int64_t>::min(),
            std::int64_t most = std::numeric_limits<std::int64_t>::max()) {
    const JournalCell cell = row_->cell(next_++);
    const auto* const found = std::get_if<std::int64_t>(&cell);
    number = found != nullptr && *found >= least && *found <= most ? std::optional(*found)
                                                                   : std::nullopt;
  }

  void take_time(std::optional<std::int64_t>& number) { take(number, 0, kHundredYears_us); }

  void take(std::optional<core::TubeAddress>& tube) {
    std::optional<std::int64_t> row;
    std::optional<std::int64_t> column;
    constexpr std::int64_t kLeast = std::numeric_limits<std::int32_t>::min();
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    take(row, kLeast, kMost);
    take(column, kLeast, kMost);
    tube = row && column ? std::optional(core::TubeAddress{static_cast<std::int32_t>(*row),
                                                           static_cast<std::int32_t>(*column)})
                         : std::nullopt;
  }

 private:
  const SqliteStatement* row_;
  int next_ = 0;
};

JournalEntry entry_of(const SqliteStatement& row) {
  JournalEntry entry;
  Cells cells(row);
  std::optional<std::int64_t> number;
  std::optional<std::int64_t> not_told;
  cells.take(number);
  entry.number = number.value_or(0);
  cells.take(entry.kind);
  cells.take(entry.boot_id);
  cells.take_time(entry.monotonic_us);
  cells.take(entry.wall_us, 0, kEndOfYear9999_us);
  cells.take_time(entry.wall_doubt_us);
  cells.take(entry.version);
  cells.take(entry.origin);
  cells.take(entry.event_id);
  cells.take(entry.claimed);
  cells.take(entry.verdict);
  cells.take(entry.reason);
  cells.take(entry.tube);
  cells.take(entry.offset_um);
  cells.take(entry.height_um);
  cells.take(entry.margin_permyriad);
  cells.take(entry.residual_millipx);
  cells.take(entry.field);
  cells.take(not_told);  // field_us: on a clock that nothing else here is on
  cells.take(entry.field_digest);
  cells.take(entry.camera_id);
  cells.take(entry.tool_id);
  cells.take(entry.base_id);
  cells.take_time(entry.first_us);
  cells.take_time(entry.last_us);
  cells.take(number, 1);
  entry.count = number.value_or(1);
  cells.take(entry.picture_digest);
  cells.take(entry.detail);
  cells.take(entry.chain);
  return entry;
}

}  // namespace

std::string JournalEntry::detail_word(std::string_view key) const {
  std::string_view rest = detail;
  while (!rest.empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    if (word.size() > key.size() && word.starts_with(key) && word[key.size()] == '=') {
      return std::string(word.substr(key.size() + 1));
    }
  }
  return {};
}

Result<void> JournalReader::open(const std::string& path) {
  if (const auto opened = database_.open(path, SqliteDatabase::Mode::kRead); !opened) {
    return opened;
  }
  return database_.run("BEGIN");
}

Result<void> JournalReader::read(std::int64_t last,
                                 const std::function<void(const JournalEntry&)>& each) {
  SqliteStatement rows;
  const std::string query = "SELECT " + columns_text() + " FROM journal WHERE n <= ?1 ORDER BY n";
  if (const auto ready = rows.prepare(database_, query.c_str()); !ready) {
    return ready;
  }
  rows.bind(1, JournalCell(last));
  Result<bool> more = rows.step();
  while (more && *more) {
    each(entry_of(rows));
    more = rows.step();
  }
  return more ? Result<void>() : Result<void>(Unexpected(more.error()));
}

std::vector<std::byte> JournalReader::picture(const std::string& digest) {
  SqliteStatement rows;
  if (!rows.prepare(database_, "SELECT jpeg FROM picture WHERE digest = ?1 LIMIT 1")) {
    return {};
  }
  const JournalCell wanted(digest);  // bound where it is, until the statement was run
  rows.bind(1, wanted);
  const Result<bool> found = rows.step();
  std::vector<std::byte> jpeg = found && *found ? rows.bytes(0) : std::vector<std::byte>();
  return sha256_hex(jpeg) == digest ? jpeg : std::vector<std::byte>();
}

}  // namespace tubesight::drivers
