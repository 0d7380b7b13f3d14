// How the loop gathers events and sends the answers.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/board/box/box_bench.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::FieldTime;
using std::chrono::milliseconds;
using Ids = std::vector<std::int64_t>;

class BoxEvents : public BoxBench {
 protected:
  void SetUp() override {
    BoxBench::SetUp();
    ASSERT_TRUE(loop_->start());
  }

  static Ids ids_of(const std::vector<core::Reply>& replies) {
    Ids ids;
    for (const core::Reply& reply : replies) {
      ids.push_back(reply.id);
    }
    return ids;
  }
};

TEST_F(BoxEvents, AreAnsweredToWhoeverAsked) {
  link_.say(claim(1));
  station_.say(pick(2));
  link_.say(claim(3));

  take_field();
  take_field();  // an answer may wait for the field nearest to its question

  EXPECT_EQ(ids_of(link_.replies()), (Ids{1, 3}));
  EXPECT_EQ(ids_of(station_.replies()), (Ids{2}));
  EXPECT_EQ(loop_->counters().link.lost_replies, 0);
  EXPECT_EQ(loop_->counters().station.lost_replies, 0);
}

TEST_F(BoxEvents, AreMergedInTimeOrderAndTheLinkGoesFirst) {
  link_.say(at(claim(1), milliseconds(10)));
  link_.say(at(claim(2), milliseconds(14)));
  station_.say(at(pick(11), milliseconds(9)));
  station_.say(at(pick(12), milliseconds(14)));
  station_.say(at(pick(13), milliseconds(15)));

  take_field();

  EXPECT_EQ(handed(), (Ids{11, 1, 2, 12, 13}));
}

TEST_F(BoxEvents, OfOnePortKeepTheOrderInWhichTheyCame) {
  link_.say(at(claim(1), milliseconds(15)));
  link_.say(at(claim(2), milliseconds(5)));

  take_field();

  EXPECT_EQ(handed(), (Ids{1, 2}));
}

TEST_F(BoxEvents, WithoutAnInstantGetThePresentOne) {
  link_.say(claim(1));
  link_.say(at(claim(2), milliseconds(3)));

  take_field();

  ASSERT_EQ(loop_->input().events.size(), 2);
  EXPECT_EQ(loop_->input().events[0].at, FieldTime(kSpan));
  EXPECT_EQ(loop_->input().events[1].at, FieldTime(milliseconds(3)));
}

TEST_F(BoxEvents, InAFloodKeepTheirOrderAndNoneIsLost) {
  Ids all(60);
  std::iota(all.begin(), all.end(), 1);
  for (const std::int64_t id : all) {
    link_.say(claim(id));
  }
  Ids got;

  for (int field = 0; field < 5; ++field) {
    take_field();
    const Ids now = handed();
    EXPECT_LE(now.size(), 16U);
    got.insert(got.end(), now.begin(), now.end());
  }

  EXPECT_EQ(got, all);
}

TEST_F(BoxEvents, OfAFloodingRobotDoNotShutTheOperatorOut) {
  for (std::int64_t id = 1; id <= 40; ++id) {
    link_.say(at(claim(id), milliseconds(100)));
  }
  station_.say(at(pick(99), milliseconds(50)));

  take_field();

  const Ids now = handed();
  EXPECT_EQ(now.front(), 99);
  EXPECT_EQ(now.size(), 16U);
}

TEST_F(BoxEvents, ThatFoundNoRoomStayFirstInTime) {
  for (std::int64_t id = 1; id <= 17; ++id) {
    link_.say(at(claim(id), milliseconds(10)));
  }
  station_.say(at(pick(99), milliseconds(12)));

  take_field();
  take_field();

  EXPECT_EQ(handed(), (Ids{17, 99}));
}

TEST_F(BoxEvents, GoOnAfterGarbledMessages) {
  link_.say_error(Error::kDataLoss);
  link_.say(claim(1));
  link_.say_error(Error::kDataLoss);
  link_.say(claim(2));
  station_.say_error(Error::kDataLoss);
  station_.say(pick(3));

  take_field();

  EXPECT_EQ(handed(), (Ids{1, 2, 3}));
  EXPECT_EQ(loop_->counters().link.garbled, 2);
  EXPECT_EQ(loop_->counters().station.garbled, 1);
  EXPECT_EQ(loop_->counters().link.gone, 0);
}

TEST_F(BoxEvents, FromALineOfNoiseDoNotKeepTheFieldWaiting) {
  for (int i = 0; i < 100; ++i) {
    link_.say_error(Error::kDataLoss);
  }
  link_.say(claim(1));

  take_field();
  EXPECT_LE(loop_->counters().link.garbled, 16);
  EXPECT_TRUE(handed().empty());
  for (int field = 0; field < 6; ++field) {
    take_field();
  }

  EXPECT_EQ(loop_->counters().link.garbled, 100);
  EXPECT_EQ(handed(), (Ids{1}));
}

TEST_F(BoxEvents, ComeFromTheStationWhileTheRobotIsGone) {
  link_.connect(false);
  link_.say(claim(1));
  station_.say(pick(2));

  take_field();
  EXPECT_EQ(handed(), (Ids{2}));
  take_field();
  EXPECT_EQ(loop_->counters().link.gone, 2) << "once a turn";
  link_.connect(true);
  take_field();

  EXPECT_EQ(handed(), (Ids{1}));
  EXPECT_EQ(loop_->counters().link.gone, 2);
}

TEST_F(BoxEvents, AreForgottenByNobodyWhoseLineFailsOnce) {
  link_.say_error(Error::kIo);
  link_.say(claim(1));

  take_field();
  EXPECT_TRUE(handed().empty());
  take_field();

  EXPECT_EQ(handed(), (Ids{1}));
  EXPECT_EQ(loop_->counters().link.gone, 1);
}

TEST_F(BoxEvents, WhoseAnswersFindNoRoomAreCounted) {
  link_.limit_replies(1);
  link_.say(claim(1));
  link_.say(claim(2));
  station_.limit_replies(0);
  station_.say(pick(3));

  take_field();
  take_field();

  EXPECT_EQ(link_.replies().size(), 1U);
  EXPECT_EQ(loop_->counters().link.lost_replies, 1);
  EXPECT_EQ(loop_->counters().station.lost_replies, 1);
}

}  // namespace
}  // namespace tubesight::board
