#include "board/visionbox/zone_desk.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

/// A correction seen at the centre of tube (3, 5) of a sheet of oblique steps whose every other
/// address is absent, and one more: no tube stands there.
class ZoneDeskTest : public ::testing::Test {
 protected:
  ZoneDeskTest() {
    sheet_.origin_mm = {100.0, -50.0};
    sheet_.row_step_mm = {4.0, 20.0};
    sheet_.column_step_mm = {15.0, 0.0};
    sheet_.rows = {0, 40};
    sheet_.columns = {0, 40};
    sheet_.addresses = core::AddressParity::kEvenSum;
    EXPECT_TRUE(sheet_.missing.try_push_back({6, 6}));
    core::calibration::ZonePoint point;
    point.at_mm << 100.0 + 3 * 4.0 + 5 * 15.0, -50.0 + 3 * 20.0;
    point.off_mm << 0.8, -0.4, 1.2;
    point.sigma_mm = 0.01;
    EXPECT_TRUE(points_.try_push_back(point));
  }

  core::TubesheetSettings sheet_;
  core::calibration::ZonePoints points_;
  drivers::ZoneAnswer answer_;
};

TEST_F(ZoneDeskTest, TellsWhatWasSeenAtTheCentreOfTheTube) {
  ZoneDesk desk(points_, sheet_);
  EXPECT_FALSE(desk.at({3, 5}, answer_)) << "not yet";
  desk.start();
  desk.stop();

  ASSERT_TRUE(desk.at({3, 5}, answer_));
  EXPECT_NEAR(static_cast<double>(answer_.off_nm[0]), 0.8e6, 2e3);
  EXPECT_NEAR(static_cast<double>(answer_.off_nm[1]), -0.4e6, 2e3);
  EXPECT_NEAR(static_cast<double>(answer_.off_nm[2]), 1.2e6, 2e3);
  EXPECT_NEAR(static_cast<double>(answer_.across_nm), 0.01e6, 1e3);
  const std::int64_t sure_nm = answer_.across_nm;

  ASSERT_TRUE(desk.at({33, 35}, answer_));
  EXPECT_LT(answer_.off_nm[0], 600'000) << "800 mm away";
  EXPECT_GT(answer_.across_nm, 10 * sure_nm);
}

TEST_F(ZoneDeskTest, KnowsNothingWhereNoTubeIsOnTheDrawing) {
  ZoneDesk desk(points_, sheet_);
  desk.start();
  desk.stop();

  EXPECT_TRUE(desk.at({6, 8}, answer_));
  EXPECT_FALSE(desk.at({6, 6}, answer_)) << "missing";
  EXPECT_FALSE(desk.at({6, 7}, answer_)) << "not numbered";
  EXPECT_FALSE(desk.at({41, 5}, answer_)) << "beyond the last row";
  EXPECT_FALSE(desk.at({INT32_MIN, INT32_MAX}, answer_));
}

}  // namespace
}  // namespace tubesight::board
