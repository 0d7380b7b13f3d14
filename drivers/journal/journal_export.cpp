#include "drivers/journal/journal_export.h"

#include "drivers/journal/journal_columns.h"
#include "drivers/journal/sqlite_database.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr int kColumns = static_cast<int>(kJournalColumns.size()) + 1;  ///< with `chain`

std::string_view name_of_column(int column) {
  return column + 1 < kColumns ? kJournalColumns[static_cast<std::size_t>(column)].name : "chain";
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text) {
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  }
  return quoted + "\"";
}

/// Text without control characters, as the journal has it; a file of somebody else's may.
std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
    }
    const bool control = static_cast<unsigned char>(letter) < 0x20;
    quoted += control ? '?' : letter;
  }
  return quoted + "\"";
}

std::string csv_cell(const JournalCell& cell) {
  if (const auto* const number = std::get_if<std::int64_t>(&cell)) {
    return std::to_string(*number);
  }
  const auto* const text = std::get_if<std::string>(&cell);
  return text != nullptr ? csv_text(*text) : std::string();
}

std::string json_cell(const JournalCell& cell) {
  if (const auto* const number = std::get_if<std::int64_t>(&cell)) {
    return std::to_string(*number);
  }
  const auto* const text = std::get_if<std::string>(&cell);
  return text != nullptr ? json_text(*text) : std::string("null");
}

std::string header(JournalFormat format) {
  std::string text;
  for (int i = 0; format == JournalFormat::kCsv && i < kColumns; ++i) {
    text += std::string(name_of_column(i)) + (i + 1 < kColumns ? "," : "\n");
  }
  return text;
}

std::string line(const SqliteStatement& row, JournalFormat format) {
  const bool csv = format == JournalFormat::kCsv;
  std::string text = csv ? "" : "{";
  for (int i = 0; i < kColumns; ++i) {
    text += i > 0 ? "," : "";
    text += csv ? csv_cell(row.cell(i))
                : "\"" + std::string(name_of_column(i)) + "\":" + json_cell(row.cell(i));
  }
  return text + (csv ? "\n" : "}\n");
}

std::string query() {
  std::string text = "SELECT ";
  for (int i = 0; i < kColumns; ++i) {
    text += (i > 0 ? "," : "") + std::string(name_of_column(i));
  }
  return text + " FROM journal ORDER BY n";
}

}  // namespace

Result<std::int64_t> export_journal(const std::string& path, JournalFormat format,
                                    const JournalSink& sink, std::string& message) {
  SqliteDatabase database;
  SqliteStatement rows;
  auto ready = database.open(path, SqliteDatabase::Mode::kRead);
  if (ready) {
    ready = rows.prepare(database, query().c_str());
  }
  Result<bool> more = ready ? rows.step() : Result<bool>(Unexpected(ready.error()));
  if (more && !sink(header(format))) {
    return Unexpected(Error::kBufferTooSmall);
  }
  std::int64_t written = 0;
  while (more && *more) {
    if (!sink(line(rows, format))) {
      return Unexpected(Error::kBufferTooSmall);
    }
    ++written;
    more = rows.step();
  }
  if (!more) {
    message = database.message();
    return Unexpected(more.error());
  }
  return written;
}

}  // namespace tubesight::drivers
