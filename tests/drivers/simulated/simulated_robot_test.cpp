#include "drivers/simulated/simulated_robot.h"

#include <memory>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "tests/support/events.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;
using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;

class SimulatedRobotTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto scenario = std::make_unique<Scenario>();
    tests::make_ordinary_scenario(*scenario);
    sheet_ = std::make_unique<core::TubesheetSettings>(scenario->scene.sheet);
  }
  void configure() { ASSERT_TRUE(robot_->configure(settings_, *sheet_)); }

  void expect_at(double time_s, double x_mm, double y_mm, double z_mm) {
    const Eigen::Vector3d tip = robot_->pose_at(time_s).translation_mm();
    EXPECT_NEAR(tip.x(), x_mm, 1e-3) << time_s;
    EXPECT_NEAR(tip.y(), y_mm, 1e-3) << time_s;
    EXPECT_NEAR(tip.z(), z_mm, 1e-3) << time_s;
  }

  SimulatedRobotSettings settings_ = tests::make_ordinary_robot();
  std::unique_ptr<core::TubesheetSettings> sheet_;
  std::unique_ptr<SimulatedRobot> robot_ = std::make_unique<SimulatedRobot>();
};

TEST_F(SimulatedRobotTest, WithoutErrorsStandsWhereItBelievesAndMovesStraight) {
  configure();
  expect_at(0.0, 1524.0, 1016.0, -40.0);
  ASSERT_TRUE(robot_->move_to({40, 64}));  // 101.6 mm at 150 mm/s and 600 mm/s²
  EXPECT_FALSE(robot_->at_rest());

  // 0.25 s to 150 mm/s over 18.75 mm, then 64.1 mm at that speed.
  expect_at(0.25, 1524.0 + 18.75, 1016.0, -40.0);
  expect_at(0.45, 1524.0 + 48.75, 1016.0, -40.0);
  expect_at(2.0, 1625.6, 1016.0, -40.0);
  EXPECT_TRUE(robot_->at_rest());
  EXPECT_EQ(robot_->believed_tube(), (TubeAddress{40, 64}));
}

TEST_F(SimulatedRobotTest, CarriesCommandsOutOneAfterTheOther) {
  configure();
  expect_at(5.0, 1524.0, 1016.0, -40.0);
  ASSERT_TRUE(robot_->move_to({41, 60}));
  PathSegment dock;
  dock.kind = SegmentKind::kDock;
  dock.limits = {20.0, 200.0, 0.0};
  ASSERT_TRUE(robot_->add(dock));

  // 25.4 mm take 0.4115 s; 40 mm up take 2.1 s.
  expect_at(5.42, 1524.0, 1041.4, -40.0 + 0.5 * 200.0 * 0.0085036 * 0.0085036);
  expect_at(8.0, 1524.0, 1041.4, 0.0);
}

TEST_F(SimulatedRobotTest, AnErrorOfTheBaseMovesTheToolAndNotTheBelief) {
  settings_.errors.base.position_mm = {16.0, 1.0, 2.0};
  configure();

  expect_at(1.0, 1540.0, 1017.0, -38.0);
  EXPECT_EQ(robot_->believed_tube(), (TubeAddress{40, 60})) << "nearest is truly column 61";
}

TEST_F(SimulatedRobotTest, BacklashShowsInTheTruthAndNotInTheReadings) {
  // 0.02 degrees of play in the first joint, 923 mm away: 0.161 mm to either side.
  settings_.errors.drive.backlash_rad[0] = core::radians(0.02);
  configure();
  ASSERT_TRUE(robot_->move_to({44, 60}));
  ASSERT_TRUE(robot_->move_to({40, 60}));
  static_cast<void>(robot_->pose_at(0.0));
  static_cast<void>(robot_->pose_at(1.0));
  const Eigen::Vector3d tip = robot_->pose_at(10.0).translation_mm();

  const double off = (tip - Eigen::Vector3d(1524.0, 1016.0, -40.0)).norm();
  EXPECT_NEAR(off, 923.046 * core::radians(0.01), 0.001);
  EXPECT_LT(
      (robot_->believed_pose().translation_mm() - Eigen::Vector3d(1524.0, 1016.0, -40.0)).norm(),
      1e-3);
}

