#include "drivers/journal/journal_check.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "drivers/journal/journal_copy.h"
#include "drivers/journal/signing_key.h"
#include "tests/drivers/journal/journal_bench.h"
#include "tests/drivers/journal/recording_vfs.h"

namespace tubesight {
namespace {

using support::check;
using support::tamper;

/// A journal of 251 rows, signed at 1, 101, 201 and 251.
class JournalCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    drivers::SqliteJournal journal({path(), folder_.path("key"), 2000, vfs_.name()});
    ASSERT_TRUE(journal.open(support::begin_row())) << journal.message();
    support::append(journal, 248);
    hal::JournalRow pictured = support::verification(248);
    pictured.picture = std::as_bytes(std::span("a jpeg"));
    ASSERT_TRUE(journal.append(std::span(&pictured, 1)));
    support::append(journal, 1, 249);
    journal.close();
    std::string message;
    key_ = drivers::read_public_key(folder_.path("key.pub"), message).value_or("");
    ASSERT_EQ(key_.size(), 64u) << message;
  }

  [[nodiscard]] std::string path() const { return folder_.path("J.db"); }

  /// Expects exactly one problem, of that row, with these words.
  void expect_problem(std::int64_t number, const std::string& words,
                      const drivers::JournalCheckOptions& options = {}) const {
    const auto found = check(path(), options);
    ASSERT_EQ(found.wrong, 1) << (found.problems.empty() ? "" : found.problems.back().what);
    EXPECT_EQ(found.problems[0].number, number);
    EXPECT_NE(found.problems[0].what.find("row " + std::to_string(number) + ": "),
              std::string::npos);
    EXPECT_NE(found.problems[0].what.find(words), std::string::npos) << found.problems[0].what;
  }

  [[nodiscard]] int check_by_python() const {
    return std::system(
        ("python3 -B " TUBESIGHT_CHECK_CHAIN " " + path() + " 2> /dev/null").c_str());
  }

  support::TemporaryFolder folder_;
  support::RecordingVfs vfs_;  ///< syncs nothing, which takes most of the time
  std::string key_;
};

TEST_F(JournalCheckTest, FindsNothingInWhatNobodyTouched) {
  const auto found = check(path(), {key_, 251});

  EXPECT_EQ(found.wrong, 0);
  EXPECT_EQ(found.rows, 251);
  EXPECT_EQ(found.last, 251);
  EXPECT_EQ(found.checkpoints, 4);
  EXPECT_EQ(found.signed_through, 251);
  EXPECT_EQ(found.key, key_);
  EXPECT_EQ(found.pictures, 1);
  EXPECT_EQ(found.pictures_dropped, 0);
  EXPECT_EQ(check_by_python(), 0) << "the ten lines of docs/journal.md";
}

TEST_F(JournalCheckTest, TellsAChangedRowByItsNumber) {
  tamper(path(), "UPDATE journal SET verdict = 'contradicted' WHERE n = 42");

  expect_problem(42, "changed or moved");
  EXPECT_NE(check_by_python(), 0);
}

TEST_F(JournalCheckTest, TellsAValueThatWasMadeUnknown) {
  tamper(path(), "UPDATE journal SET offset_um = NULL WHERE n = 42");

  expect_problem(42, "changed or moved");
  EXPECT_NE(check_by_python(), 0);
}

TEST_F(JournalCheckTest, TellsMissingRows) {
  tamper(path(), "DELETE FROM journal WHERE n = 42");
  expect_problem(42, "is missing");
  EXPECT_NE(check_by_python(), 0);

  tamper(path(), "DELETE FROM journal WHERE n BETWEEN 43 AND 50");
  expect_problem(42, "is missing, and all up to row 50");
}

TEST_F(JournalCheckTest, TellsAMissingFirstRow) {
  tamper(path(), "DELETE FROM journal WHERE n = 1; DELETE FROM checkpoint WHERE n = 1");

  expect_problem(1, "is missing");
}

TEST_F(JournalCheckTest, TellsMissingRowsWhoseNumbersWereClosedUp) {
  tamper(path(),
         "DELETE FROM journal WHERE n = 150; DELETE FROM checkpoint WHERE n > 150;"
         "UPDATE journal SET n = n - 1 WHERE n > 150");

  const auto found = check(path());
  ASSERT_FALSE(found.problems.empty());
  EXPECT_EQ(found.problems[0].number, 150);
}

