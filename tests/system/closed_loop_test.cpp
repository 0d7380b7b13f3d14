// The loop closed over the ports: a simulated robot moves the tool, the box looks, sets the lamp
// and answers. Expected values are the world's truth, which the box does not know.

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "board/bench/calibrate/base_command.h"
#include "core/base/transform.h"
#include "core/kinematics/arm_errors.h"
#include "drivers/files/pairs_file.h"
#include "tests/support/events.h"
#include "tests/support/settings_list.h"
#include "tests/support/simulated_bench.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::tests {
namespace {

using core::TubeAddress;
using Verdict = core::ClaimVerdict;

class ClosedLoop : public testing::Test {
 protected:
  SimulatedBench& bench() { return *bench_; }

  /// The pose that the robot heard, as a transform.
  [[nodiscard]] core::Transform<core::frames::Sheet, core::frames::Tool> heard_pose() const {
    const core::PoseResult& pose = bench_->robot().heard().last_pose->pose;
    std::array<double, 3> angles_deg{};
    Eigen::Vector3d position_mm;
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      angles_deg[at] = static_cast<double>(pose.angles_ndeg[at]) * 1e-9;
      position_mm[i] = static_cast<double>(pose.position_nm[at]) * 1e-6;
    }
    return {core::rotation_from_degrees(angles_deg), position_mm};
  }

 private:
  std::unique_ptr<SimulatedBench> bench_ = std::make_unique<SimulatedBench>();
};

TEST_F(ClosedLoop, TheLampLevelChangesTheNextPicture) {
  bench().start();
  bench().run(0.2);
  const double full = bench().grey();

  ASSERT_TRUE(bench().dimmer().set_level(500));
  bench().run(0.05);
  const double half = bench().grey();
  ASSERT_TRUE(bench().dimmer().set_level(0));
  bench().run(0.05);
  const double dark = bench().grey();
  ASSERT_TRUE(bench().dimmer().set_level(1000));
  bench().run(0.05);

  EXPECT_GT(full, 50.0);
  EXPECT_LT(dark, 15.0);
  EXPECT_NEAR((half - dark) / (full - dark), 0.5, 0.1);
  EXPECT_NEAR(bench().grey(), full, 2.0);
}

TEST_F(ClosedLoop, ALampThatLagsFollowsByAndBy) {
  bench().scenario.light.lag_s = 0.1;
  bench().start();
  bench().run(1.5);
  const double full = bench().grey();

  ASSERT_TRUE(bench().dimmer().set_level(200));
  bench().run(0.05);
  const double soon = bench().grey();
  bench().run(1.0);
  const double late = bench().grey();

  // After half a time constant some 60 % of the step is left.
  EXPECT_GT((soon - late) / (full - late), 0.4);
  EXPECT_LT((soon - late) / (full - late), 0.8);
}

TEST_F(ClosedLoop, TheBoxSeesALampFailThatItsDimmerDoesNot) {
  bench().scenario.faults.push_back({drivers::FaultKind::kLampOut, 1.0});
  bench().start();
  bench().run(0.9);
  ASSERT_EQ(bench().sighting().state, core::TrackState::kTracking);

  bench().run(0.15);

  EXPECT_EQ(bench().sighting().reason, core::Reason::kDark);
  EXPECT_FALSE(bench().sighting().aligned);
  bench().run(0.5);
  EXPECT_EQ(bench().sighting().state, core::TrackState::kLost);
  EXPECT_TRUE(bench().dimmer().set_level(1000)) << "a dimmer sees no light";
}

TEST_F(ClosedLoop, ALampCommandOfTheRobotReachesTheLamp) {
  bench().start();
  bench().run(0.1);
  ASSERT_TRUE(bench().robot().say(event_of(core::LampCommand{700})));
  const double before = bench().grey();

  bench().run(0.1);

  EXPECT_EQ(bench().dimmer().level_permille(), 700);
  EXPECT_LT(bench().grey(), 0.85 * before);
}

