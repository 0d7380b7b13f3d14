// Both ends of each tube, from two journals and a table of jobs. The accidents are those of the
// trade: one end right and the other one wrong (found years later), two tubes plugged in one leg
// alone by a wrong count, the tube beside the one that was meant.

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/journal/sqlite_journal.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using core::TubeAddress;
using std::chrono::seconds;

class Reconcile : public testing::Test {
 protected:
  /// A claim in the journal of a leg, so many seconds after 2026-12-01 00:00 UTC.
  struct Claimed {
    int second;
    TubeAddress claimed;
    const char* verdict;
    TubeAddress tube;
  };

  void write(const std::string& leg, const std::vector<Claimed>& claims, bool with_key = true) {
    drivers::SqliteJournal journal(
        {folder_.path(leg + ".db"), with_key ? folder_.path(leg + ".key") : "", 10, {}});
    ASSERT_TRUE(journal.open(row_at(0))) << journal.message();
    for (const Claimed& claim : claims) {
      hal::JournalRow row = row_at(claim.second);
      row.kind = hal::JournalKind::kVerification;
      row.origin = "robot";
      row.claimed = claim.claimed;
      row.verdict = claim.verdict;
      row.seen.tube = claim.tube;
      row.first = row.time.monotonic;
      row.last = row.time.monotonic;
      ASSERT_TRUE(journal.append(std::span(&row, 1)));
    }
  }
  void jobs(const std::string& rows) {
    folder_.write("jobs.csv", "job,leg,row,column,time_utc\n" + rows);
  }
  [[nodiscard]] ProgramRun run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"journal", "reconcile", "hot.db",
                                          "cold.db", "--jobs",    "jobs.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tubesight(folder_, arguments);
  }

  support::TemporaryFolder folder_;

 private:
  static hal::JournalRow row_at(int second) {
    constexpr seconds kMidnight{1'796'083'200};  // 2026-12-01
    hal::JournalRow row;
    row.time.boot_id = "b";
    row.time.monotonic = seconds(second);
    row.time.wall = kMidnight + seconds(second);
    row.time.wall_doubt = std::chrono::milliseconds(20);
    row.version = "1.0";
    return row;
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Reconcile, ClosesAJobAtBothEndsOfTheSameTube) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}});
  write("cold", {{3600, {40, 60}, "confirmed", {40, 60}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,60,2026-12-01T01:00:03Z\n");

  const ProgramRun closed = run({"--csv", "out.csv"});

  EXPECT_EQ(closed.status, 0) << closed.out << closed.err;
  EXPECT_TRUE(has(folder_.read("out.csv"), "plug,40,60,closed,vouched,"))
      << folder_.read("out.csv");
}

TEST_F(Reconcile, NamesTheTubeWhoseColdEndAndTheOtherWhoseHotEndWasPlugged) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}});
  write("cold", {{3600, {41, 60}, "confirmed", {41, 60}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,41,60,2026-12-01T01:00:03Z\n");

  const ProgramRun found = run({"--csv", "out.csv"});

  EXPECT_EQ(found.status, 1);
  const std::string rows = folder_.read("out.csv");
  EXPECT_TRUE(has(rows, "plug,40,60,one-end,vouched,")) << rows;
  EXPECT_TRUE(has(rows, "plug,41,60,one-end,")) << rows;
  EXPECT_TRUE(has(rows, ",41,60\n")) << "the other half is not named: " << rows;
}

TEST_F(Reconcile, NamesTheEndThatWasDoneAtAnotherTubeThanItWasWrittenDown) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}});
  write("cold", {{3600, {41, 60}, "confirmed", {41, 60}}});
  // The robot was sent to the wrong one and said so; the papers say the right one.
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,60,2026-12-01T01:00:03Z\n");

  const ProgramRun found = run({"--csv", "out.csv"});

  EXPECT_EQ(found.status, 1);
  EXPECT_TRUE(has(folder_.read("out.csv"), "plug,40,60,wrong-end,vouched,"))
      << folder_.read("out.csv");
  EXPECT_TRUE(has(folder_.read("out.csv"), ",41,60,")) << folder_.read("out.csv");
}

