#include "board/bench/output/text_output.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(Tell, WritesALineAMessage) {
  testing::internal::CaptureStderr();

  tell("one");
  tell(std::vector<std::string>{"two", "three: 5 %"});

  EXPECT_EQ(testing::internal::GetCapturedStderr(), "one\ntwo\nthree: 5 %\n");
}

/// Puts back what other tests count on.
struct Usual {
  Usual() = default;
  Usual(const Usual&) = delete;
  Usual& operator=(const Usual&) = delete;
  ~Usual() { set_talk(Talk::kUsual); }
};

TEST(TellMore, IsHeardWithVerboseAlone) {
  const Usual after;
  testing::internal::CaptureStderr();

  for (const Talk talk : {Talk::kQuiet, Talk::kUsual, Talk::kVerbose}) {
    set_talk(talk);
    tell_more("more " + std::to_string(static_cast<int>(talk)));
    tell_files({"s.toml", "c.toml", "t.toml"});
  }

  EXPECT_EQ(testing::internal::GetCapturedStderr(), "more 2\ns.toml: read, with c.toml, t.toml\n");
}

TEST(WriteOut, IsSilentWhenQuiet) {
  const Usual after;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();

  set_talk(Talk::kQuiet);
  EXPECT_TRUE(write_out("result\n"));
  EXPECT_TRUE(write_out("result\n", true));
  tell("a message");

  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "a message\n");
}

}  // namespace
}  // namespace tubesight::board
