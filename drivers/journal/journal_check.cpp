#include "drivers/journal/journal_check.h"

#include <algorithm>
#include <utility>

#include "drivers/journal/journal_columns.h"
#include "drivers/journal/journal_digest.h"
#include "drivers/journal/signing_key.h"
#include "drivers/journal/sqlite_database.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::size_t kMostProblems = 100;
constexpr int kColumns = static_cast<int>(kJournalColumns.size());

/// One check, statement by statement.
class Checker {
 public:
  Checker(SqliteDatabase& database, const JournalCheckOptions& options)
      : database_(&database), options_(&options) {}

  [[nodiscard]] Result<void> run() {
    if (const auto done = check_columns(); !done) {
      return done;
    }
    if (const auto done = check_chain(); !done) {
      return done;
    }
    if (const auto done = check_checkpoints(); !done) {
      return done;
    }
    return check_pictures();
  }

  JournalCheck& found() { return found_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  void complain(std::int64_t number, const std::string& what) {
    ++found_.wrong;
    if (found_.problems.size() < kMostProblems) {
      found_.problems.push_back({number, "row " + std::to_string(number) + ": " + what});
    }
  }

  Result<void> check_columns();
  Result<void> check_chain();
  void check_row(SqliteStatement& rows);
  void check_number(std::int64_t number);
  Result<void> check_checkpoints();
  void check_checkpoint(std::int64_t number, const std::string& signed_chain,
                        const std::string& row_chain, const std::string& key, bool good);
  Result<void> check_pictures();

  /// Calls `each` for every row of a query. Errors: those of the database.
  template <typename Each>
  Result<void> for_each(const char* query, Each each) {
    SqliteStatement rows;
    const auto ready = rows.prepare(*database_, query);
    Result<bool> more = ready ? rows.step() : Result<bool>(Unexpected(ready.error()));
    while (more && *more) {
      each(rows);
      more = rows.step();
    }
    if (!more) {
      message_ = database_->message();
      return Unexpected(more.error());
    }
    return {};
  }

  SqliteDatabase* database_;
  const JournalCheckOptions* options_;
  JournalCheck found_;
  std::string message_;
};

Result<void> Checker::check_columns() {
  std::size_t at = 0;
  bool ours = true;
  const auto read = for_each("SELECT name FROM pragma_table_info('journal')", [&](auto& row) {
    const std::string name = row.text(0);
    ours = ours && at <= kJournalColumns.size() &&
           name == (at < kJournalColumns.size() ? kJournalColumns[at].name : "chain");
    ++at;
  });
  if (!read) {
    return read;
  }
  if (!ours || at != kJournalColumns.size() + 1) {
    message_ = "is no journal of format 1: its table has other columns";
    return Unexpected(Error::kDataLoss);
  }
  return {};
}

void Checker::check_number(std::int64_t number) {
  const std::int64_t expected = found_.last + 1;
  if (number > expected) {
    complain(expected, number == expected + 1
                           ? std::string("is missing")
                           : "is missing, and all up to row " + std::to_string(number - 1));
  }
}

void Checker::check_row(SqliteStatement& rows) {
  JournalCells cells;
  for (int i = 0; i < kColumns; ++i) {
    cells[static_cast<std::size_t>(i)] = rows.cell(i);
  }
  const std::int64_t number = rows.integer(0);
  const std::string chain = rows.text(kColumns);
  check_number(number);
  // Behind a gap nothing can be said of this one: the row that it was chained to is not there.
  const bool follows = number == found_.last + 1;
  if (follows && chain_of(found_.chain, cells) != chain) {
    complain(number,
             "is not what was written, or does not follow the row before it: changed or "
             "moved");
  }
  ++found_.rows;
  found_.last = number;
  found_.chain = chain;  // what was written then: the next row is judged by itself
}

Result<void> Checker::check_chain() {
  found_.chain = chain_before_first();
  const auto read =
      for_each("SELECT * FROM journal ORDER BY n", [&](auto& row) { check_row(row); });
  if (read && found_.last < options_->at_least) {
    complain(found_.last + 1, "is missing, and all up to row " +
                                  std::to_string(options_->at_least) +
                                  ", which was told to be safe: cut off");
  }
  return read;
}

void Checker::check_checkpoint(std::int64_t number, const std::string& signed_chain,
                               const std::string& row_chain, const std::string& key, bool good) {
  if (!options_->key.empty() && key != options_->key) {
    complain(number, "its checkpoint is signed with another key");
  } else if (!good) {
    complain(number, "the signature of its checkpoint is wrong");
  } else if (row_chain.empty()) {
    complain(number,
             number > found_.last ? "is signed and not there: cut off" : "is signed and not there");
  } else if (signed_chain != row_chain) {
    complain(number, "is not the one that was signed: a row after row " +
                         std::to_string(found_.signed_through) +
                         " was changed and the chain reckoned anew");
  } else {
    found_.signed_through = number;
  }
}

Result<void> Checker::check_checkpoints() {
  return for_each(
      "SELECT c.n, c.chain, c.key, c.signature, coalesce(j.chain, '') FROM checkpoint c"
      " LEFT JOIN journal j ON j.n = c.n ORDER BY c.n",
      [&](SqliteStatement& row) {
        const std::int64_t number = row.integer(0);
        const std::string chain = row.text(1);
        const std::string key = row.text(2);
        ++found_.checkpoints;
        // A second key in one journal is somebody else's.
        if (!found_.key.empty() && key != found_.key && options_->key.empty()) {
          complain(number, "its checkpoint is signed with another key than those before");
        }
        found_.key = found_.key.empty() ? key : found_.key;
        check_checkpoint(number, chain, row.text(4), key,
                         is_signed_by(key, checkpoint_text(number, chain), row.text(3)));
      });
}

Result<void> Checker::check_pictures() {
  const auto kept = for_each(
      "SELECT p.n, p.digest, p.jpeg, coalesce(j.picture_digest, '') FROM"
      " picture p LEFT JOIN journal j ON j.n = p.n ORDER BY p.n",
      [&](SqliteStatement& row) {
        ++found_.pictures;
        const std::string digest = row.text(1);
        if (sha256_hex(row.bytes(2)) != digest) {
          complain(row.integer(0), "its picture was changed");
        } else if (row.text(3) != digest) {
          complain(row.integer(0), "a picture is there that is not its own");
        }
      });
  if (!kept) {
    return kept;
  }
  return for_each(
      "SELECT count(*) FROM journal j WHERE j.picture_digest IS NOT NULL AND NOT EXISTS"
      " (SELECT 1 FROM picture p WHERE p.digest = j.picture_digest)",
      [&](SqliteStatement& row) { found_.pictures_dropped = row.integer(0); });
}

}  // namespace

Result<JournalCheck> check_journal(const std::string& path, const JournalCheckOptions& options,
                                   std::string& message) {
  SqliteDatabase database;
  if (const auto opened = database.open(path, SqliteDatabase::Mode::kRead); !opened) {
    message = database.message();
    return Unexpected(opened.error());
  }
  // One instant of it, whoever appends meanwhile.
  if (const auto begun = database.run("BEGIN"); !begun) {
    message = database.message();
    return Unexpected(begun.error());
  }
  Checker checker(database, options);
  if (const auto done = checker.run(); !done) {
    message =
        checker.message().starts_with(path) ? checker.message() : path + ": " + checker.message();
    return Unexpected(done.error());
  }
  return std::move(checker.found());
}

}  // namespace tubesight::drivers
