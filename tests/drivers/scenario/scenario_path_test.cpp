#include "drivers/scenario/scenario_path.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/drivers/scenario/scenario_reading.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

using core::kinematics::SegmentKind;

TEST(ScenarioPath, StepsBecomeSegmentsWithTheirOwnManner) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\noffset_mm = [1.0, -2.0]\nheight_mm = 50\nheading_deg = 3\n"
      "lean_deg = [0.1, -0.2]\nspeed_mm_s = 80\n"
      "[[step]]\nrest_s = 0.5\n"
      "[[step]]\nto = [41, 60]\n"
      "[[step]]\nto_mm = [1500, 1000]\nspeed_mm_s = 40\nprofile = \"s-curve\"\n"
      "[[step]]\nheight_mm = 30\n"
      "[[step]]\nheading_deg = 10\nspeed_deg_s = 5\n"
      "[[step]]\nlean_deg = [0.0, 0.5]\n"
      "[[step]]\ndock_mm = 0\n");

  ASSERT_TRUE(read.good) << read.told();
  const auto& from = read.scenario().from;
  EXPECT_NEAR(from.x_mm, 1525.0, 1e-9);
  EXPECT_NEAR(from.y_mm, 1014.0, 1e-9);
  EXPECT_EQ(from.height_mm, 50.0);
  EXPECT_EQ(from.alpha_deg, 3.0);
  EXPECT_EQ(from.beta_deg, 0.1);
  EXPECT_EQ(from.gamma_deg, -0.2);
  const auto& path = read.scenario().path;
  ASSERT_EQ(path.size(), 7U);
  EXPECT_EQ(path[0].kind, SegmentKind::kRest);
  EXPECT_EQ(path[1].kind, SegmentKind::kMove);
  EXPECT_NEAR(path[1].to_mm[0], 1524.0, 1e-9) << "without scatter";
  EXPECT_EQ(path[1].limits.speed, 80.0);
  EXPECT_EQ(path[2].limits.speed, 40.0);
  EXPECT_EQ(path[2].shape, core::kinematics::SpeedShape::kSCurve);
  EXPECT_EQ(path[3].kind, SegmentKind::kHeight);
  EXPECT_EQ(path[4].kind, SegmentKind::kTurn);
  EXPECT_EQ(path[4].limits.speed, 5.0);
  EXPECT_EQ(path[5].kind, SegmentKind::kLean);
  EXPECT_EQ(path[6].kind, SegmentKind::kDock);
}

TEST(ScenarioPath, MovesEndWithinTheScatterAndNotAllAtOnePlace) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\nscatter_mm = 0.5\n"
      "[[step]]\nto = [40, 62]\n[[step]]\nto = [40, 64]\n[[step]]\nto = [40, 66]\n"
      "offset_mm = [0.0, 1.0]\n");

  ASSERT_TRUE(read.good) << read.told();
  const auto& path = read.scenario().path;
  const double first = std::hypot(path[0].to_mm[0] - 62 * 25.4, path[0].to_mm[1] - 1016.0);
  const double second = std::hypot(path[1].to_mm[0] - 64 * 25.4, path[1].to_mm[1] - 1016.0);
  EXPECT_GT(first, 0.0);
  EXPECT_LE(first, 0.5);
  EXPECT_LE(second, 0.5);
  EXPECT_NE(first, second);
  EXPECT_NEAR(path[2].to_mm[1], 1017.0, 1e-9) << "an offset that is given is exact";
}

TEST(ScenarioPath, RestsClaimInTheirMiddle) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\n[[step]]\nrest_s = 0.4\nclaim = true\n"
      "[[step]]\nrest_s = 0.2\nclaim_tube = [40, 61]\n[[step]]\nrest_s = 0.2\n");

  ASSERT_TRUE(read.good) << read.told();
  const auto& events = read.scenario().events;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[0].at_s, 0.2, 1e-12);
  EXPECT_EQ(tests::content_of<core::Claim>(events[0].event).tube, (core::TubeAddress{40, 60}));
  EXPECT_NEAR(events[1].at_s, 0.5, 1e-12);
  EXPECT_EQ(tests::content_of<core::Claim>(events[1].event).tube, (core::TubeAddress{40, 61}));
}

