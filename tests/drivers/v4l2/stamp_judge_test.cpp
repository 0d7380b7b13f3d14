#include "drivers/v4l2/stamp_judge.h"

#include <chrono>

#include <gtest/gtest.h>

namespace tubesight::drivers::v4l2 {
namespace {

using core::FieldTime;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr FieldTime kBegin = seconds(100);
constexpr FieldTime kSpan = milliseconds(20);

StampJudge judge_of(std::int32_t fields, FieldTime exposure = kSpan) {
  StampJudge judge;
  judge.begin({kSpan, exposure, fields}, kBegin);
  return judge;
}

TEST(StampJudge, AStampOfTheEndOfAFrameIsReadoutAndHalfAnExposureLate) {
  StampJudge one = judge_of(1, milliseconds(4));
  StampJudge two = judge_of(2, milliseconds(4));
  const FieldTime stamp = kBegin + seconds(1);

  EXPECT_EQ(one.judge(StampKind::kEndOfFrame, stamp, stamp).mid_exposure,
            stamp - milliseconds(20 + 2));
  EXPECT_EQ(two.judge(StampKind::kEndOfFrame, stamp, stamp).mid_exposure,
            stamp - milliseconds(40 + 2));
}

TEST(StampJudge, AStampOfTheStartOfExposureIsHalfOfItEarly) {
  StampJudge judge = judge_of(2, milliseconds(4));
  const FieldTime stamp = kBegin + seconds(1);

  const auto judged = judge.judge(StampKind::kStartOfExposure, stamp, stamp + milliseconds(45));

  EXPECT_EQ(judged.mid_exposure, stamp + milliseconds(2));
  EXPECT_FALSE(judged.wrong);
  EXPECT_FALSE(judged.by_arrival);
}

TEST(StampJudge, WithoutAStampTheArrivalStandsForTheEndOfTheFrame) {
  StampJudge judge = judge_of(1);
  const FieldTime arrival = kBegin + seconds(1);

  const auto judged = judge.judge(StampKind::kUnknown, seconds(5), arrival);

  EXPECT_TRUE(judged.by_arrival);
  EXPECT_FALSE(judged.wrong);
  EXPECT_EQ(judged.mid_exposure, arrival - milliseconds(20 + 10));
}

TEST(StampJudge, StampsThatCannotBeAreWrong) {
  const FieldTime arrival = kBegin + seconds(10);
  const auto wrong = [&](FieldTime stamp) {
    StampJudge judge = judge_of(1);
    return judge.judge(StampKind::kEndOfFrame, stamp, arrival).wrong;
  };

  EXPECT_TRUE(wrong(FieldTime{0}));
  EXPECT_TRUE(wrong(seconds(1'790'000'000))) << "the calendar's clock";
  EXPECT_TRUE(wrong(arrival + milliseconds(6))) << "of the future";
  EXPECT_TRUE(wrong(arrival - seconds(3))) << "waited longer than buffers do";
  EXPECT_FALSE(wrong(arrival));
  EXPECT_FALSE(wrong(arrival - milliseconds(200)));
}

TEST(StampJudge, APictureFromBeforeTheStreamIsWrong) {
  StampJudge judge = judge_of(1);

  EXPECT_TRUE(
      judge.judge(StampKind::kEndOfFrame, kBegin - milliseconds(1), kBegin + milliseconds(5))
          .wrong);
}

TEST(StampJudge, TimesGoOnGrowingWhereStampsRunBackwards) {
  StampJudge judge = judge_of(2);
  const FieldTime first = kBegin + seconds(1);
  const auto before = judge.judge(StampKind::kEndOfFrame, first, first);
  const FieldTime arrival = first + 2 * kSpan;

  const auto back = judge.judge(StampKind::kEndOfFrame, first - kSpan, arrival);
  const auto same = judge.judge(StampKind::kEndOfFrame, first, arrival);
  const auto next = judge.judge(StampKind::kEndOfFrame, arrival, arrival);

  EXPECT_TRUE(back.wrong);
  EXPECT_TRUE(same.wrong) << "standing still is no time either";
  EXPECT_FALSE(next.wrong);
  EXPECT_GT(back.mid_exposure, before.mid_exposure + kSpan) << "after the second field";
  EXPECT_GT(same.mid_exposure, back.mid_exposure + kSpan);
  EXPECT_GT(next.mid_exposure, same.mid_exposure + kSpan);
}

TEST(StampJudge, ADriverThatIsWrongAllTheTimeIsNotListenedTo) {
  StampJudge judge = judge_of(1);
  FieldTime arrival = kBegin;
  for (int i = 0; i < StampJudge::kMostWrong; ++i) {
    arrival += kSpan;
    EXPECT_TRUE(judge.judge(StampKind::kEndOfFrame, FieldTime{0}, arrival).wrong) << i;
  }
  arrival += kSpan;

  const auto judged = judge.judge(StampKind::kEndOfFrame, FieldTime{0}, arrival);

  EXPECT_FALSE(judged.wrong);
  EXPECT_TRUE(judged.by_arrival);
  EXPECT_EQ(judged.mid_exposure, arrival - kSpan - kSpan / 2);
}

// What a driver holds back for three seconds is the tube of three seconds ago: no number of such
// pictures makes them new ones.
TEST(StampJudge, StampsThatGoOnInThePastAreNeverLeftUnheard) {
  StampJudge judge = judge_of(1);
  FieldTime arrival = kBegin;
  for (int i = 0; i < 500; ++i) {  // at first of before the stream, then of long ago
    arrival += kSpan;
    EXPECT_TRUE(judge.judge(StampKind::kEndOfFrame, arrival - seconds(3), arrival).wrong) << i;
  }
  arrival += kSpan;

  EXPECT_FALSE(judge.judge(StampKind::kEndOfFrame, arrival, arrival).wrong);
}

TEST(StampJudge, ADriverThatIsNotListenedToIsHeardWhenItSaysThatAPictureIsOld) {
  StampJudge judge = judge_of(1);
  FieldTime arrival = kBegin + seconds(10);
  for (int i = 0; i < StampJudge::kMostWrong; ++i) {
    arrival += kSpan;
    static_cast<void>(judge.judge(StampKind::kEndOfFrame, FieldTime{0}, arrival));
  }

  EXPECT_TRUE(judge.judge(StampKind::kEndOfFrame, arrival - seconds(4), arrival + kSpan).wrong);
  EXPECT_FALSE(judge.judge(StampKind::kEndOfFrame, FieldTime{0}, arrival + 2 * kSpan).wrong);
}

TEST(StampJudge, ANewStreamListensAgainAndItsTimesLieBehind) {
  StampJudge judge = judge_of(1);
  FieldTime arrival = kBegin;
  core::FieldTime last{0};
  for (int i = 0; i <= StampJudge::kMostWrong; ++i) {
    arrival += kSpan;
    last = judge.judge(StampKind::kEndOfFrame, FieldTime{0}, arrival).mid_exposure;
  }
  judge.begin({kSpan, kSpan, 1}, arrival);

  const auto judged = judge.judge(StampKind::kEndOfFrame, arrival + kSpan, arrival + kSpan);

  EXPECT_FALSE(judged.by_arrival);
  EXPECT_GT(judged.mid_exposure, last);
}

}  // namespace
}  // namespace tubesight::drivers::v4l2