TEST_F(ClosedLoop, ACalibratedRobotsClaimsAreConfirmed) {
  bench().robot_settings.errors = core::kinematics::draw_errors(
      core::kinematics::calibrated_magnitudes(), bench().robot_settings.believed, 3);
  bench().start();
  bench().run(0.6);
  ASSERT_TRUE(bench().robot().move_to({44, 65}));
  bench().run_to_rest();

  ASSERT_TRUE(bench().robot().heard().last_claim);
  const core::ClaimReply& reply = *bench().robot().heard().last_claim;
  EXPECT_EQ(reply.claimed, (TubeAddress{44, 65}));
  EXPECT_EQ(reply.verdict, Verdict::kConfirmed);
  EXPECT_EQ(reply.tube, (TubeAddress{44, 65}));
  EXPECT_EQ(bench().truth().axis.nearest.address, (TubeAddress{44, 65}));
  EXPECT_GT(bench().truth().axis.nearest.offset_mm, 0.1) << "the robot is not perfect";
  EXPECT_EQ(bench().robot().heard().contradicted, 0);
  EXPECT_EQ(bench().wrong(), 0);
}

TEST_F(ClosedLoop, ARobotOffByAPitchIsToldItsTrueTube) {
  // A column and a millimetre: the robot knows nothing of it.
  bench().robot_settings.errors.base.position_mm = {24.4, 0.5, 1.0};
  bench().start();
  bench().run(0.6);
  ASSERT_TRUE(bench().robot().move_to({42, 63}));
  bench().run_to_rest();

  ASSERT_TRUE(bench().robot().heard().last_claim);
  const core::ClaimReply& reply = *bench().robot().heard().last_claim;
  EXPECT_EQ(reply.claimed, (TubeAddress{42, 63}));
  EXPECT_EQ(reply.verdict, Verdict::kContradicted);
  EXPECT_EQ(reply.tube, (TubeAddress{42, 64}));
  EXPECT_EQ(bench().truth().axis.nearest.address, (TubeAddress{42, 64}));
  EXPECT_EQ(bench().robot().heard().confirmed, 0);
  EXPECT_EQ(bench().wrong(), 0);
}

TEST_F(ClosedLoop, BetweenTubesTheBoxVouchesForNone) {
  // Off by 0.6 of a pitch: the nearest tube is the neighbour, but the guidetube is not under it.
  bench().robot_settings.errors.base.position_mm = {15.2, 0.0, 0.0};
  bench().start();
  bench().run(1.0);

  ASSERT_TRUE(bench().robot().heard().last_claim);
  EXPECT_EQ(bench().robot().heard().last_claim->verdict, Verdict::kUnknown);
  EXPECT_EQ(bench().sighting().tool, (TubeAddress{40, 61}));
  EXPECT_EQ(bench().robot().believed_tube(), (TubeAddress{40, 60}));
}

TEST_F(ClosedLoop, APoseRequestCorrectsTheRobotWhoseClaimIsThenRight) {
  bench().robot_settings.errors = core::kinematics::draw_errors(
      core::kinematics::calibrated_magnitudes(), bench().robot_settings.believed, 5);
  bench().robot_settings.errors.base.position_mm[0] += 24.6;
  bench().start();
  bench().run(0.6);
  ASSERT_TRUE(bench().robot().say(event_of(core::PoseRequest{})));
  bench().run(1.5);
  ASSERT_TRUE(bench().robot().heard().last_pose);
  ASSERT_EQ(bench().robot().heard().last_pose->pose.reason, core::PoseReason::kNone);
  EXPECT_EQ(bench().robot().heard().last_pose->verdict, core::PoseVerdict::kConfirmed);
  const auto seen = heard_pose();
  EXPECT_LT((seen.translation_mm() - bench().truth().T_sheet_tool.translation_mm()).norm(), 0.05);

  ASSERT_TRUE(bench().robot().correct_base(seen));
  ASSERT_TRUE(bench().robot().move_to({42, 62}));
  bench().run_to_rest();

  const core::ClaimReply& reply = *bench().robot().heard().last_claim;
  EXPECT_EQ(reply.claimed, (TubeAddress{42, 62}));
  EXPECT_EQ(reply.verdict, Verdict::kConfirmed);
  EXPECT_EQ(bench().truth().axis.nearest.address, (TubeAddress{42, 62}));
  // Off by backlash and what the links' errors change within two pitches; before it was 24.6 mm.
  EXPECT_LT(bench().truth().axis.nearest.offset_mm, 0.5);
  EXPECT_EQ(bench().wrong(), 0);
}