TEST(ScenarioPath, ToursGoToAndFroAndLeaveVoidsOut) {
  // (50, 61) and (50, 62) are missing in this sheet.
  const ScenarioReading read(
      "[path]\ntube = [49, 60]\n[[step]]\ntour = [[49, 60], [50, 63]]\npause_s = 0.1\n");

  ASSERT_TRUE(read.good) << read.told();
  std::vector<core::TubeAddress> claimed;
  for (const auto& event : read.scenario().events) {
    claimed.push_back(tests::content_of<core::Claim>(event.event).tube);
  }
  EXPECT_EQ(claimed, (std::vector<core::TubeAddress>{
                         {49, 60}, {49, 61}, {49, 62}, {49, 63}, {50, 63}, {50, 60}}));
  EXPECT_EQ(read.scenario().path.size(), 12U);
}

TEST(ScenarioPath, ToursEndAfterSoManyTubes) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\n[[step]]\ntour = [[40, 60], [49, 69]]\nat_most = 5\n"
      "claim = false\n");

  ASSERT_TRUE(read.good) << read.told();
  EXPECT_EQ(read.scenario().path.size(), 10U);
  EXPECT_TRUE(read.scenario().events.empty());
}

struct Wrong {
  const char* step;
  const char* message;
};

class ScenarioPathRefuses : public testing::TestWithParam<Wrong> {};

TEST_P(ScenarioPathRefuses, InOneLine) {
  const ScenarioReading read(std::string("[path]\ntube = [40, 60]\n[[step]]\n") + GetParam().step);

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(), std::string("s.toml:") + GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    What, ScenarioPathRefuses,
    testing::Values(
        Wrong{"claim = true\n",
              "4: step[0].rest_s: missing, expected one of rest_s, to, to_mm, height_mm, dock_mm, "
              "heading_deg, lean_deg, tour"},
        Wrong{"rest_s = 1\nto = [1, 1]\n",
              "6: step[0].to: rest_s is in the same step, expected one of rest_s, to, to_mm, "
              "height_mm, dock_mm, heading_deg, lean_deg, tour"},
        Wrong{"to = [50, 61]\n",
              "5: step[0].to: tube (50, 61) is listed as missing, expected a tube that stands"},
        Wrong{"to = [120, 60]\noffset_mm = [0.0, 20.0]\n",
              "5: step[0].to: (1524, 3068) mm is off the sheet, at row 120.79 and column 60, "
              "expected a row from 0 to 120 and a column from 0 to 120"},
        Wrong{"rest_s = 1\nclaim_tube = [1]\n",
              "6: step[0].claim_tube: a list of 1, expected [row, column]"},
        Wrong{"to = [40, 99999999999999]\n",
              "5: step[0].to: the column 99999999999999, expected [row, column], each an integer "
              "from -2147483648 to 2147483647"},
        Wrong{"to = [\"a\", 60]\n",
              "5: step[0].to: the row the text 'a', expected [row, column], each an integer from "
              "-2147483648 to 2147483647"},
        Wrong{"to_mm = [1549.4, 1270.0]\n[[step]]\nrest_s = 0.2\nclaim = true\n",
              "8: step[1].claim: tube (50, 61) is listed as missing, expected a tube that stands"},
        Wrong{"rest_s = 1\nclaim = 1\n", "6: step[0].claim: 1, expected true or false"},
        Wrong{"tour = [[1, 2]]\n",
              "5: step[0].tour: not two addresses, expected [[row, column], [row, column]]"},
        Wrong{"tour = [[1, 2], [1, 121]]\n",
              "5: step[0].tour: tube (1, 121), expected a row from 0 to 120 and a column from 0 to "
              "120"},
        Wrong{"tour = [[50, 61], [50, 62]]\n",
              "5: step[0].tour: no tube stands there, expected at least one"},
        Wrong{"to = [41, 60]\nspeed_mm_s = 0\n",
              "6: step[0].speed_mm_s: 0, expected a number from 0.1 to 5000 mm/s"}));

TEST(ScenarioPath, RefusesMoreSegmentsThanAPathHolds) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\n[[step]]\ntour = [[1, 1], [40, 60]]\nat_most = 2000\n"
      "[[step]]\ntour = [[1, 1], [40, 60]]\nat_most = 2000\n");

  EXPECT_FALSE(read.good);
  EXPECT_NE(read.told().find("the path is too long, expected at most 4096 segments"),
            std::string::npos)
      << read.told();
}

}  // namespace
}  // namespace tubesight::drivers
