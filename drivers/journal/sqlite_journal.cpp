#include "drivers/journal/sqlite_journal.h"

#include <array>
#include <utility>

#include <unistd.h>

#include "drivers/journal/journal_columns.h"
#include "drivers/journal/journal_digest.h"
#include "drivers/journal/synced_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr int kColumns = static_cast<int>(kJournalColumns.size());
constexpr std::int64_t kApplicationId = 0x54534a31;  ///< "TSJ1", in the file's head
constexpr std::int64_t kFormat = 1;
constexpr int kMostDamaged = 1000;  ///< files moved aside; further ones are an error

/// "CREATE TABLE journal(...)" from the list of columns, so that the two cannot differ.
std::string journal_table() {
  std::string text = "CREATE TABLE journal(";
  for (const JournalColumn& column : kJournalColumns) {
    text += std::string(column.name) + (column.is_text ? " TEXT, " : " INTEGER, ");
  }
  return text + "chain TEXT NOT NULL, PRIMARY KEY(n)) STRICT;";
}

constexpr const char* kOtherTables =
    "CREATE TABLE picture(digest TEXT PRIMARY KEY, n INTEGER NOT NULL, jpeg BLOB NOT NULL) STRICT;"
    "CREATE INDEX picture_of ON picture(n);"
    "CREATE TABLE checkpoint(n INTEGER PRIMARY KEY, chain TEXT NOT NULL, key TEXT NOT NULL,"
    " signature TEXT NOT NULL) STRICT;"
    "CREATE TRIGGER journal_update BEFORE UPDATE ON journal BEGIN"
    " SELECT RAISE(ABORT, 'the journal is append-only'); END;"
    "CREATE TRIGGER journal_delete BEFORE DELETE ON journal BEGIN"
    " SELECT RAISE(ABORT, 'the journal is append-only'); END;"
    "CREATE TRIGGER checkpoint_update BEFORE UPDATE ON checkpoint BEGIN"
    " SELECT RAISE(ABORT, 'the journal is append-only'); END;"
    "CREATE TRIGGER checkpoint_delete BEFORE DELETE ON checkpoint BEGIN"
    " SELECT RAISE(ABORT, 'the journal is append-only'); END;";

std::string insert_text() {
  std::string text = "INSERT INTO journal VALUES(?";
  for (int i = 0; i < kColumns; ++i) {
    text += ",?";
  }
  return text + ")";
}

}  // namespace

Result<void> SqliteJournal::open(const hal::JournalRow& begin) {
  close_file();
  news_.clear();
  last_safe_ = 0;
  if (!settings_.key.empty() && !key_.is_loaded() && !key_.load_or_make(settings_.key, message_)) {
    return Unexpected(Error::kIo);
  }
  std::string follows;
  auto opened = open_file();
  if (!opened && opened.error() == Error::kDataLoss) {
    const std::string why = message_;
    const auto aside = move_aside();
    if (!aside) {
      return Unexpected(Error::kIo);
    }
    follows =
        " follows=" + *aside +
        (last_safe_ > 0 ? " follows_n=" + std::to_string(last_safe_) + " follows_chain=" + chain_
                        : std::string());
    news_ =
        "the journal was damaged (" + why + "); it is kept as " + *aside + ", and a new one begun";
    opened = open_file();
  }
  if (opened && last_safe_ == 0) {
    opened = begin_journal(begin, follows);
  }
  if (opened) {
    return {};
  }
  close_file();
  return Unexpected(Error::kIo);
}

Result<void> SqliteJournal::open_file() {
  if (const auto opened =
          database_.open(settings_.path, SqliteDatabase::Mode::kWrite, settings_.vfs);
      !opened) {
    message_ = database_.message();
    return opened;
  }
  // What stands behind "safe": the log is synced before a commit returns.
  if (const auto set = database_.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL"); !set) {
    message_ = database_.message();
    return set;
  }
  if (const auto made = make_tables(); !made) {
    return made;
  }
  if (const auto end = read_end(); !end) {
    return end;
  }
  return prepare();
}

