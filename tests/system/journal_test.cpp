#include <array>
#include <string>

#include <gtest/gtest.h>

#include "drivers/journal/sqlite_journal.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

class JournalProgram : public testing::Test {
 protected:
  void SetUp() override {
    drivers::SqliteJournal journal({folder_.path("J.db"), folder_.path("key"), 10, {}});
    hal::JournalRow row;
    row.version = "1.0";
    ASSERT_TRUE(journal.open(row)) << journal.message();
    row.kind = hal::JournalKind::kVerification;
    row.claimed = core::TubeAddress{40, 61};
    row.verdict = "confirmed";
    const std::array rows = {row, row, row, row};
    ASSERT_TRUE(journal.append(rows));
  }

  [[nodiscard]] ProgramRun run(const std::vector<std::string>& arguments) const {
    return run_tubesight(folder_, arguments);
  }

  support::TemporaryFolder folder_;
};

TEST_F(JournalProgram, FindsNothingWrongWithASoundJournal) {
  const ProgramRun checked =
      run({"journal", "check", "J.db", "--key", "key.pub", "--at-least", "5"});

  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_TRUE(checked.out.starts_with("5 rows, the last one 5, chain ")) << checked.out;
  EXPECT_NE(checked.out.find("2 checkpoints, signed up to row 5\n"), std::string::npos);
  EXPECT_TRUE(checked.out.ends_with("\nnothing is wrong\n")) << checked.out;
  EXPECT_EQ(checked.err, "");
}

TEST_F(JournalProgram, TellsAChangedRowByItsNumber) {
  drivers::SqliteDatabase database;
  ASSERT_TRUE(database.open(folder_.path("J.db"), drivers::SqliteDatabase::Mode::kWrite));
  ASSERT_TRUE(
      database.run("DROP TRIGGER journal_update; UPDATE journal SET claim_row=41 WHERE n=3"));
  database.close();

  const ProgramRun checked = run({"journal", "check", "J.db"});

  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.err.starts_with("J.db: row 3: is not what was written")) << checked.err;
  EXPECT_TRUE(checked.out.ends_with("\n1 thing wrong\n")) << checked.out;
}

TEST_F(JournalProgram, TellsThatRowsWereCutOff) {
  const ProgramRun checked = run({"journal", "check", "J.db", "--at-least", "7"});

  EXPECT_EQ(checked.status, 1);
  EXPECT_NE(checked.err.find("row 6: is missing, and all up to row 7"), std::string::npos);
}

TEST_F(JournalProgram, ExportsToFilesAndToStandardOutput) {
  const ProgramRun both =
      run({"journal", "export", "J.db", "--csv", "F.csv", "--jsonl", "F.jsonl"});
  const ProgramRun out = run({"journal", "export", "J.db", "--jsonl", "-"});

  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_TRUE(folder_.read("F.csv").starts_with("n,kind,"));
  EXPECT_NE(folder_.read("F.csv").find("\n5,verification,"), std::string::npos);
  EXPECT_EQ(out.out, folder_.read("F.jsonl"));
  EXPECT_TRUE(out.out.starts_with("{\"n\":1,\"kind\":\"begin\","));
}

TEST_F(JournalProgram, CopiesAndChecksTheCopy) {
  EXPECT_EQ(run({"journal", "copy", "J.db", "C.db"}).status, 0);
  EXPECT_EQ(run({"journal", "check", "C.db", "--key", "key.pub", "--at-least", "5"}).status, 0);
  EXPECT_EQ(run({"journal", "copy", "J.db", "C.db"}).status, 2) << "it is there already";
}

TEST_F(JournalProgram, RefusesWhatItCannotDo) {
  EXPECT_EQ(run({"journal", "export", "J.db"}).status, 2);
  EXPECT_EQ(run({"journal", "export", "J.db", "--csv", "J.db"}).status, 2);
  EXPECT_EQ(run({"journal", "export", "J.db", "--csv", "/dev/full"}).status, 1);
  EXPECT_EQ(run({"journal", "check", "J.db", "C.db"}).status, 2);
  EXPECT_EQ(run({"journal", "copy", "J.db"}).status, 2);
  EXPECT_EQ(run({"journal", "burn", "J.db"}).status, 2);
  EXPECT_EQ(run({"journal", "check", "key.pub"}).status, 2);
  EXPECT_EQ(run({"journal", "check", "J.db", "--key", "J.db"}).status, 2);
}

}  // namespace
}  // namespace tubesight::tests
