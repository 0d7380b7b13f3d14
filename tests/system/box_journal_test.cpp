// tubesightd keeps a journal: what its robot claimed, whatever ends the program.

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <regex>
#include <thread>

#include <gtest/gtest.h>

#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

constexpr const char* kTwoVisits = TUBESIGHT_TEST_DATA_DIR "/recordings/two_visits/";

/// A box that plays a recording with the robot's claims in it, over and over: (40, 60), (40, 61).
class KeepingBox {
 public:
  void start(const std::string& journal = "file = \"J.db\"\n") {
    const std::string folder = kTwoVisits;
    daemon_.folder().write(
        "box.toml", "format = 1\ninclude = [\"" + folder +
                        "session.toml\"]\n[source]\nkind = \"replay\"\nrecording = \"" + folder +
                        "recording.y4m.xz\"\nscript = true\n[control]\nsocket = \"box\"\n"
                        "[realtime]\npriority = 0\nlock_memory = false\n[journal]\n" +
                        journal);
    ASSERT_TRUE(daemon_.start_and_wait()) << daemon_.said();
  }
  [[nodiscard]] std::int64_t safe() const {
    const std::string status = daemon_.ask({"status", "--json"}).out;
    std::smatch found;
    return std::regex_search(status, found, std::regex(R"("safe":(\d+))")) ? std::stoll(found[1])
                                                                           : -1;
  }
  void start_again() { ASSERT_TRUE(daemon_.start_and_wait()) << daemon_.said(); }
  void add_to_settings(const std::string& line) const {
    daemon_.folder().write("box.toml", daemon_.folder().read("box.toml") + line);
  }
  /// Until it has a start and both claims, and a little longer.
  void wait_for_claims() const {
    const auto end = std::chrono::steady_clock::now() + kLong;
    while (safe() < 5) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << daemon_.said();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  void end(int signal, int status) {
    daemon_.signal(signal);
    EXPECT_EQ(daemon_.wait_for_end(kLong), status);
  }
  [[nodiscard]] Answered check(std::int64_t at_least) const {
    return run_program(TUBESIGHT_PROGRAM, {"journal", "check", journal(), "--key", key(),
                                           "--at-least", std::to_string(at_least)});
  }
  [[nodiscard]] std::string rows() const {
    const Answered exported =
        run_program(TUBESIGHT_PROGRAM,
                    {"journal", "export", journal(), "--jsonl", daemon_.folder().path("J.jsonl")});
    EXPECT_EQ(exported.status, 0) << exported.err;
    return daemon_.folder().read("J.jsonl");
  }
  /// A tenth of a second after it confirmed that claim first, as a table of jobs has it.
  [[nodiscard]] std::string soon_after_claim(const std::string& column) const {
    const std::string text = rows();
    std::smatch found;
    const std::regex row(R"("wall_us":(\d+)[^\n]*"claim_column":)" + column +
                         R"(,"verdict":"confirmed")");
    EXPECT_TRUE(std::regex_search(text, found, row)) << text;
    const std::int64_t wall_us = found.empty() ? 0 : std::stoll(found[1]) + 100'000;
    const std::time_t seconds = wall_us / 1'000'000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 40> written{};
    std::strftime(written.data(), written.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    const std::string fraction = std::to_string(1000 + wall_us / 1000 % 1000);
    return std::string(written.data()) + "." + fraction.substr(1) + "Z";
  }
  /// Of a box that was ended.
  [[nodiscard]] std::int64_t safe_rows() const {
    const std::string text = rows();
    return std::count(text.begin(), text.end(), '\n');
  }
  [[nodiscard]] std::string journal() const { return daemon_.folder().path("J.db"); }
  [[nodiscard]] std::string key() const { return daemon_.folder().path("J.db.key.pub"); }
  [[nodiscard]] const Daemon& daemon() const { return daemon_; }

 private:
  Daemon daemon_;
};

TEST(BoxJournal, HasAStartAClaimAndAnEnd) {
  KeepingBox box;
  box.start();
  box.wait_for_claims();
  box.end(SIGTERM, 0);

  const Answered checked = box.check(5);
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  EXPECT_TRUE(has(checked.out, "nothing is wrong"));
  const std::string text = box.rows();
  for (const char* const part :
       {R"("kind":"begin")", "what=started", R"("kind":"start")", R"("verdict":"confirmed")",
        R"("claim_column":61)", R"("field_digest":")", R"("picture_digest":")", "what=ended"}) {
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  }
}

TEST(BoxJournal, WhatWasToldSafeIsThereAfterAKill) {
  KeepingBox box;
  box.start();
  box.wait_for_claims();
  const std::int64_t told = box.safe();
  box.end(SIGKILL, -1);

  const Answered checked = box.check(told);
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST(BoxJournal, SettingsEditedWhileItRunsAreTheNextStarts) {
  KeepingBox box;
  box.start();
  box.wait_for_claims();
  box.add_to_settings("# edited\n");
  box.end(SIGTERM, 0);
  EXPECT_FALSE(has(box.rows(), "what=changed"));

  const std::int64_t before = box.safe_rows();
  box.start_again();
  box.end(SIGTERM, 0);

  EXPECT_GT(box.safe_rows(), before);
  EXPECT_TRUE(has(box.rows(), "what=changed settings=")) << box.rows();
}

TEST(BoxJournal, ADiskThatIsNotThereIsToldAndTheBoxTracksOn) {
  KeepingBox box;
  box.start("file = \"gone/J.db\"\n");
  const std::string status = box.daemon().wait_for("\"state\":\"tracking\"", kLong);
  EXPECT_TRUE(has(status, R"("state":"standing still")")) << status;
  EXPECT_TRUE(has(status, R"("safe":0)")) << status;
  EXPECT_TRUE(has(box.daemon().said(), "the journal stands still: ")) << box.daemon().said();
  const std::string found = box.daemon().ask({"self-test"}).out;
  EXPECT_TRUE(has(found, "journal")) << found;
}

// In 2005 a plant plugged one tube's cold end and another tube's hot end, found four years later.
TEST(BoxJournal, OfBothLegsClosesATubeAndNamesTheEndDoneAtAnother) {
  KeepingBox hot;
  hot.start();
  hot.wait_for_claims();
  hot.end(SIGTERM, 0);
  KeepingBox cold;
  cold.start();
  cold.wait_for_claims();
  cold.end(SIGTERM, 0);
  const support::TemporaryFolder papers;
  const auto reconcile = [&](const std::string& cold_time) {
    papers.write("jobs.csv", "job,leg,row,column,time_utc\nplug,hot,40,60," +
                                 hot.soon_after_claim("60") + "\nplug,cold,40,60," + cold_time +
                                 "\n");
    return run_program(TUBESIGHT_PROGRAM, {"journal", "reconcile", hot.journal(), cold.journal(),
                                           "--key", hot.key(), "--second-key", cold.key(), "--jobs",
                                           papers.path("jobs.csv"), "--clock-doubt", "0"});
  };

  const Answered right = reconcile(cold.soon_after_claim("60"));
  EXPECT_EQ(right.status, 0) << right.out << right.err;

  const Answered wrong = reconcile(cold.soon_after_claim("61"));
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(has(wrong.out, "wrong-end: plug of tube (40, 60)")) << wrong.out;
  EXPECT_TRUE(has(wrong.out, "UNDER (40, 61)")) << wrong.out;
}

}  // namespace
}  // namespace tubesight::tests