TEST_F(ClosedLoop, PairsThatTheBoxKeepsTellWhereTheBaseTrulyStands) {
  const support::TemporaryFolder folder;
  // The robot's base is not where it believes; it tells poses in its own base all the same.
  bench().robot_settings.errors.base.position_mm = {6.0, -4.0, 3.0};
  bench().robot_settings.errors.base.rotation_deg = {0.2, 0.0, 0.0};
  bench().robot_settings.limits = {250.0, 2000.0, 20000.0};
  bench().start();
  bench().run(0.6);
  std::string message;
  int written = 0;
  for (const core::TubeAddress tube :
       {TubeAddress{40, 60}, {40, 68}, {48, 68}, {48, 60}, {44, 64}}) {
    ASSERT_TRUE(bench().robot().move_to(tube));
    bench().run_to_rest();
    ASSERT_TRUE(bench().robot().say(event_of(core::PoseRequest{})));
    bench().run(0.25);
    while (const auto pair = bench().pairs().take_pair()) {
      ASSERT_TRUE(drivers::append_pair(folder.path("pairs.csv"), *pair, message)) << message;
      ++written;
    }
  }
  ASSERT_EQ(written, 5);
  EXPECT_EQ(bench().wrong(), 0);

  board::CalibrateBaseOptions options;
  options.pairs = folder.path("pairs.csv");
  options.out = folder.path("base.toml");
  options.tool_known = true;
  ASSERT_EQ(board::run_calibrate_base(options), board::ExitStatus::kDone);

  const std::string settings = folder.read("base.toml");
  const auto position = list_of(settings, "position_mm");
  const auto rotation = list_of(settings, "rotation_deg");
  const auto& truth = bench().robot().true_arm().T_sheet_base;
  const core::Transform<core::frames::Sheet, core::frames::Base> found(
      core::rotation_from_degrees({rotation[0], rotation[1], rotation[2]}),
      Eigen::Vector3d(position[0], position[1], position[2]));
  const Eigen::Vector3d there(800.0, 400.0, 960.0);  // where the tool was, in the base
  EXPECT_GT((bench().robot_settings.believed.T_sheet_base * there - truth * there).norm(), 3.0);
  EXPECT_LT((found * there - truth * there).norm(), 0.2)
      << "found " << position[0] << ", " << position[1] << ", " << position[2];
}

TEST_F(ClosedLoop, ANoisyLineLosesMessagesButShiftsNoAnswer) {
  bench().robot_settings.claim_period_s = 0.05;
  bench().robot_settings.errors.base.position_mm = {25.4, 0.0, 0.0};
  bench().start({0.2, 0.2, 11});
  for (const TubeAddress tube : {TubeAddress{40, 62}, {41, 62}, {40, 60}}) {
    ASSERT_TRUE(bench().robot().move_to(tube));
    bench().run_to_rest();
    const auto& last = bench().robot().heard().last_claim;
    ASSERT_TRUE(last);
    EXPECT_EQ(last->claimed, tube);
    EXPECT_EQ(last->tube, (TubeAddress{tube.row, tube.column + 1}));
  }

  EXPECT_GT(bench().garbled(), 0);
  EXPECT_EQ(bench().robot().heard().confirmed, 0);
}

TEST_F(ClosedLoop, ARobotThatGoesAwayIsAnsweredWhenItIsBack) {
  bench().start();
  bench().run(0.5);
  bench().link().connect(false);
  bench().run(1.0);
  const auto replies = bench().robot().heard().replies;
  EXPECT_GT(bench().disconnected(), 0);
  EXPECT_EQ(bench().sighting().state, core::TrackState::kTracking) << "the box looks on";

  bench().link().connect(true);
  bench().run(0.6);

  EXPECT_GT(bench().robot().heard().replies, replies);
}

}  // namespace
}  // namespace tubesight::tests
