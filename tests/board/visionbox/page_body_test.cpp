#include "board/visionbox/page_body.h"

#include <gtest/gtest.h>

#include "board/visionbox/page_recordings.h"

namespace tubesight::board {
namespace {

Json parsed(const char* text) { return Json::parse(text, nullptr, false); }

TEST(PageBody, HasWholeNumbersInRangeAlone) {
  const Json body = parsed(
      R"({"good": 7, "text": "7", "half": 7.5, "huge": 18446744073709551615, "true": true})");
  EXPECT_EQ(whole_of(body, "good", 0, 10), 7);
  EXPECT_EQ(whole_of(body, "good", 8, 10), std::nullopt);
  for (const char* const key : {"text", "half", "huge", "true", "absent"}) {
    EXPECT_EQ(whole_of(body, key, INT64_MIN, INT64_MAX), std::nullopt) << key;
  }
}

TEST(PageBody, HasTheClicksOfAStart) {
  core::Start start;
  EXPECT_TRUE(
      read_tubes(parsed(R"({"tubes": [{"row": -3, "column": 60, "u": 313.5, "v": 196}]})"), start));
  ASSERT_EQ(start.tubes.size(), 1);
  EXPECT_EQ(start.tubes[0].address, (core::TubeAddress{-3, 60}));
  EXPECT_EQ(start.tubes[0].at_px[0], 313.5);
}

TEST(PageBody, HasNoClicksWhereOneIsNone) {
  for (const char* const text :
       {"{}", R"({"tubes": []})", R"({"tubes": {}})", R"({"tubes": [[1, 2, 3, 4]]})",
        R"({"tubes": [{"row": 1, "column": 1, "u": 1}]})",
        R"({"tubes": [{"row": 1e9, "column": 1, "u": 1, "v": 1}]})",
        R"({"tubes": [{"row": 1, "column": 1, "u": 1e9, "v": 1}]})"}) {
    core::Start start;
    EXPECT_FALSE(read_tubes(parsed(text), start)) << text;
  }
}

TEST(PageRecordings, AreKnownByTheirNames) {
  EXPECT_TRUE(is_recording_name("box-000012-20261201T024009Z-track-lost.y4m"));
  for (const char* const name : {"", "box-", "secret.y4m", "../box-1-2-3.y4m", "box-1/../../x.y4m",
                                 "box-000012-x.toml", "box-000012-20261201T024009Z-command.y4m~"}) {
    EXPECT_FALSE(is_recording_name(name)) << name;
  }
}

}  // namespace
}  // namespace tubesight::board
