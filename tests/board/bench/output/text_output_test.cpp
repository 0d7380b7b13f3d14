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

}  // namespace
}  // namespace tubesight::board
