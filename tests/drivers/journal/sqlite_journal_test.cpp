#include "drivers/journal/sqlite_journal.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/drivers/journal/journal_bench.h"
#include "tests/drivers/journal/recording_vfs.h"

namespace tubesight {
namespace {

using core::Error;
using support::begin_row;
using support::check;

class SqliteJournalTest : public testing::Test {
 protected:
  [[nodiscard]] drivers::SqliteJournalSettings settings() const {
    return {path(), folder_.path("key"), 3, vfs_.name()};
  }
  [[nodiscard]] std::string path() const { return folder_.path("J.db"); }
  [[nodiscard]] bool has(const std::string& name) const {
    const auto names = folder_.names();
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// The first column of a query's first row.
  [[nodiscard]] std::string value(const char* query) const {
    drivers::SqliteDatabase database;
    drivers::SqliteStatement statement;
    EXPECT_TRUE(database.open(path(), drivers::SqliteDatabase::Mode::kRead));
    EXPECT_TRUE(statement.prepare(database, query)) << database.message();
    const auto row = statement.step();
    EXPECT_TRUE(row && *row) << query;
    return statement.text(0);
  }

  support::TemporaryFolder folder_;
  support::RecordingVfs vfs_;
};

TEST_F(SqliteJournalTest, BeginsWithARowThatNamesTheKey) {
  drivers::SqliteJournal journal(settings());

  ASSERT_TRUE(journal.open(begin_row())) << journal.message();

  EXPECT_EQ(journal.last_safe(), 1);
  EXPECT_EQ(journal.news(), "");
  EXPECT_TRUE(value("SELECT detail FROM journal").starts_with("format=1 key="));
  EXPECT_EQ(value("SELECT kind FROM journal"), "begin");
  EXPECT_EQ(value("SELECT count(*) FROM checkpoint"), "1");
}

TEST_F(SqliteJournalTest, GoesOnWhereItWasClosed) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 5);
  journal.close();

  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 5);

  EXPECT_EQ(journal.last_safe(), 11);
  EXPECT_EQ(check(path()).rows, 11);
  EXPECT_EQ(check(path()).wrong, 0);
}

TEST_F(SqliteJournalTest, AppendsRowsTogetherOrNotAtAll) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  const std::array rows = {support::verification(1), support::verification(2)};

  const auto last = journal.append(rows);

  ASSERT_TRUE(last);
  EXPECT_EQ(*last, 3);
  EXPECT_EQ(journal.last_safe(), 3);
}

TEST_F(SqliteJournalTest, RefusesToAppendNothingOrWhenClosed) {
  drivers::SqliteJournal journal(settings());
  const hal::JournalRow row = begin_row();
  EXPECT_EQ(journal.append(std::span(&row, 1)).error(), Error::kNotReady);
  EXPECT_EQ(journal.sign().error(), Error::kNotReady);
  ASSERT_TRUE(journal.open(begin_row()));

  EXPECT_EQ(journal.append({}).error(), Error::kInvalidArgument);
}

TEST_F(SqliteJournalTest, RefusesChangesByItself) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 2);
  drivers::SqliteDatabase other;
  ASSERT_TRUE(other.open(path(), drivers::SqliteDatabase::Mode::kWrite));

  for (const char* const change : {"UPDATE journal SET verdict='confirmed'", "DELETE FROM journal",
                                   "UPDATE checkpoint SET n=7", "DELETE FROM checkpoint"}) {
    EXPECT_FALSE(other.run(change)) << change;
    EXPECT_NE(other.message().find("append-only"), std::string::npos) << other.message();
  }
  EXPECT_EQ(check(path()).wrong, 0);
}

TEST_F(SqliteJournalTest, SignsEveryHundredRowsAndAtTheEnd) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 249);
  EXPECT_EQ(check(path()).signed_through, 201);

  ASSERT_TRUE(journal.sign());
  ASSERT_TRUE(journal.sign()) << "again, with nothing to sign";

  EXPECT_EQ(check(path()).signed_through, 250);
  EXPECT_EQ(check(path()).checkpoints, 4);
}

