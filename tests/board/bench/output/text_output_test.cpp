#include "board/bench/output/text_output.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(Print, AppendsWhatPrintfWrites) {
  std::string out = "a ";

  print(out, "%d of %s\n", 7, "nine");

  EXPECT_EQ(out, "a 7 of nine\n");
}

TEST(Print, CutsOffWhatIsLongerThanItsBuffer) {
  std::string out;

  print(out, "%s", std::string(600, 'x').c_str());

  EXPECT_EQ(out, std::string(499, 'x'));
}

TEST(Tell, WritesALineAMessage) {
  testing::internal::CaptureStderr();

  tell("one");
  tell(std::vector<std::string>{"two", "three: 5 %"});

  EXPECT_EQ(testing::internal::GetCapturedStderr(), "one\ntwo\nthree: 5 %\n");
}

}  // namespace
}  // namespace tubesight::board
