#include "drivers/journal/sqlite_database.h"

#include <cstring>

#include <sqlite3.h>
#include <sys/stat.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Whoever copies or checks a journal holds it for moments.
constexpr int kWaitForOthers_ms = 2000;

/// A path in a URI: what means something there is written as its number.
std::string uri_of(const std::string& path, const char* what) {
  std::string text = "file:";
  for (const char letter : path) {
    if (letter == '%' || letter == '?' || letter == '#') {
      text += letter == '%' ? "%25" : letter == '?' ? "%3f" : "%23";
    } else {
      text += letter;
    }
  }
  return text + what;
}

bool is_empty_or_absent(const std::string& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) != 0 || found.st_size == 0;
}

}  // namespace

Result<void> SqliteDatabase::fail() {
  const int code = database_ != nullptr ? sqlite3_errcode(database_) : SQLITE_NOMEM;
  message_ = path_ + ": " +
             (database_ != nullptr ? sqlite3_errmsg(database_) : "no memory for a database");
  const int primary = code & 0xff;
  return Unexpected(primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB ? Error::kDataLoss
                                                                          : Error::kIo);
}

Result<void> SqliteDatabase::open(const std::string& path, Mode mode, const std::string& vfs) {
  close();
  path_ = path;
  const char* const by = vfs.empty() ? nullptr : vfs.c_str();
  const int flags =
      SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI |
      (mode == Mode::kWrite ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
  int code = sqlite3_open_v2(uri_of(path, "").c_str(), &database_, flags, by);
  if (code == SQLITE_OK && mode == Mode::kRead) {
    // A file with a log wants one beside it, which a disk that cannot be written to refuses: where
    // there is no log, the file alone is all there is.
    code = sqlite3_exec(database_, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr);
    if (code == SQLITE_CANTOPEN && is_empty_or_absent(path + "-wal")) {
      sqlite3_close(database_);
      code = sqlite3_open_v2(uri_of(path, "?immutable=1").c_str(), &database_, flags, by);
    } else {
      code = code == SQLITE_CANTOPEN ? code : SQLITE_OK;
    }
  }
  if (code != SQLITE_OK) {
    const Result<void> failed = fail();
    close();
    return failed;
  }
  sqlite3_busy_timeout(database_, kWaitForOthers_ms);
  return {};
}

void SqliteDatabase::close() {
  // Statements that are still there keep it alive until they end, and nothing else.
  sqlite3_close_v2(database_);
  database_ = nullptr;
}

Result<void> SqliteDatabase::run(const char* statements) {
  if (sqlite3_exec(database_, statements, nullptr, nullptr, nullptr) != SQLITE_OK) {
    return fail();
  }
  return {};
}

Result<void> SqliteDatabase::copy_to(const std::string& path) {
  SqliteDatabase copy;
  if (const auto opened = copy.open(path, Mode::kWrite); !opened) {
    message_ = copy.message();
    return opened;
  }
  // All pages in one step: one instant of the journal, whoever appends meanwhile.
  sqlite3_backup* const backup = sqlite3_backup_init(copy.database_, "main", database_, "main");
  if (backup != nullptr) {
    sqlite3_backup_step(backup, -1);
  }
  if (backup == nullptr || sqlite3_backup_finish(backup) != SQLITE_OK) {
    const auto failed = copy.fail();
    message_ = copy.message();
    return failed;
  }
  const auto alone = copy.run("PRAGMA synchronous=FULL; PRAGMA journal_mode=DELETE");
  message_ = alone ? "" : copy.message();
  return alone;
}

Result<void> SqliteStatement::prepare(SqliteDatabase& database, const char* text) {
  finish();
  database_ = &database;
  if (sqlite3_prepare_v2(database.database_, text, -1, &statement_, nullptr) != SQLITE_OK) {
    return database.fail();
  }
  return {};
}

void SqliteStatement::finish() {
  sqlite3_finalize(statement_);
  statement_ = nullptr;
}

// Without a destructor, SQLite reads what is bound where it is.
void SqliteStatement::bind(int parameter, const JournalCell& cell) {
  if (const auto* const number = std::get_if<std::int64_t>(&cell)) {
    sqlite3_bind_int64(statement_, parameter, *number);
  } else if (const auto* const text = std::get_if<std::string>(&cell)) {
    sqlite3_bind_text(statement_, parameter, text->data(), static_cast<int>(text->size()), nullptr);
  } else {
    sqlite3_bind_null(statement_, parameter);
  }
}

void SqliteStatement::bind(int parameter, std::span<const std::byte> bytes) {
  sqlite3_bind_blob64(statement_, parameter, bytes.data(), bytes.size(), nullptr);
}

Result<bool> SqliteStatement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) {
    return true;
  }
  const Result<void> failed = code == SQLITE_DONE ? Result<void>() : database_->fail();
  sqlite3_reset(statement_);
  return failed ? Result<bool>(false) : Result<bool>(Unexpected(failed.error()));
}

Result<void> SqliteStatement::run() {
  const auto stepped = step();
  return stepped ? Result<void>() : Result<void>(Unexpected(stepped.error()));
}

JournalCell SqliteStatement::cell(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_NULL: return {};
    case SQLITE_INTEGER: return integer(column);
    case SQLITE_TEXT: return text(column);
    default: return std::string("?");
  }
}

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string SqliteStatement::text(int column) const {
  const void* const text = sqlite3_column_text(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  return text == nullptr
             ? std::string()
             : std::string(static_cast<const char*>(text), static_cast<std::size_t>(size));
}

std::vector<std::byte> SqliteStatement::bytes(int column) const {
  const void* const blob = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  const auto* const first = static_cast<const std::byte*>(blob);
  return blob == nullptr ? std::vector<std::byte>() : std::vector(first, first + size);
}

}  // namespace tubesight::drivers
