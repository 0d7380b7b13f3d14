#include "board/visionbox/page_history.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

OverlaySnapshot under(core::TubeAddress tube, std::int64_t at_s, bool aligned = true) {
  OverlaySnapshot marks;
  marks.sighting.time = std::chrono::seconds(at_s);
  marks.sighting.tool_known = true;
  marks.sighting.tool = tube;
  marks.sighting.aligned = aligned;
  return marks;
}

class PageHistoryTest : public ::testing::Test {
 protected:
  PageHistoryTest() {
    core::TubesheetSettings sheet;
    sheet.row_step_mm = {0.0, 20.0};
    sheet.column_step_mm = {20.0, 0.0};
    history_.know_sheet(sheet);
  }
  std::int64_t claim(core::TubeAddress claimed, core::TubeAddress seen) {
    core::ClaimReply reply;
    reply.claimed = claimed;
    reply.tube = seen;
    reply.verdict =
        claimed == seen ? core::ClaimVerdict::kConfirmed : core::ClaimVerdict::kContradicted;
    return history_.take_claim(reply, 5.0, "2026-12-01T00:00:00Z");
  }

  PageHistory history_;
};

TEST_F(PageHistoryTest, CountsVisitsOfTubesThatTheBoxVouchedFor) {
  history_.take(under({3, 4}, 1), nullptr);
  history_.take(under({3, 4}, 2), nullptr);
  history_.take(under({3, 5}, 3, false), nullptr);
  history_.take(under({3, 4}, 4), nullptr);
  const Json visits = history_.visits();
  ASSERT_EQ(visits["tubes"].size(), 1U);
  EXPECT_EQ(visits["tubes"][0], Json::parse(R"([3, 4, "visited", 2, 4.0])"));
  EXPECT_EQ(visits["now"], Json::parse(R"({"x_mm": 80.0, "y_mm": 60.0})"));
  EXPECT_EQ(visits["path"].size(), 3U);
}

TEST_F(PageHistoryTest, KeepsOneDisagreementHoweverOftenTheRobotSaysIt) {
  EXPECT_EQ(claim({1, 1}, {1, 1}), 0);
  EXPECT_EQ(claim({1, 1}, {1, 2}), 1);
  EXPECT_EQ(claim({1, 1}, {1, 2}), 0);
  ASSERT_EQ(history_.disagreements().size(), 1U);
  EXPECT_TRUE(history_.disagreements()[0]["acknowledged"].is_null());
  EXPECT_FALSE(history_.acknowledge(2, "Ann", "seen", 6.0));
  EXPECT_TRUE(history_.acknowledge(1, "Ann", "seen", 6.0));
  EXPECT_EQ(history_.disagreements()[0]["acknowledged"]["name"], "Ann");
  EXPECT_EQ(claim({1, 1}, {1, 2}), 2);
  EXPECT_EQ(history_.visits()["tubes"][0][2], "contradicted");
}

TEST_F(PageHistoryTest, IsBounded) {
  for (std::int32_t i = 0; i < 300; ++i) {
    claim({i, 0}, {i, 1});
  }
  EXPECT_EQ(history_.disagreements().size(), 100U);
  EXPECT_EQ(history_.picture(300, 0), nullptr);
}

}  // namespace
}  // namespace tubesight::board
