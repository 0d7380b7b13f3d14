#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/journal/journal_bench.h"
#include "tests/drivers/journal/recording_vfs.h"

namespace tubesight {

/// What was told safe before a cut: row number and its chain.
inline std::map<std::int64_t, std::string> told_before(const std::vector<support::DiskEvent>& log,
                                                       std::size_t events) {
  std::map<std::int64_t, std::string> told;
  for (std::size_t i = 0; i < events; ++i) {
    if (log[i].kind == support::DiskEvent::Kind::kSafe) {
      told[log[i].at] = log[i].bytes;
    }
  }
  return told;
}

/// The chain of each row that a file has.
inline std::map<std::int64_t, std::string> chains_of(const std::string& path) {
  drivers::SqliteDatabase database;
  drivers::SqliteStatement rows;
  std::map<std::int64_t, std::string> chains;
  EXPECT_TRUE(database.open(path, drivers::SqliteDatabase::Mode::kRead));
  EXPECT_TRUE(rows.prepare(database, "SELECT n, chain FROM journal"));
  for (auto more = rows.step(); more && *more; more = rows.step()) {
    chains[rows.integer(0)] = rows.text(1);
  }
  return chains;
}

class JournalPowerCut : public testing::Test {
 protected:
  /// Writes a journal with `rows` rows and pictures, in two sessions, logging what reaches the
  /// disk.
  void write(support::RecordingVfs& vfs, std::int32_t rows) {
    const std::string jpeg(20000, 'j');
    for (int session = 0; session < 2; ++session) {
      drivers::SqliteJournal journal({folder_.path("J.db"), folder_.path("key"), 3, vfs.name()});
      ASSERT_TRUE(journal.open(support::begin_row())) << journal.message();
      vfs.tell_safe(journal.last_safe(), journal.chain());
      for (std::int32_t i = 0; i < rows / 2; ++i) {
        hal::JournalRow row = support::verification(i);
        const std::string picture = jpeg + std::to_string(session * rows + i);
        row.picture = i % 4 == 0 ? std::as_bytes(std::span(picture)) : std::span<std::byte>();
        ASSERT_TRUE(journal.append(std::span(&row, 1))) << journal.message();
        vfs.tell_safe(journal.last_safe(), journal.chain());
      }
    }
  }

  /// Whether everything told safe before the cut is there, in an unbroken chain, and the journal
  /// goes on behind it.
  [[nodiscard]] bool survives(const std::vector<support::DiskEvent>& log, std::size_t events,
                              bool loss, std::mt19937_64& random) {
    const support::TemporaryFolder after;
    const std::string path = after.path("J.db");
    for (const auto& [name, content] : support::files_after_cut(log, events, loss, random)) {
      after.write(std::filesystem::path(name).filename().string(), content);
    }
    const auto told = told_before(log, events);
    support::RecordingVfs vfs;  // syncs nothing, which takes most of the time
    drivers::SqliteJournal journal({path, folder_.path("key"), 3, vfs.name()});
    if (!journal.open(support::begin_row()) || (!told.empty() && !journal.news().empty())) {
      return false;
    }
    const hal::JournalRow next = support::verification(7);
    if (!journal.append(std::span(&next, 1))) {
      return false;
    }
    journal.close();
    const auto chains = chains_of(path);
    for (const auto& [number, chain] : told) {
      const auto row = chains.find(number);
      if (row == chains.end() || row->second != chain) {
        return false;
      }
    }
    return support::check(path).wrong == 0;
  }

  /// Cuts that lost something, of `cuts` spread over the whole log.
  [[nodiscard]] int count_losses(const std::vector<support::DiskEvent>& log, int cuts,
                                 std::uint64_t seed) {
    std::mt19937_64 random(seed);
    int losses = 0;
    for (int i = 0; i < cuts; ++i) {
      const std::size_t events = random() % (log.size() + 1);
      losses += survives(log, events, i % 2 == 1, random) ? 0 : 1;
    }
    return losses;
  }

  support::TemporaryFolder folder_;
};

}  // namespace tubesight