TEST_F(SqliteJournalTest, KeepsTheNewestPicturesAndAllDigests) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  for (int i = 0; i < 5; ++i) {
    const std::string jpeg = "jpeg " + std::to_string(i);
    hal::JournalRow row = support::verification(i);
    row.picture = std::as_bytes(std::span(jpeg));
    ASSERT_TRUE(journal.append(std::span(&row, 1))) << journal.message();
  }

  EXPECT_EQ(value("SELECT count(*) FROM picture"), "3");
  EXPECT_EQ(value("SELECT min(n) FROM picture"), "4");
  EXPECT_EQ(value("SELECT count(picture_digest) FROM journal"), "5");
  EXPECT_EQ(check(path()).wrong, 0);
  EXPECT_EQ(check(path()).pictures_dropped, 2);
}

TEST_F(SqliteJournalTest, StandsStillWhileTheDiskIsFullAndGoesOn) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row())) << journal.message();
  support::append(journal, 3);
  vfs_.set_full(true);
  const hal::JournalRow row = support::verification(9);

  const auto appended = journal.append(std::span(&row, 1));

  ASSERT_FALSE(appended);
  EXPECT_EQ(appended.error(), Error::kIo);
  EXPECT_FALSE(journal.is_open());
  EXPECT_NE(journal.message().find("full"), std::string::npos) << journal.message();
  vfs_.set_full(false);
  ASSERT_TRUE(journal.open(begin_row())) << journal.message();
  EXPECT_EQ(journal.news(), "");
  EXPECT_EQ(journal.last_safe(), 4);
  support::append(journal, 1);
  EXPECT_EQ(check(path()).rows, 5);
  EXPECT_EQ(check(path()).wrong, 0);
}

TEST_F(SqliteJournalTest, TellsNothingSafeThatCouldNotBeSynced) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  vfs_.set_syncs_fail(true);
  const hal::JournalRow row = support::verification(9);

  EXPECT_FALSE(journal.append(std::span(&row, 1)));

  vfs_.set_syncs_fail(false);
  ASSERT_TRUE(journal.open(begin_row())) << journal.message();
  support::append(journal, 2);
  EXPECT_EQ(check(path()).wrong, 0);
}

TEST_F(SqliteJournalTest, MovesADamagedFileAsideAndNamesIt) {
  folder_.write("J.db", std::string(5000, 'x'));
  drivers::SqliteJournal journal(settings());

  ASSERT_TRUE(journal.open(begin_row())) << journal.message();

  EXPECT_TRUE(has("J.db.damaged-1"));
  EXPECT_NE(journal.news().find("J.db.damaged-1"), std::string::npos) << journal.news();
  EXPECT_NE(value("SELECT detail FROM journal").find(" follows=J.db.damaged-1"), std::string::npos);
  EXPECT_EQ(folder_.read("J.db.damaged-1"), std::string(5000, 'x'));
  EXPECT_EQ(check(path()).wrong, 0);
}

TEST_F(SqliteJournalTest, MovesAJournalWithABrokenEndAsideAndNamesItsLastRow) {
  drivers::SqliteJournal journal(settings());
  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 5);
  const std::string chain = journal.chain();
  journal.close();
  support::tamper(path(), "UPDATE journal SET verdict = 'unknown' WHERE n = 6");

  ASSERT_TRUE(journal.open(begin_row())) << journal.message();

  EXPECT_NE(value("SELECT detail FROM journal")
                .find(" follows=J.db.damaged-1 follows_n=6 follows_chain=" + chain),
            std::string::npos);
  EXPECT_EQ(journal.last_safe(), 1);
}

TEST_F(SqliteJournalTest, IsNotMovedAsideWhereItsFolderIsGone) {
  drivers::SqliteJournal journal({folder_.path("absent/J.db"), {}, 3, {}});

  const auto opened = journal.open(begin_row());

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), Error::kIo);
  EXPECT_FALSE(journal.message().empty());
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(SqliteJournalTest, LeavesAnUnsignedJournalWithoutAKey) {
  drivers::SqliteJournal journal({path(), {}, 3, vfs_.name()});
  ASSERT_TRUE(journal.open(begin_row()));
  support::append(journal, 200);
  journal.close();

  EXPECT_EQ(check(path()).checkpoints, 0);
  EXPECT_EQ(check(path()).signed_through, 0);
  EXPECT_EQ(check(path()).wrong, 0);
}

}  // namespace
}  // namespace tubesight