TEST_F(Reconcile, NamesTubesPluggedInOneLegAlone) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}, {120, {40, 61}, "confirmed", {40, 61}}});
  write("cold", {});
  jobs(
      "plug,hot,40,60,2026-12-01T00:01:01Z\nplug,hot,40,61,2026-12-01T00:02:01Z\n"
      "plug,cold,40,62,\nplug,cold,40,63,\n");

  const ProgramRun found = run({"--csv", "out.csv"});

  EXPECT_EQ(found.status, 1);
  const std::string rows = folder_.read("out.csv");
  EXPECT_TRUE(has(rows, "plug,40,60,one-end,")) << rows;
  EXPECT_TRUE(has(rows, "plug,40,61,one-end,")) << rows;
}

TEST_F(Reconcile, NamesTheTubeMispluggedBesideTheOneMeant) {
  write("hot", {{60, {40, 60}, "contradicted", {40, 61}}});
  write("cold", {{3600, {40, 60}, "confirmed", {40, 60}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,60,2026-12-01T01:00:03Z\n");

  const ProgramRun found = run({"--csv", "out.csv"});

  EXPECT_EQ(found.status, 1);
  EXPECT_TRUE(has(folder_.read("out.csv"), "plug,40,60,contradicted,")) << folder_.read("out.csv");
}

TEST_F(Reconcile, TakesMirroredColumns) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}});
  write("cold", {{3600, {40, 41}, "confirmed", {40, 41}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,41,2026-12-01T01:00:03Z\n");

  EXPECT_EQ(run().status, 1);
  EXPECT_EQ(run({"--mirrored", "101"}).status, 0);
}

TEST_F(Reconcile, AJournalThatIsNotSignedClosesNothingUnlessAskedTo) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}}, false);
  write("cold", {{3600, {40, 60}, "confirmed", {40, 60}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,60,2026-12-01T01:00:03Z\n");

  const ProgramRun open = run();
  EXPECT_EQ(open.status, 1);
  EXPECT_TRUE(has(open.out, "Nothing is signed")) << open.out;
  EXPECT_EQ(run({"--accept-unsigned"}).status, 0);
}

TEST_F(Reconcile, ABrokenJournalIsToldAndClosesNothing) {
  write("hot", {{60, {40, 60}, "confirmed", {40, 60}}});
  write("cold", {{3600, {40, 60}, "confirmed", {40, 60}}});
  jobs("plug,hot,40,60,2026-12-01T00:01:05Z\nplug,cold,40,60,2026-12-01T01:00:03Z\n");
  drivers::SqliteDatabase database;
  ASSERT_TRUE(database.open(folder_.path("cold.db"), drivers::SqliteDatabase::Mode::kWrite));
  ASSERT_TRUE(
      database.run("DROP TRIGGER journal_update; UPDATE journal SET tube_row=40 WHERE n=2"));
  ASSERT_TRUE(database.run("UPDATE journal SET offset_um=3 WHERE n=2"));
  database.close();

  const ProgramRun broken = run();

  EXPECT_EQ(broken.status, 1);
  EXPECT_TRUE(has(broken.out, "BROKEN: ")) << broken.out;
  EXPECT_TRUE(has(broken.err, "cold.db: row 2: ")) << broken.err;
}

TEST_F(Reconcile, RefusesWhatIsNoPairOfJournals) {
  write("hot", {});
  jobs("plug,hot,40,60,\n");
  EXPECT_EQ(run().status, 2) << "there is no cold.db";
  folder_.write("cold.db", "no journal");
  EXPECT_EQ(run().status, 2);
  const ProgramRun same =
      run_tubesight(folder_, {"journal", "reconcile", "hot.db", "hot.db", "--jobs", "jobs.csv"});
  EXPECT_EQ(same.status, 2);
  EXPECT_TRUE(has(same.err, "is the hot leg's journal")) << same.err;
  EXPECT_EQ(run_tubesight(folder_, {"journal", "copy", "hot.db", "copied.db"}).status, 0);
  const ProgramRun copy =
      run_tubesight(folder_, {"journal", "reconcile", "hot.db", "copied.db", "--jobs", "jobs.csv"});
  EXPECT_EQ(copy.status, 2);
  EXPECT_TRUE(has(copy.err, "one leg's is no proof of the other")) << copy.err;
  jobs("plug,warm,40,60,\n");
  write("cold2", {});
  EXPECT_TRUE(has(
      run_tubesight(folder_, {"journal", "reconcile", "hot.db", "cold2.db", "--jobs", "jobs.csv"})
          .err,
      "jobs.csv:2: leg: 'warm', expected hot or cold"));
}

}  // namespace
}  // namespace tubesight::tests
