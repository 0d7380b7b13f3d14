#pragma once

#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "drivers/journal/journal_check.h"
#include "drivers/journal/sqlite_journal.h"
#include "hal/journal.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::support {

inline hal::JournalRow begin_row() {
  hal::JournalRow row;
  row.time.boot_id = "6f1d";
  row.time.monotonic = std::chrono::seconds(3);
  row.version = "1.0";
  row.origin = "box";
  return row;
}

/// A verification that differs from its neighbours.
inline hal::JournalRow verification(std::int32_t index) {
  hal::JournalRow row = begin_row();
  row.kind = hal::JournalKind::kVerification;
  row.event_id = index;
  row.claimed = core::TubeAddress{index % 97, index % 89};
  row.verdict = "confirmed";
  row.seen.tube = row.claimed;
  row.seen.offset_um = index % 1000;
  row.seen.field = 2 * index;
  row.count = 1 + index % 3;
  return row;
}

/// Appends rows of its own, one by one.
inline void append(hal::Journal& journal, std::int32_t rows, std::int32_t from = 0) {
  for (std::int32_t i = 0; i < rows; ++i) {
    const hal::JournalRow row = verification(from + i);
    ASSERT_TRUE(journal.append(std::span(&row, 1)));
  }
}

/// What somebody with SQLite's own shell may do to a file.
inline void tamper(const std::string& path, const std::string& statements) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const std::string all =
      "DROP TRIGGER IF EXISTS journal_update; DROP TRIGGER IF EXISTS journal_delete;"
      "DROP TRIGGER IF EXISTS checkpoint_update; DROP TRIGGER IF EXISTS checkpoint_delete;" +
      statements;
  EXPECT_EQ(sqlite3_exec(database, all.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

inline drivers::JournalCheck check(const std::string& path,
                                   const drivers::JournalCheckOptions& options = {}) {
  std::string message;
  const auto found = drivers::check_journal(path, options, message);
  EXPECT_TRUE(found) << message;
  return found ? *found : drivers::JournalCheck();
}

}  // namespace tubesight::support
