#include "board/bench/pose/pose_starts.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

std::unique_ptr<core::SessionSettings> settings() {
  auto made = std::make_unique<core::SessionSettings>();
  made->camera.width_px = 635;
  made->camera.height_px = 480;
  made->tubesheet.rows = {0, 50};
  made->tubesheet.columns = {-5, 50};
  EXPECT_TRUE(made->tubesheet.missing.try_push_back({4, 4}));
  EXPECT_TRUE(made->tubesheet.plugged.try_push_back({5, 5}));
  return made;
}

TEST(ParseStarts, ReadsRowColumnAndPlace) {
  PictureStarts starts;
  std::string message;

  ASSERT_TRUE(parse_starts("7,-3,309.5,234; 6,42,309,124;", starts, message)) << message;

  ASSERT_EQ(starts.size(), 2U);
  EXPECT_EQ(starts[0].address, (core::TubeAddress{7, -3}));
  EXPECT_EQ(starts[0].u_px, 309.5);
  EXPECT_EQ(starts[1].v_px, 124.0);
}

TEST(ParseStarts, RefusesAnythingElseInOneLine) {
  for (const char* text : {"", ";", "7,3,309", "7,3,309,234,5", "7.5,3,309,234", "7,3,a,234",
                           "7,3,309,nan", "7,3,309,234;;8,3,309,234"}) {
    PictureStarts starts;
    std::string message;

    EXPECT_FALSE(parse_starts(text, starts, message)) << text;
    EXPECT_EQ(message.find("--start: "), 0U) << text;
  }
}

TEST(ParseStarts, RefusesMorePlacesThanOnePictureTakes) {
  std::string text;
  for (int i = 0; i <= core::pose::kMaxPictureStarts; ++i) {
    text += "1," + std::to_string(i) + ",10,10;";
  }
  PictureStarts starts;
  std::string message;

  EXPECT_FALSE(parse_starts(text, starts, message));
  EXPECT_EQ(message, "--start: 49 places, expected at most 48");
}

TEST(WhyStartsWrong, NamesTheTubeAndWhatIsExpected) {
  const auto given = settings();

  EXPECT_EQ(why_starts_wrong({{{1, 1}, 10, 10}, {{2, 1}, 10, 50}}, *given), "");
  EXPECT_NE(why_starts_wrong({{{1, 1}, 635, 10}}, *given).find("in the picture of 635 x 480"),
            std::string::npos);
  EXPECT_NE(why_starts_wrong({{{51, 1}, 10, 10}}, *given).find("is outside the tubesheet"),
            std::string::npos);
  EXPECT_NE(why_starts_wrong({{{4, 4}, 10, 10}}, *given).find("is listed as missing"),
            std::string::npos);
  EXPECT_NE(why_starts_wrong({{{5, 5}, 10, 10}}, *given).find("is listed as plugged"),
            std::string::npos);
  EXPECT_NE(why_starts_wrong({{{1, 1}, 10, 10}, {{1, 1}, 9, 9}}, *given).find("is named twice"),
            std::string::npos);
}

TEST(ParseAddress, TakesTwoWholeNumbersOnly) {
  core::TubeAddress address;

  ASSERT_TRUE(parse_address("12, -7", address));
  EXPECT_EQ(address, (core::TubeAddress{12, -7}));
  EXPECT_FALSE(parse_address("12", address));
  EXPECT_FALSE(parse_address("12,7,3", address));
  EXPECT_FALSE(parse_address("a,7", address));
}

}  // namespace
}  // namespace tubesight::board
