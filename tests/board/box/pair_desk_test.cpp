#include "board/box/pair_desk.h"

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::board {
namespace {

core::Event request(std::int64_t id, std::int64_t x_nm,
                    core::EventOrigin origin = core::EventOrigin::kRobot) {
  core::RobotPose robot;
  robot.position_nm[0] = x_nm;
  core::Event event = tests::event_of(core::PoseRequest{robot}, origin);
  event.id = id;
  return event;
}

core::Reply pose(std::int64_t id, core::PoseVerdict verdict, std::int64_t x_nm = 0) {
  core::PoseReply content;
  content.verdict = verdict;
  content.pose.reason =
      verdict == core::PoseVerdict::kRefused ? core::PoseReason::kPicture : core::PoseReason::kNone;
  content.pose.position_nm[0] = x_nm;
  return {id, core::EventOrigin::kRobot, {}, content};
}

core::Reply taken(std::int64_t id, core::PoseReason refusal = core::PoseReason::kNone) {
  return {id, core::EventOrigin::kRobot, {}, core::PoseRequestReply{refusal}};
}

class PairDeskTest : public ::testing::Test {
 protected:
  void step(std::initializer_list<core::Event> events, std::initializer_list<core::Reply> replies) {
    core::EventList all_events;
    core::ReplyList all_replies;
    for (const core::Event& event : events) {
      ASSERT_TRUE(all_events.try_push_back(event));
    }
    for (const core::Reply& reply : replies) {
      ASSERT_TRUE(all_replies.try_push_back(reply));
    }
    desk_.take(all_events, all_replies);
  }

  PairDesk desk_;
};

TEST_F(PairDeskTest, APoseThatIsConfirmedMakesAPairWithWhatTheRobotToldOfIt) {
  step({request(7, 100)}, {taken(7)});
  step({}, {});
  EXPECT_FALSE(desk_.take_pair());

  step({}, {pose(7, core::PoseVerdict::kConfirmed, 200)});

  const auto pair = desk_.take_pair();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->robot.position_nm[0], 100);
  EXPECT_EQ(pair->seen.position_nm[0], 200);
  EXPECT_FALSE(desk_.take_pair());
}

TEST_F(PairDeskTest, APoseUnderAnotherTubeOrNoneMakesNoPair) {
  for (const auto verdict : {core::PoseVerdict::kContradicted, core::PoseVerdict::kUnknown,
                             core::PoseVerdict::kRefused}) {
    step({request(7, 100)}, {taken(7)});
    step({}, {pose(7, verdict)});
    step({}, {pose(7, core::PoseVerdict::kConfirmed)});  // told twice: of what, nobody knows
    EXPECT_FALSE(desk_.take_pair());
  }
}

TEST_F(PairDeskTest, ARefusedRequestLeavesTheOneUnderWay) {
  step({request(7, 100)}, {taken(7)});
  step({request(8, 300)}, {taken(8, core::PoseReason::kBusy)});
  step({}, {pose(8, core::PoseVerdict::kConfirmed)});
  EXPECT_FALSE(desk_.take_pair());

  step({}, {pose(7, core::PoseVerdict::kConfirmed)});

  const auto pair = desk_.take_pair();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->robot.position_nm[0], 100);
}

TEST_F(PairDeskTest, ARequestWithoutAPoseMakesNone) {
  step({request(7, 100)}, {taken(7)});
  core::Event bare = tests::event_of(core::PoseRequest{});
  bare.id = 7;  // a robot may use its ids twice where the link does not count
  step({bare}, {taken(7)});
  step({}, {pose(7, core::PoseVerdict::kConfirmed)});
  EXPECT_FALSE(desk_.take_pair());
}

TEST_F(PairDeskTest, AnOperatorsRequestOfTheSameIdIsAnother) {
  step({request(7, 100, core::EventOrigin::kOperator)}, {taken(7)});
  step({}, {pose(7, core::PoseVerdict::kConfirmed)});
  EXPECT_FALSE(desk_.take_pair());
}

TEST_F(PairDeskTest, TheEndOfOneAndTheBeginOfTheNextMayComeInOneStep) {
  step({request(7, 100)}, {taken(7)});
  step({request(8, 300)}, {pose(7, core::PoseVerdict::kConfirmed), taken(8)});
  step({}, {pose(8, core::PoseVerdict::kConfirmed)});

  EXPECT_EQ(desk_.take_pair().value().robot.position_nm[0], 100);
  EXPECT_EQ(desk_.take_pair().value().robot.position_nm[0], 300);
}

TEST_F(PairDeskTest, PairsThatNobodyTakesAreCounted) {
  for (std::int64_t id = 1; id <= 10; ++id) {
    step({request(id, id)}, {taken(id)});
    step({}, {pose(id, core::PoseVerdict::kConfirmed)});
  }

  EXPECT_EQ(desk_.lost(), 2);
  EXPECT_EQ(desk_.take_pair().value().robot.position_nm[0], 1);
}

}  // namespace
}  // namespace tubesight::board