TEST_F(JournalCheckTest, TellsRowsThatChangedPlaces) {
  tamper(path(),
         "UPDATE journal SET n = -1 WHERE n = 42; UPDATE journal SET n = 42 WHERE n = 43;"
         "UPDATE journal SET n = 43 WHERE n = -1");

  const auto found = check(path());
  ASSERT_GE(found.problems.size(), 2u);
  EXPECT_EQ(found.problems[0].number, 42);
  EXPECT_EQ(found.problems[1].number, 43);
  EXPECT_NE(check_by_python(), 0);
}

TEST_F(JournalCheckTest, TellsACutOffEndByTheCheckpointBehindIt) {
  tamper(path(), "DELETE FROM journal WHERE n > 240");

  const auto found = check(path());
  ASSERT_FALSE(found.problems.empty());
  EXPECT_EQ(found.problems[0].number, 251);
  EXPECT_NE(found.problems[0].what.find("cut off"), std::string::npos);
}

TEST_F(JournalCheckTest, TellsACutOffEndByTheNumberThatTheBoxToldSafe) {
  tamper(path(),
         "DELETE FROM journal WHERE n > 240; DELETE FROM checkpoint WHERE n > 240;"
         "DELETE FROM picture");

  EXPECT_EQ(check(path()).wrong, 0) << "the file alone cannot show it";
  expect_problem(241, "cut off", {{}, 251});
}

TEST_F(JournalCheckTest, TellsAChainReckonedAnewByTheSignature) {
  // The last row and its link are replaced by those of another journal, which is right in itself.
  drivers::SqliteJournal other({folder_.path("other.db"), {}, 2000, vfs_.name()});
  ASSERT_TRUE(other.open(support::begin_row()));
  support::append(other, 250, 1000);
  other.close();

  tamper(path(), "ATTACH '" + folder_.path("other.db") +
                     "' AS o; DELETE FROM journal; DELETE FROM picture;"
                     "INSERT INTO journal SELECT * FROM o.journal");

  EXPECT_EQ(check_by_python(), 0) << "the chain alone cannot show it";
  const auto found = check(path());
  EXPECT_EQ(found.wrong, 4) << "each checkpoint";
  EXPECT_EQ(found.signed_through, 0);
}

TEST_F(JournalCheckTest, TellsAnothersKey) {
  const auto found = check(path(), {std::string(64, 'a'), 0});

  EXPECT_EQ(found.wrong, 4);
  EXPECT_EQ(found.signed_through, 0);
  ASSERT_FALSE(found.problems.empty());
  EXPECT_NE(found.problems[0].what.find("another key"), std::string::npos);
}

TEST_F(JournalCheckTest, TellsAChangedSignature) {
  tamper(path(), "UPDATE checkpoint SET signature = '00' || substr(signature, 3) WHERE n = 101");

  expect_problem(101, "signature of its checkpoint is wrong");
}

TEST_F(JournalCheckTest, TellsAChangedPicture) {
  tamper(path(), "UPDATE picture SET jpeg = x'00'");

  expect_problem(250, "picture was changed");
}

TEST_F(JournalCheckTest, TellsAPictureOfAnotherRow) {
  tamper(path(), "UPDATE picture SET n = 17");

  expect_problem(17, "not its own");
}

TEST_F(JournalCheckTest, TakesADroppedPictureForNoMistake) {
  tamper(path(), "DELETE FROM picture");

  const auto found = check(path());
  EXPECT_EQ(found.wrong, 0);
  EXPECT_EQ(found.pictures_dropped, 1);
}

TEST_F(JournalCheckTest, RefusesWhatIsNoJournal) {
  std::string message;
  EXPECT_FALSE(drivers::check_journal(folder_.write("text", "no database at all"), {}, message));
  EXPECT_FALSE(message.empty());
  EXPECT_FALSE(drivers::check_journal(folder_.path("absent"), {}, message));
}

TEST_F(JournalCheckTest, FindsACopyAsGoodAsTheJournal) {
  std::string message;
  ASSERT_TRUE(drivers::copy_journal(path(), folder_.path("copy.db"), message)) << message;

  EXPECT_EQ(check(folder_.path("copy.db"), {key_, 251}).wrong, 0);
  for (const std::string& name : folder_.names()) {
    EXPECT_FALSE(name.starts_with("copy.db.") || name.starts_with("copy.db-")) << name;
  }
  const auto again = drivers::copy_journal(path(), folder_.path("copy.db"), message);
  ASSERT_FALSE(again) << "nothing is written over";
  EXPECT_EQ(again.error(), core::Error::kInvalidArgument);
}

}  // namespace
}  // namespace tubesight