Result<void> SqliteJournal::make_tables() {
  SqliteStatement tables;
  auto found = tables.prepare(database_, "SELECT count(*) FROM sqlite_schema");
  const auto counted = found ? tables.step() : Result<bool>(Unexpected(found.error()));
  if (!counted) {
    message_ = database_.message();
    return Unexpected(counted.error());
  }
  const bool is_new = tables.integer(0) == 0;
  tables.finish();
  if (is_new) {
    // Of one piece: a power cut leaves a file with all tables or none.
    const std::string make = "BEGIN IMMEDIATE;" + journal_table() + kOtherTables +
                             "PRAGMA application_id=" + std::to_string(kApplicationId) +
                             ";PRAGMA user_version=" + std::to_string(kFormat) + ";COMMIT";
    if (const auto made = database_.run(make.c_str()); !made) {
      message_ = database_.message();
      return made;
    }
    return sync_folder_of(settings_.path, message_) ? Result<void>() : Unexpected(Error::kIo);
  }
  SqliteStatement format;
  found = format.prepare(database_,
                         "SELECT application_id, user_version FROM "
                         "pragma_application_id, pragma_user_version");
  const auto read = found ? format.step() : Result<bool>(Unexpected(found.error()));
  if (!read) {
    message_ = database_.message();
    return Unexpected(read.error());
  }
  if (format.integer(0) != kApplicationId || format.integer(1) != kFormat) {
    message_ = settings_.path + ": is no journal of format 1";
    return Unexpected(Error::kDataLoss);
  }
  return {};
}

Result<void> SqliteJournal::read_end() {
  last_safe_ = 0;
  signed_ = 0;
  chain_ = chain_before_first();
  SqliteStatement rows;
  auto ready = rows.prepare(database_, "SELECT * FROM journal ORDER BY n DESC LIMIT 2");
  Result<bool> row = ready ? rows.step() : Result<bool>(Unexpected(ready.error()));
  JournalCells last;
  bool sound = true;
  if (row && *row) {
    for (int i = 0; i < kColumns; ++i) {
      last[static_cast<std::size_t>(i)] = rows.cell(i);
    }
    last_safe_ = rows.integer(0);
    chain_ = rows.text(kColumns);
    row = rows.step();
    const std::string before = row && *row ? rows.text(kColumns) : chain_before_first();
    const std::int64_t number_before = row && *row ? rows.integer(0) : 0;
    sound = last_safe_ == number_before + 1 && chain_ == chain_of(before, last);
  }
  rows.finish();
  SqliteStatement checkpoints;
  ready = row ? checkpoints.prepare(database_, "SELECT coalesce(max(n), 0) FROM checkpoint")
              : Result<void>(Unexpected(row.error()));
  const auto read = ready ? checkpoints.step() : Result<bool>(Unexpected(ready.error()));
  if (!read) {
    message_ = database_.message();
    return Unexpected(read.error());
  }
  signed_ = checkpoints.integer(0);
  if (!sound || signed_ > last_safe_) {
    message_ =
        settings_.path + ": the chain of its last row " + std::to_string(last_safe_) + " is broken";
    return Unexpected(Error::kDataLoss);
  }
  return {};
}

Result<void> SqliteJournal::begin_journal(const hal::JournalRow& begin,
                                          const std::string& follows) {
  const std::string detail =
      "format=1" + (key_.is_loaded() ? " key=" + key_.public_hex() : std::string()) + follows;
  hal::JournalRow first = begin;
  first.kind = hal::JournalKind::kBegin;
  first.detail = detail;
  const auto appended = append(std::span(&first, 1));
  if (!appended) {
    return Unexpected(appended.error());
  }
  return sign();
}

Result<std::string> SqliteJournal::move_aside() {
  close_file();
  for (int i = 1; i <= kMostDamaged; ++i) {
    const std::string aside = settings_.path + ".damaged-" + std::to_string(i);
    if (::access(aside.c_str(), F_OK) == 0) {
      continue;
    }
    // The log first: beside a new journal it would be taken for that one's.
    const std::string log = settings_.path + "-wal";
    if (::access(log.c_str(), F_OK) == 0 && !move_synced(log, aside + "-wal", message_)) {
      return Unexpected(Error::kIo);
    }
    ::unlink((settings_.path + "-shm").c_str());
    ::unlink((settings_.path + "-journal").c_str());
    if (!move_synced(settings_.path, aside, message_)) {
      return Unexpected(Error::kIo);
    }
    return aside.substr(aside.rfind('/') + 1);
  }
  message_ = settings_.path + ": is damaged, and a thousand before it were";
  return Unexpected(Error::kIo);
}

Result<void> SqliteJournal::prepare() {
  const bool ready =
      insert_.prepare(database_, insert_text().c_str()) &&
      insert_picture_.prepare(database_, "INSERT OR IGNORE INTO picture VALUES(?,?,?)") &&
      drop_pictures_.prepare(database_,
                             "DELETE FROM picture WHERE digest IN (SELECT digest FROM picture"
                             " ORDER BY n DESC LIMIT 100 OFFSET ?)") &&
      insert_checkpoint_.prepare(database_, "INSERT INTO checkpoint VALUES(?,?,?,?)");
  if (!ready) {
    message_ = database_.message();
    return Unexpected(Error::kDataLoss);  // the tables are others than ours
  }
  return {};
}

