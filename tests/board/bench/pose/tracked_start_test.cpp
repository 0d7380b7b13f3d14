#include "board/bench/pose/tracked_start.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tests/board/bench/pose/moving_recording.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using support::TemporaryFolder;
using tests::moving_place;

class TrackedStartTest : public ::testing::Test {
 protected:
  TrackedStartTest() {
    tests::make_synthetic_settings(*settings_);
    sheet_ = std::make_unique<tests::SyntheticSheet>(*settings_);
  }

  /// Clicks on three tubes seen in the first field of a frame.
  [[nodiscard]] PictureStarts clicks_in(std::int64_t frame) const {
    PictureStarts clicks;
    const auto place = moving_place(2 * frame);
    const core::TubeAddress below = sheet_->nearest(sheet_->axis_point(place));
    for (const auto& [row, column] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
      const core::TubeAddress tube{below.row + row, below.column + column};
      const auto at = sheet_->image_of(place, tube);
      clicks.push_back({tube, at[0] + 2.0, at[1] - 2.0});
    }
    return clicks;
  }

  TemporaryFolder folder_;
  std::unique_ptr<core::SessionSettings> settings_ = std::make_unique<core::SessionSettings>();
  std::unique_ptr<tests::SyntheticSheet> sheet_;
};

TEST_F(TrackedStartTest, TellsInEachFrameWhereTheTubesHaveGone) {
  folder_.write("r.y4m", tests::moving_recording());
  TrackedStart tracked(*settings_, clicks_in(0), {0, true});

  for (const int frame : {1, 7, 12, 3}) {  // the last one by a second pass
    const TrackedFrame found = tracked.find(folder_.path("r.y4m"), frame);

    ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
    EXPECT_GT(found.tubes.size(), 8U);
    const auto place = moving_place(2 * frame + 1);
    for (const core::pose::PictureStart& tube : found.tubes) {
      const auto truth = sheet_->image_of(place, tube.address);
      EXPECT_LT(std::hypot(tube.u_px - truth[0], tube.v_px - truth[1]), 0.5) << frame;
    }
    if (found.tool) {
      EXPECT_EQ(*found.tool, sheet_->nearest(sheet_->axis_point(place))) << frame;
    }
  }
}

TEST_F(TrackedStartTest, BeginsInTheFrameOfTheClicks) {
  folder_.write("r.y4m", tests::moving_recording());
  TrackedStart tracked(*settings_, clicks_in(8), {8, false});

  const TrackedFrame found = tracked.find(folder_.path("r.y4m"), 12);

  ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
  ASSERT_TRUE(found.tool);
  EXPECT_EQ(*found.tool, sheet_->nearest(sheet_->axis_point(moving_place(25))));
}

TEST_F(TrackedStartTest, ClicksOfAnotherFrameAreRefused) {
  folder_.write("r.y4m", tests::moving_recording());
  TrackedStart tracked(*settings_, clicks_in(2), {0, true});

  const TrackedFrame found = tracked.find(folder_.path("r.y4m"), 5);

  EXPECT_EQ(found.status, ExitStatus::kJobFailed);
  EXPECT_NE(found.message.find("the start was refused in field 0 ("), std::string::npos)
      << found.message;
}

TEST_F(TrackedStartTest, WhereTheTubesWereLostIsSaid) {
  folder_.write("r.y4m", tests::darkened_recording(4, 11));
  TrackedStart tracked(*settings_, clicks_in(0), {0, true});

  const TrackedFrame before = tracked.find(folder_.path("r.y4m"), 3);
  const TrackedFrame coasting = tracked.find(folder_.path("r.y4m"), 4);
  const TrackedFrame after = tracked.find(folder_.path("r.y4m"), 12);

  EXPECT_EQ(before.status, ExitStatus::kDone) << before.message;
  EXPECT_EQ(coasting.status, ExitStatus::kJobFailed);
  EXPECT_NE(coasting.message.find("degraded from field 8 (dark: "), std::string::npos)
      << coasting.message;
  EXPECT_EQ(after.status, ExitStatus::kJobFailed);
  EXPECT_NE(after.message.find("lost them in field "), std::string::npos) << after.message;
  EXPECT_TRUE(after.tubes.empty());
}

