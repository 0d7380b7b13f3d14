#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "drivers/journal/signing_key.h"
#include "drivers/journal/sqlite_database.h"
#include "hal/journal.h"

namespace tubesight::drivers {

/// How a journal is kept.
struct SqliteJournalSettings {
  std::string path;
  std::string
      key;  ///< the signing key's file, made where it is not there; empty: nothing is signed
  std::int32_t pictures = 2000;  ///< that are kept: the newest ones
  std::string vfs;               ///< of SQLite; not in the file, for tests
};

/// The journal as a SQLite file: docs/journal.md has its schema.
///
/// Every append() is a transaction of its own, in WAL mode with synchronous=FULL: it returns after
/// the log was synced. After an error the file is closed; open() reads what is on the disk anew.
class SqliteJournal final : public hal::Journal {
 public:
  /// Rows between two checkpoints that come by themselves.
  static constexpr std::int64_t kSignEvery = 100;

  explicit SqliteJournal(SqliteJournalSettings settings) : settings_(std::move(settings)) {}
  ~SqliteJournal() { close(); }

  /// Opens the journal, or begins one whose first row is `begin` with what it follows. A file that
  /// is damaged, or none of ours, is moved aside to PATH.damaged-N and a new journal begun, whose
  /// first row names it: news() says so.
  ///
  /// Errors: kIo the disk is full, read-only or not there, or the key is none: message() says why,
  /// and open() may be tried again.
  [[nodiscard]] core::Result<void> open(const hal::JournalRow& begin);

  /// Signs what is unsigned and closes; does nothing when not open.
  void close();

  [[nodiscard]] core::Result<std::int64_t> append(std::span<const hal::JournalRow> rows) override;
  [[nodiscard]] core::Result<void> sign() override;
  [[nodiscard]] std::int64_t last_safe() const override { return last_safe_; }

  /// The detail of the newest row of a kind among the last hundred thousand; empty: there is none.
  [[nodiscard]] std::string last_detail(hal::JournalKind kind);

  [[nodiscard]] bool is_open() const { return database_.is_open(); }

  /// The last failure, in one line.
  [[nodiscard]] const std::string& message() const { return message_; }

  /// What open() did that somebody should know, in one line; empty: nothing.
  [[nodiscard]] const std::string& news() const { return news_; }

  /// Of the row last_safe(), 64 hexadecimal digits.
  [[nodiscard]] const std::string& chain() const { return chain_; }

 private:
  [[nodiscard]] core::Result<void> open_file();
  [[nodiscard]] core::Result<void> make_tables();
  [[nodiscard]] core::Result<void> read_end();
  [[nodiscard]] core::Result<void> begin_journal(const hal::JournalRow& begin,
                                                 const std::string& follows);
  [[nodiscard]] core::Result<std::string> move_aside();
  [[nodiscard]] core::Result<void> prepare();
  [[nodiscard]] core::Result<void> insert(const hal::JournalRow& row, std::int64_t number,
                                          std::string& chain);
  [[nodiscard]] core::Result<void> keep_picture(std::int64_t number, const std::string& digest,
                                                std::span<const std::byte> jpeg);
  [[nodiscard]] core::Result<void> write_checkpoint(std::int64_t number, const std::string& chain);
  [[nodiscard]] core::Result<void> give_up(core::Error error);
  void close_file();

  SqliteJournalSettings settings_;
  SigningKey key_;
  SqliteDatabase database_;
  SqliteStatement insert_;
  SqliteStatement insert_picture_;
  SqliteStatement drop_pictures_;
  SqliteStatement insert_checkpoint_;
  std::int64_t last_safe_ = 0;
  std::int64_t signed_ = 0;  ///< the last row that a checkpoint covers
  std::string chain_;
  std::string message_;
  std::string news_;
};

}  // namespace tubesight::drivers
