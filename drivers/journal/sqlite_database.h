#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/journal/journal_columns.h"

struct sqlite3;
struct sqlite3_stmt;

namespace tubesight::drivers {

/// A database file, open. One thread. Errors are told by message(), one line with the file's name.
class SqliteDatabase {
 public:
  enum class Mode : std::uint8_t {
    kWrite,  ///< made where it is not there
    kRead,   ///< on a disk that cannot be written to, too
  };

  SqliteDatabase() = default;
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;
  ~SqliteDatabase() { close(); }

  /// Opens; `vfs` is one that was registered with SQLite, empty: the usual one. Errors: kIo.
  [[nodiscard]] core::Result<void> open(const std::string& path, Mode mode,
                                        const std::string& vfs = {});
  void close();
  [[nodiscard]] bool is_open() const { return database_ != nullptr; }

  /// Runs statements without results. Errors: kDataLoss the file is damaged or of another kind, kIo
  /// everything else.
  [[nodiscard]] core::Result<void> run(const char* statements);

  /// Copies everything into a file that is not there yet, while others may write to this one; the
  /// copy needs no file beside it. Errors: as run().
  [[nodiscard]] core::Result<void> copy_to(const std::string& path);

  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  friend class SqliteStatement;
  [[nodiscard]] core::Result<void> fail();

  sqlite3* database_ = nullptr;
  std::string path_;
  std::string message_;
};

/// A statement with parameters, used again and again; it must not outlive its database.
class SqliteStatement {
 public:
  SqliteStatement() = default;
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;
  ~SqliteStatement() { finish(); }

  /// Errors: as SqliteDatabase::run().
  [[nodiscard]] core::Result<void> prepare(SqliteDatabase& database, const char* text);
  void finish();

  /// Parameters count from 1. What is bound stays valid until the statement was run.
  void bind(int parameter, const JournalCell& cell);
  void bind(int parameter, std::span<const std::byte> bytes);

  /// Goes to the next row of the result: false at its end, where the statement is ready for being
  /// run anew. Errors: as SqliteDatabase::run().
  [[nodiscard]] core::Result<bool> step();

  /// Runs it where no result is expected. Errors: as step().
  [[nodiscard]] core::Result<void> run();

  /// Of the row reached, columns counted from 0. A number with a fraction or bytes, which no row of
  /// ours has, are given as the text "?".
  [[nodiscard]] JournalCell cell(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::vector<std::byte> bytes(int column) const;

 private:
  SqliteDatabase* database_ = nullptr;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace tubesight::drivers