TEST_F(TrackedStartTest, ALaterStartOfTheEventFileCountsUnlessTheClicksAreTheUsers) {
  folder_.write("r.y4m", tests::darkened_recording(4, 9));
  std::string values;
  for (const core::pose::PictureStart& click : clicks_in(11)) {
    values += (values.empty() ? "" : ";") + std::to_string(click.address.row) + "," +
              std::to_string(click.address.column) + "," + std::to_string(std::lround(click.u_px)) +
              "," + std::to_string(std::lround(click.v_px));
  }
  folder_.write("r.events.csv", "field,time_s,kind,values\n22,,start,\"" + values + "\"\n");
  TrackedStart session(*settings_, clicks_in(0), {0, true});
  TrackedStart users(*settings_, clicks_in(0), {0, false});

  const TrackedFrame found = session.find(folder_.path("r.y4m"), 12);
  const TrackedFrame lost = users.find(folder_.path("r.y4m"), 12);

  ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
  ASSERT_TRUE(found.tool);
  EXPECT_EQ(*found.tool, sheet_->nearest(sheet_->axis_point(moving_place(25))));
  EXPECT_EQ(lost.status, ExitStatus::kJobFailed);
}

TEST_F(TrackedStartTest, AFrameWithADamagedFieldIsRefused) {
  folder_.write("r.y4m", tests::moving_recording());
  std::string meta = "field,sequence,time_s,status,lamp_permille\n";
  for (int field = 0; field < 2 * tests::kMovingFrames; ++field) {
    meta += std::to_string(field) + "," + std::to_string(field) + "," +
            std::to_string(field / 60.0) + (field == 10 ? ",damaged,\n" : ",good,\n");
  }
  folder_.write("r.meta.csv", meta);
  TrackedStart tracked(*settings_, clicks_in(0), {0, true});

  const TrackedFrame damaged = tracked.find(folder_.path("r.y4m"), 5);
  const TrackedFrame next = tracked.find(folder_.path("r.y4m"), 7);

  EXPECT_EQ(damaged.status, ExitStatus::kJobFailed);
  EXPECT_NE(damaged.message.find("field 10 (damaged-field: "), std::string::npos)
      << damaged.message;
  EXPECT_EQ(next.status, ExitStatus::kDone) << next.message;
}

TEST_F(TrackedStartTest, FilesThatCannotBeUsedAreWrongInput) {
  folder_.write("r.y4m", tests::moving_recording());
  folder_.write("r.meta.csv", "field\n");
  TrackedStart tracked(*settings_, clicks_in(0), {0, true});

  const TrackedFrame found = tracked.find(folder_.path("r.y4m"), 2);
  const TrackedFrame none = tracked.find(folder_.path("none.y4m"), 2);

  EXPECT_EQ(found.status, ExitStatus::kWrongInput);
  EXPECT_EQ(found.message.find(folder_.path("r.meta.csv")), 0U) << found.message;
  EXPECT_EQ(none.status, ExitStatus::kWrongInput);
  EXPECT_EQ(none.message.find(folder_.path("none.y4m")), 0U) << none.message;
}

TEST(AgreeOnTubes, WithinHalfAStepOfEachTubeThatBothName) {
  const PictureStarts tracked = {
      {{4, 6}, 300.0, 200.0}, {{4, 7}, 380.0, 200.0}, {{5, 6}, 300.0, 260.0}};

  EXPECT_TRUE(agree_on_tubes(tracked, tracked));
  EXPECT_TRUE(agree_on_tubes({{{4, 6}, 315.0, 215.0}}, tracked));
  EXPECT_TRUE(agree_on_tubes({{{4, 6}, 300.0, 200.0}, {{4, 8}, 460.0, 200.0}}, tracked));
}

TEST(AgreeOnTubes, NotAStepAsideNorWithoutACommonTube) {
  const PictureStarts tracked = {
      {{4, 6}, 300.0, 200.0}, {{4, 7}, 380.0, 200.0}, {{5, 6}, 300.0, 260.0}};

  EXPECT_FALSE(agree_on_tubes({{{4, 6}, 380.0, 200.0}}, tracked));
  EXPECT_FALSE(agree_on_tubes(tracked, {{{4, 6}, 300.0, 231.0}}));
  EXPECT_FALSE(agree_on_tubes({{{9, 9}, 300.0, 200.0}}, tracked));
  EXPECT_FALSE(agree_on_tubes({}, tracked));
}

}  // namespace
}  // namespace tubesight::board