Result<std::int64_t> SqliteJournal::append(std::span<const hal::JournalRow> rows) {
  if (!database_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (rows.empty()) {
    return Unexpected(Error::kInvalidArgument);
  }
  std::string chain = chain_;
  std::int64_t number = last_safe_;
  auto done = database_.run("BEGIN IMMEDIATE");
  for (std::size_t i = 0; done && i < rows.size(); ++i) {
    done = insert(rows[i], ++number, chain);
  }
  const bool signs = key_.is_loaded() && number - signed_ >= kSignEvery;
  if (done && signs) {
    done = write_checkpoint(number, chain);
  }
  if (done) {
    done = database_.run("COMMIT");
  }
  if (!done) {
    return Unexpected(give_up(done.error()).error());
  }
  last_safe_ = number;
  chain_ = chain;
  signed_ = signs ? number : signed_;
  return number;
}

Result<void> SqliteJournal::insert(const hal::JournalRow& row, std::int64_t number,
                                   std::string& chain) {
  const std::string digest = row.picture.empty() ? std::string() : sha256_hex(row.picture);
  const JournalCells cells = cells_of(row, number, digest);
  chain = chain_of(chain, cells);
  for (int i = 0; i < kColumns; ++i) {
    insert_.bind(i + 1, cells[static_cast<std::size_t>(i)]);
  }
  const JournalCell linked(chain);
  insert_.bind(kColumns + 1, linked);
  const auto inserted = insert_.run();
  return inserted && !digest.empty() ? keep_picture(number, digest, row.picture) : inserted;
}

Result<void> SqliteJournal::keep_picture(std::int64_t number, const std::string& digest,
                                         std::span<const std::byte> jpeg) {
  const JournalCell name(digest);
  insert_picture_.bind(1, name);
  insert_picture_.bind(2, JournalCell(number));
  insert_picture_.bind(3, jpeg);
  if (const auto kept = insert_picture_.run(); !kept) {
    return kept;
  }
  drop_pictures_.bind(1, JournalCell(std::int64_t{settings_.pictures}));
  return drop_pictures_.run();
}

Result<void> SqliteJournal::write_checkpoint(std::int64_t number, const std::string& chain) {
  const JournalCell linked(chain);
  const JournalCell key(key_.public_hex());
  const JournalCell signature(key_.sign(checkpoint_text(number, chain)));
  insert_checkpoint_.bind(1, JournalCell(number));
  insert_checkpoint_.bind(2, linked);
  insert_checkpoint_.bind(3, key);
  insert_checkpoint_.bind(4, signature);
  return insert_checkpoint_.run();
}

Result<void> SqliteJournal::sign() {
  if (!database_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (!key_.is_loaded() || signed_ == last_safe_) {
    return {};
  }
  const auto written = write_checkpoint(last_safe_, chain_);
  if (!written) {
    return give_up(written.error());
  }
  signed_ = last_safe_;
  return {};
}

Result<void> SqliteJournal::give_up(Error error) {
  message_ = database_.message();
  close_file();
  return Unexpected(error == Error::kDataLoss ? Error::kIo : error);
}

std::string SqliteJournal::last_detail(hal::JournalKind kind) {
  constexpr std::int64_t kBack = 100'000;
  SqliteStatement rows;
  if (!database_.is_open() ||
      !rows.prepare(database_,
                    "SELECT coalesce(detail, '') FROM journal WHERE n > ? AND kind = ?"
                    " ORDER BY n DESC LIMIT 1")) {
    return {};
  }
  rows.bind(1, JournalCell(last_safe_ - kBack));
  const JournalCell name{std::string(hal::name_of(kind))};
  rows.bind(2, name);
  const auto row = rows.step();
  return row && *row ? rows.text(0) : std::string();
}

void SqliteJournal::close() {
  if (database_.is_open()) {
    // Where the disk refuses, the rows are there all the same, and the next checkpoint covers them.
    static_cast<void>(sign());
  }
  close_file();
}

void SqliteJournal::close_file() {
  insert_.finish();
  insert_picture_.finish();
  drop_pictures_.finish();
  insert_checkpoint_.finish();
  database_.close();
}

}  // namespace tubesight::drivers