TEST_F(SimulatedRobotTest, ReadingsHaveTheirResolution) {
  settings_.errors.drive.resolution_rad.fill(core::radians(0.1));
  configure();

  expect_at(0.0, 1524.0, 1016.0, -40.0);
  const double off =
      (robot_->believed_pose().translation_mm() - Eigen::Vector3d(1524.0, 1016.0, -40.0)).norm();
  EXPECT_GT(off, 0.05);
  EXPECT_LT(off, 5.0) << "half of 0.1 degrees in each of three joints at a metre or two";
}

TEST_F(SimulatedRobotTest, ClaimsAtItsOwnRate) {
  settings_.claim_period_s = 0.5;
  configure();
  int claims = 0;
  for (int i = 0; i <= 300; ++i) {  // 5 s of fields
    static_cast<void>(robot_->pose_at(i / 60.0));
    while (const auto message = robot_->take_message()) {
      EXPECT_EQ(message->id, claims + 1);
      EXPECT_NEAR(static_cast<double>(message->at->count()), i / 60.0 * 1e9, 1.0);
      EXPECT_EQ(tests::content_of<core::Claim>(*message).tube, (TubeAddress{40, 60}));
      ++claims;
    }
  }
  EXPECT_EQ(claims, 10);
}

TEST_F(SimulatedRobotTest, ClaimsNothingWhereItBelievesAVoid) {
  ASSERT_TRUE(sheet_->missing.try_push_back({40, 60}));
  configure();
  static_cast<void>(robot_->pose_at(10.0));

  EXPECT_FALSE(robot_->believed_tube());
  EXPECT_FALSE(robot_->take_message());
}

TEST_F(SimulatedRobotTest, RefusesWhatIsOutOfReachAndStaysAsItWas) {
  configure();
  static_cast<void>(robot_->pose_at(0.0));

  const auto far = robot_->move_to({120, 120});  // 3.3 m away

  ASSERT_FALSE(far);
  EXPECT_EQ(far.error(), core::Error::kOutOfRange);
  EXPECT_TRUE(robot_->at_rest());
  EXPECT_TRUE(robot_->move_to({40, 61}));
  EXPECT_FALSE(robot_->stuck());
  settings_.home.x_mm = 5000.0;
  EXPECT_FALSE(robot_->configure(settings_, *sheet_));
}

TEST_F(SimulatedRobotTest, AnEarlierInstantIsAnsweredWithoutTurningBack) {
  configure();
  ASSERT_TRUE(robot_->move_to({40, 64}));
  static_cast<void>(robot_->pose_at(0.0));
  expect_at(0.45, 1524.0 + 48.75, 1016.0, -40.0);
  expect_at(0.25, 1524.0 + 18.75, 1016.0, -40.0);
  EXPECT_EQ(robot_->now_s(), 0.45);
  expect_at(0.45, 1524.0 + 48.75, 1016.0, -40.0);
}

TEST_F(SimulatedRobotTest, APoseSeenCorrectsItsIdeaOfTheBase) {
  settings_.errors.base.position_mm = {16.0, 1.0, 2.0};
  settings_.errors.base.rotation_deg = {0.3, 0.0, 0.0};
  configure();
  const auto seen = robot_->pose_at(1.0);
  ASSERT_GT((seen.translation_mm() - Eigen::Vector3d(1524.0, 1016.0, -40.0)).norm(), 12.7);

  ASSERT_TRUE(robot_->correct_base(seen));
  EXPECT_LT((robot_->believed_pose().translation_mm() - seen.translation_mm()).norm(), 1e-3);
  ASSERT_TRUE(robot_->move_to({42, 62}));
  EXPECT_FALSE(robot_->correct_base(seen)) << "not while it moves";
  expect_at(1.0, seen.translation_mm().x(), seen.translation_mm().y(), seen.translation_mm().z());
  const Eigen::Vector3d there = robot_->pose_at(5.0).translation_mm();
  EXPECT_NEAR(there.x(), 62 * 25.4, 0.01);
  EXPECT_NEAR(there.y(), 42 * 25.4, 0.01);
}

TEST_F(SimulatedRobotTest, KeepsOnlySoManyMessages) {
  configure();
  for (int i = 0; i < SimulatedRobot::kMaxMessages; ++i) {
    EXPECT_TRUE(robot_->say(tests::event_of(core::PoseRequest{})));
  }
  EXPECT_FALSE(robot_->say(tests::event_of(core::PoseRequest{})));
  ASSERT_TRUE(robot_->take_message());
  EXPECT_TRUE(robot_->say(tests::event_of(core::PoseRequest{})));
}

}  // namespace
}  // namespace tubesight::drivers
