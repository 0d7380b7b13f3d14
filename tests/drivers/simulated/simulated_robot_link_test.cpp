#include "drivers/simulated/simulated_robot_link.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/hal/robot_link_contract.h"
#include "tests/support/events.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::drivers {
namespace {

class SimulatedMaker {
 public:
  static constexpr int kStartTubes = core::kMaxStartPoints;

  explicit SimulatedMaker(const LineNoise& noise = {})
      : robot_(std::make_unique<SimulatedRobot>()), link_(*robot_, noise) {
    const auto scenario = std::make_unique<Scenario>();
    tests::make_ordinary_scenario(*scenario);
    EXPECT_TRUE(robot_->configure(tests::make_ordinary_robot(), scenario->scene.sheet));
  }
  SimulatedRobotLink& link() { return link_; }
  SimulatedRobot& robot() { return *robot_; }
  void say(const core::Event& event) { EXPECT_TRUE(robot_->say(event)); }
  [[nodiscard]] std::size_t replies() const {
    return static_cast<std::size_t>(robot_->heard().replies);
  }
  [[nodiscard]] std::size_t sightings() const {
    return static_cast<std::size_t>(robot_->heard().sightings);
  }

 private:
  std::unique_ptr<SimulatedRobot> robot_;
  SimulatedRobotLink link_;
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, RobotLinkContract, drivers::SimulatedMaker);
}  // namespace tubesight::support

namespace tubesight::drivers {
namespace {

TEST(SimulatedRobotLink, LosesAndGarblesTheSharesAskedFor) {
  SimulatedMaker maker({0.1, 0.2, 5});
  ASSERT_TRUE(maker.link().start());
  int arrived = 0;
  int garbled = 0;
  for (int i = 0; i < 1000; ++i) {
    maker.say(tests::event_of(core::PoseRequest{}));
    const auto message = maker.link().poll_event();
    arrived += message && message->has_value() ? 1 : 0;
    garbled += !message && message.error() == core::Error::kDataLoss ? 1 : 0;
    ASSERT_TRUE(maker.link().send_reply({}));
  }

  // Four standard deviations.
  EXPECT_NEAR(arrived, 700, 58);
  EXPECT_NEAR(garbled, 200, 51);
  EXPECT_NEAR(static_cast<double>(maker.replies()), 700, 58);
}

TEST(SimulatedRobotLink, TakesWhatNoRobotMaySayForGarbled) {
  SimulatedMaker maker;
  ASSERT_TRUE(maker.link().start());
  for (const core::Event& event :
       {tests::event_of(core::Acknowledge{}), tests::event_of(core::PoseResult{}),
        tests::event_of(core::LampCommand{1001})}) {
    maker.say(event);
    const auto message = maker.link().poll_event();
    ASSERT_FALSE(message);
    EXPECT_EQ(message.error(), core::Error::kDataLoss);
  }
}

TEST(SimulatedRobotLink, WhatIsSentWithoutAPlugIsLost) {
  SimulatedMaker maker;
  ASSERT_TRUE(maker.link().start());
  maker.link().connect(false);
  maker.say(tests::event_of(core::PoseRequest{}));
  const auto gone = maker.link().poll_event();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), core::Error::kDisconnected);
  EXPECT_FALSE(maker.link().send_reply({}));
  EXPECT_FALSE(maker.link().send_sighting({}));
  maker.link().connect(true);

  const auto none = maker.link().poll_event();
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->has_value());
  maker.say(tests::event_of(core::PoseRequest{}));
  const auto next = maker.link().poll_event();
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->has_value());
  EXPECT_EQ(maker.replies(), 0u);
}

TEST(SimulatedRobot, CountsWhatItHearsOfItsClaims) {
  SimulatedMaker maker;
  ASSERT_TRUE(maker.link().start());
  using Verdict = core::ClaimVerdict;
  for (const Verdict verdict :
       {Verdict::kConfirmed, Verdict::kUnknown, Verdict::kUnknown, Verdict::kContradicted}) {
    core::ClaimReply claim;
    claim.verdict = verdict;
    core::Reply reply;
    reply.content = claim;
    ASSERT_TRUE(maker.link().send_reply(reply));
  }

  EXPECT_EQ(maker.robot().heard().confirmed, 1);
  EXPECT_EQ(maker.robot().heard().unknown, 2);
  EXPECT_EQ(maker.robot().heard().contradicted, 1);
  ASSERT_TRUE(maker.robot().heard().last_claim);
  EXPECT_EQ(maker.robot().heard().last_claim->verdict, Verdict::kContradicted);
  EXPECT_FALSE(maker.robot().heard().last_pose);
}

}  // namespace
}  // namespace tubesight::drivers
