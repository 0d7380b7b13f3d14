#include "drivers/aravis/camera_clock.h"

#include <chrono>
#include <random>

#include <gtest/gtest.h>

namespace tubesight::tests {
namespace {

using core::FieldTime;
using drivers::aravis::CameraClock;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = CameraClock::Verdict;

constexpr FieldTime kFrame{16'666'667};
constexpr FieldTime kDelay = milliseconds(12);

/// A camera's clock against ours; pictures come at their frame's time.
class CameraClockTest : public testing::Test {
 protected:
  void SetUp() override { clock_.begin(kFrame); }

  [[nodiscard]] std::uint64_t stamp() const {
    return static_cast<std::uint64_t>(now_.count() + ahead_ns_ +
                                      now_.count() / 1000 * fast_ppb_ / 1'000'000);
  }
  CameraClock::Reading next(FieldTime delay = kDelay) {
    now_ += kFrame;
    return clock_.read(stamp(), now_ + delay);
  }
  void settle() {
    for (int i = 0; i < CameraClock::kSettled; ++i) {
      EXPECT_EQ(next().verdict, Verdict::kSettling);
    }
  }

  void expect_next_after(FieldTime delay) {
    const auto reading = next();
    EXPECT_EQ(reading.time, now_ + delay);
  }

  CameraClock clock_;
  FieldTime now_ = seconds(500);  ///< the instant stamped, by our clock
  std::int64_t ahead_ns_ = 9'000'000'000'000;
  std::int64_t fast_ppb_ = 0;
};

TEST_F(CameraClockTest, PicturesThatWaitedKeepTheirTime) {
  settle();
  expect_next_after(kDelay);
  const auto late = next(kDelay + milliseconds(40));

  EXPECT_EQ(late.verdict, Verdict::kGood);
  EXPECT_EQ(late.time, now_ + kDelay) << "when it would have come without waiting";
}

TEST_F(CameraClockTest, ASmallerDelayIsTakenAtOnce) {
  settle();
  const auto sooner = next(kDelay - milliseconds(3));

  EXPECT_EQ(sooner.verdict, Verdict::kGood);
  EXPECT_EQ(sooner.time, now_ + kDelay - milliseconds(3));
  expect_next_after(kDelay - milliseconds(3));
}

// 100 millionths are 6 ms a minute; delays scatter by 2 ms.
TEST_F(CameraClockTest, DriftIsFollowedEitherWay) {
  for (const std::int64_t fast_ppb : {-100'000, 100'000}) {
    clock_.begin(kFrame);
    fast_ppb_ = fast_ppb;
    std::mt19937 random(5);
    FieldTime worst{0};
    for (int i = 0; i < 60 * 60; ++i) {
      const auto reading = next(kDelay + microseconds(random() % 2000));
      if (i > 600) {
        ASSERT_EQ(reading.verdict, Verdict::kGood) << i;
        worst = std::max(worst, std::chrono::abs(reading.time - (now_ + kDelay)));
      }
    }
    EXPECT_LT(worst, microseconds(300)) << fast_ppb;
  }
}

TEST_F(CameraClockTest, NoStampEverIsArrival) {
  for (int i = 0; i < 5; ++i) {
    now_ += kFrame;
    const auto reading = clock_.read(0, now_);
    EXPECT_EQ(reading.verdict, Verdict::kByArrival);
    EXPECT_EQ(reading.time, now_);
  }
  EXPECT_FALSE(clock_.trusted());
}

TEST_F(CameraClockTest, AZeroAmongStampsIsADoubt) {
  settle();
  ASSERT_EQ(next().verdict, Verdict::kGood);
  EXPECT_EQ(clock_.read(0, now_).verdict, Verdict::kWentBack);
  settle();
  EXPECT_EQ(next().verdict, Verdict::kGood);
}

TEST_F(CameraClockTest, AJumpAheadIsFoundAndSettles) {
  settle();
  ASSERT_EQ(next().verdict, Verdict::kGood);
  ahead_ns_ += 20'000'000;
  EXPECT_EQ(next().verdict, Verdict::kJumped);
  for (int i = 0; i < CameraClock::kSettled - 1; ++i) {
    EXPECT_EQ(next().verdict, Verdict::kSettling);
  }
  const auto reading = next();
  EXPECT_EQ(reading.verdict, Verdict::kGood);
  EXPECT_EQ(reading.time, now_ + kDelay);
}

TEST_F(CameraClockTest, AResetIsFoundAndSettles) {
  settle();
  ASSERT_EQ(next().verdict, Verdict::kGood);
  ahead_ns_ = -now_.count();
  EXPECT_EQ(next().verdict, Verdict::kWentBack);
  settle();
  expect_next_after(kDelay);
}

TEST_F(CameraClockTest, TheSameStampAgainIsADoubt) {
  settle();
  ASSERT_EQ(next().verdict, Verdict::kGood);
  EXPECT_EQ(clock_.read(stamp(), now_ + kFrame).verdict, Verdict::kWentBack);
}

// What a camera still had of its last stream comes at once, each less old than the one before.
TEST_F(CameraClockTest, OldPicturesFirstAreNotBelieved) {
  const FieldTime flushed = now_ + seconds(1);
  for (int i = 0; i < 10; ++i) {
    now_ += kFrame;
    EXPECT_EQ(clock_.read(stamp(), flushed + microseconds(300 * i)).verdict, Verdict::kSettling);
  }
  now_ = flushed;
  EXPECT_EQ(next().verdict, Verdict::kSettling) << "the first fresh one";
  EXPECT_EQ(next().verdict, Verdict::kSettling);
  EXPECT_EQ(next().verdict, Verdict::kSettling);
  const auto reading = next();
  EXPECT_EQ(reading.verdict, Verdict::kGood);
  EXPECT_EQ(reading.time, now_ + kDelay);
}

TEST_F(CameraClockTest, APictureOlderThanAllBuffersHoldIsADoubt) {
  settle();
  EXPECT_EQ(next(kDelay + milliseconds(2100)).verdict, Verdict::kTooOld);
}

TEST_F(CameraClockTest, PicturesThatAllWaitStayTooOldUntilFreshOnesCome) {
  settle();
  for (int i = 0; i < 1200; ++i) {
    EXPECT_EQ(next(kDelay + milliseconds(2100)).verdict, Verdict::kTooOld) << i;
  }
  const auto reading = next();
  EXPECT_EQ(reading.verdict, Verdict::kGood);
  EXPECT_LT(reading.time, now_ + kDelay + milliseconds(1));
}

// A camera with much memory behind a slow network: each picture comes a second and a half late.
TEST_F(CameraClockTest, PicturesThatAllWaitKeepTheirTimes) {
  settle();
  for (int i = 0; i < 1200; ++i) {
    const auto reading =
        next(kDelay + std::min<FieldTime>(i * milliseconds(5), milliseconds(1500)));
    EXPECT_EQ(reading.verdict, Verdict::kGood) << i;
    EXPECT_LT(reading.time, now_ + kDelay + milliseconds(6)) << i;
  }
  for (int i = 0; i < 1200; ++i) {
    const auto reading = next();
    EXPECT_NE(reading.verdict, Verdict::kByArrival) << i;
    EXPECT_LT(reading.time, now_ + kDelay + milliseconds(6)) << i;
  }
}

TEST_F(CameraClockTest, AClockOfAnotherRateIsGivenUp) {
  fast_ppb_ = 1'000'000'000;
  for (int i = 0; i < 600; ++i) {
    static_cast<void>(next());
  }
  EXPECT_EQ(next().verdict, Verdict::kByArrival);
  EXPECT_FALSE(clock_.trusted());
}

// It looks just as pictures that wait longer and longer.
TEST_F(CameraClockTest, ASlowClockIsNeverBelievedToShowThePresent) {
  fast_ppb_ = -20'000'000;
  for (int i = 0; i < 60 * 120; ++i) {
    const auto reading = next();
    EXPECT_NE(reading.verdict, Verdict::kByArrival) << i;
  }
  EXPECT_EQ(next().verdict, Verdict::kTooOld);
}

TEST_F(CameraClockTest, StampsBeyondAllMeasureAreADoubt) {
  settle();
  now_ += kFrame;
  EXPECT_EQ(clock_.read(UINT64_MAX, now_).verdict, Verdict::kJumped);
  settle();
  EXPECT_EQ(clock_.read(INT64_MAX / 2, now_).verdict, Verdict::kJumped);
}

}  // namespace
}  // namespace tubesight::tests
