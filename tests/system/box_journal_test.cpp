// tubesightd keeps a journal: what its robot claimed, whatever ends the program.

#include <chrono>
#include <csignal>
#include <regex>
#include <thread>

#include <gtest/gtest.h>

#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

constexpr const char* kTwoVisits = TUBESIGHT_TEST_DATA_DIR "/recordings/two_visits/";

class BoxJournal : public ::testing::Test {
 protected:
  /// A box that plays a recording with the robot's claims in it, over and over.
  void start(const std::string& journal = "file = \"J.db\"\n") {
    const std::string folder = kTwoVisits;
    box_.folder().write(
        "box.toml", "format = 1\ninclude = [\"" + folder +
                        "session.toml\"]\n[source]\nkind = \"replay\"\nrecording = \"" + folder +
                        "recording.y4m.xz\"\nscript = true\n[control]\nsocket = "
                        "\"box\"\n[realtime]\npriority = 0\nlock_memory = false\n"
                        "[journal]\n" +
                        journal);
    ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  }
  [[nodiscard]] std::int64_t safe() const {
    const std::string status = box_.ask({"status", "--json"}).out;
    std::smatch found;
    return std::regex_search(status, found, std::regex(R"("safe":(\d+))")) ? std::stoll(found[1])
                                                                           : -1;
  }
  /// Begin, boot, start, and two claims.
  void wait_until_safe(std::int64_t rows) const {
    const auto end = std::chrono::steady_clock::now() + kLong;
    while (safe() < rows) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << box_.said();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  [[nodiscard]] Answered check(std::int64_t at_least) const {
    return run_program(TUBESIGHT_PROGRAM, {"journal", "check", box_.folder().path("J.db"), "--key",
                                           box_.folder().path("J.db.key.pub"), "--at-least",
                                           std::to_string(at_least)});
  }
  [[nodiscard]] std::string rows() const {
    const Answered exported =
        run_program(TUBESIGHT_PROGRAM, {"journal", "export", box_.folder().path("J.db"), "--jsonl",
                                        box_.folder().path("J.jsonl")});
    EXPECT_EQ(exported.status, 0) << exported.err;
    return box_.folder().read("J.jsonl");
  }

  Daemon box_;
};

TEST_F(BoxJournal, HasAStartAClaimAndAnEnd) {
  start();
  wait_until_safe(5);
  box_.signal(SIGTERM);
  EXPECT_EQ(box_.wait_for_end(kLong), 0);

  const Answered checked = check(4);
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  EXPECT_TRUE(has(checked.out, "nothing is wrong"));
  const std::string text = rows();
  for (const char* const part :
       {R"("kind":"begin")", "what=started", R"("kind":"start")", R"("verdict":"confirmed")",
        R"("claim_column":61)", R"("field_digest":")", R"("picture_digest":")", "what=ended"}) {
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  }
}

TEST_F(BoxJournal, WhatWasToldSafeIsThereAfterAKill) {
  start();
  wait_until_safe(5);
  const std::int64_t told = safe();
  box_.signal(SIGKILL);
  EXPECT_EQ(box_.wait_for_end(kLong), -1);

  const Answered checked = check(told);
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST_F(BoxJournal, ADiskThatIsNotThereIsToldAndTheBoxTracksOn) {
  start("file = \"gone/J.db\"\n");
  const std::string status = box_.wait_for("\"state\":\"tracking\"", kLong);
  EXPECT_TRUE(has(status, R"("state":"standing still")")) << status;
  EXPECT_TRUE(has(status, R"("safe":0)")) << status;
  EXPECT_TRUE(has(box_.said(), "the journal stands still: ")) << box_.said();
  EXPECT_TRUE(has(box_.ask({"self-test"}).out, "journal")) << box_.ask({"self-test"}).out;
}

}  // namespace
}  // namespace tubesight::tests
