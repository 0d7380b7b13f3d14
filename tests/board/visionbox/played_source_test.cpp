#include "board/visionbox/played_source.h"

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::Error;
using core::FieldTime;
using core::Result;
using std::chrono::milliseconds;

constexpr std::int32_t kSide = 8;
constexpr FieldTime kSpan = milliseconds(5);

/// Plays fields 5 ms apart, each grey as its place in the pass, with an event before the third.
class FakePlayer final : public FieldPlayer {
 public:
  Result<void> start(drivers::Messages& messages) override {
    if (fail_starts_ > 0) {
      --fail_starts_;
      messages.push_back("no such thing");
      return core::Unexpected(Error::kIo);
    }
    next_ = 0;
    return {};
  }
  void stop() override {}
  Result<void> next(std::int32_t lamp_permille, PlayedField& out, drivers::Messages&) override {
    if (next_ == fields_) {
      return core::Unexpected(end_);
    }
    if (next_ == slow_) {
      sleep_until(monotonic_now() + 8 * kSpan);
    }
    pixels_.fill(static_cast<std::uint8_t>(next_));
    out.field = {};
    out.field.pixels = {pixels_.data(), kSide, kSide, kSide, 0, 1};
    out.field.sequence = 100 + next_;
    out.field.number = 2 * next_;
    out.field.mid_exposure = milliseconds(7) + next_ * kSpan;
    out.field.lamp_permille = lamp_permille;
    out.events.clear();
    if (next_ == 2) {
      core::Event event;
      event.id = 77;
      event.content = core::Start{};
      EXPECT_TRUE(out.events.try_push_back(event));
    }
    ++next_;
    return {};
  }
  FieldTime span() const override { return kSpan; }
  bool has_lamp() const override { return true; }
  std::int32_t fields_ahead() const override { return 2; }

  int fields_ = 5;
  int fail_starts_ = 0;
  int slow_ = -1;  ///< one that takes long to make
  Error end_ = Error::kEndOfData;

 private:
  int next_ = 0;
  std::array<std::uint8_t, kSide * kSide> pixels_{};
};

class PlayedSourceTest : public ::testing::Test {
 protected:
  PlayedSource& make(bool loop) {
    PlayedSourceSettings settings;
    settings.loop = loop;
    settings.width_px = kSide;
    settings.height_px = kSide;
    settings.first_wait = milliseconds(20);
    settings.in_real_time = in_real_time_;
    source_ = std::make_unique<PlayedSource>(player_, settings, [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      told_.push_back(line);
    });
    return *source_;
  }

  /// The next field, over time-outs; a copy without pixels, with the first one's grey.
  bool grab(core::Field& field, std::uint8_t& grey) {
    for (int i = 0; i < 100; ++i) {
      const auto lease = source_->grab_for(milliseconds(50));
      if (lease) {
        field = lease->field();
        grey = field.pixels.pixels[0];
        return true;
      }
      if (lease.error() != Error::kTimeout) {
        return false;
      }
    }
    return false;
  }

  FakePlayer player_;
  bool in_real_time_ = true;
  std::mutex mutex_;
  std::vector<std::string> told_;
  std::unique_ptr<PlayedSource> source_;
};

TEST_F(PlayedSourceTest, DeliversEachFieldAtItsInstant) {
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  for (int i = 0; i < 5; ++i) {
    core::Field field;
    std::uint8_t grey = 0;
    ASSERT_TRUE(grab(field, grey));

    EXPECT_EQ(grey, i);
    EXPECT_EQ(field.mid_exposure, milliseconds(7) + i * kSpan) << "the recording's own time";
    EXPECT_EQ(field.sequence, 100 + i);
    EXPECT_GE(source.clock().now(), field.mid_exposure);
    EXPECT_LT(source.clock().now(), field.mid_exposure + std::chrono::seconds(1));
    EXPECT_GE(source.handed_over(), source.due());
  }
  EXPECT_EQ(source.delivered(), 5);
}

TEST_F(PlayedSourceTest, IsGoneWhenItEnded) {
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 0;
  while (grab(field, grey)) {
  }

  EXPECT_EQ(grey, 4);
  const auto lease = source.grab_for(milliseconds(5));
  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), Error::kDisconnected);
  EXPECT_EQ(source.state(), SourceState::kEnded);
}

TEST_F(PlayedSourceTest, BeginsAnewAfterAGapThatNoTrackOutlives) {
  PlayedSource& source = make(true);
  ASSERT_TRUE(source.start());
  core::Field last;
  core::Field first;
  std::uint8_t grey = 0;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(grab(last, grey));
  }
  ASSERT_TRUE(grab(first, grey));

  EXPECT_EQ(grey, 0);
  EXPECT_GE(first.mid_exposure - last.mid_exposure, std::chrono::seconds(1));
  EXPECT_GT(first.sequence, last.sequence + 10);
  EXPECT_EQ(source.passes(), 2);
  EXPECT_EQ(source.failures(), 0);
}

TEST_F(PlayedSourceTest, CountsTheFieldsThatItMadeTooLate) {
  player_.fields_ = 40;
  player_.slow_ = 30;
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 0;
  std::int64_t before = 0;
  for (int i = 0; i < 40; ++i) {
    before = i == 28 ? source.made_late() : before;
    ASSERT_TRUE(grab(field, grey));
  }

  EXPECT_GE(source.made_late() - before, 1);
  EXPECT_LT(before, 28) << "not all of them";
}

TEST_F(PlayedSourceTest, OutOfRealTimeTimeStandsStillForALateField) {
  in_real_time_ = false;
  player_.slow_ = 3;
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  const MonotonicTime begin = monotonic_now();
  for (int i = 0; i < 5; ++i) {
    const auto lease = source.grab_for(milliseconds(10));
    ASSERT_TRUE(lease) << i << " timed out";
    EXPECT_EQ(lease->field().sequence, 100 + i);
    EXPECT_LT(source.clock().now(), lease->field().mid_exposure + 6 * kSpan);
  }
  EXPECT_GE(monotonic_now() - begin, 8 * kSpan);
}

TEST_F(PlayedSourceTest, OpensAgainWhatFailedAndCountsIt) {
  player_.fail_starts_ = 2;
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 9;
  bool came = false;
  for (int i = 0; i < 200 && !came; ++i) {
    came = grab(field, grey);
    sleep_until(monotonic_now() + milliseconds(5));
  }

  EXPECT_TRUE(came);
  EXPECT_EQ(grey, 0);
  EXPECT_EQ(source.failures(), 2);
  const std::lock_guard lock(mutex_);
  ASSERT_FALSE(told_.empty());
  EXPECT_EQ(told_.front(), "no such thing");
}

TEST_F(PlayedSourceTest, OpensAgainWhatBrokeInTheMiddle) {
  player_.end_ = Error::kDataLoss;
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  std::vector<int> greys;
  for (int i = 0; i < 2000 && greys.size() < 7; ++i) {
    core::Field field;
    std::uint8_t grey = 0;
    if (grab(field, grey)) {
      greys.push_back(grey);
    } else {
      sleep_until(monotonic_now() + milliseconds(5));
    }
  }

  EXPECT_EQ(greys, (std::vector<int>{0, 1, 2, 3, 4, 0, 1}));
  EXPECT_EQ(source.failures(), 1);
}

TEST_F(PlayedSourceTest, HandsOutWhatIsSaidWithItsField) {
  PlayedSource& source = make(false);
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 0;
  ASSERT_TRUE(grab(field, grey));
  ASSERT_TRUE(grab(field, grey));
  EXPECT_EQ(source.next_said(), nullptr);
  ASSERT_TRUE(grab(field, grey));

  ASSERT_NE(source.next_said(), nullptr);
  EXPECT_EQ(source.next_said()->id, 77);
  EXPECT_EQ(source.next_said()->at, field.mid_exposure);
  source.take_said();
  EXPECT_EQ(source.next_said(), nullptr);
}

TEST_F(PlayedSourceTest, AScriptInsistsOnItsStartInLaterPassesAsTheToolIsSuddenlyElsewhere) {
  PlayedSource& source = make(true);
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 0;
  for (const bool confirmed : {false, true, true}) {
    while (source.next_said() == nullptr) {
      ASSERT_TRUE(grab(field, grey));
    }
    EXPECT_EQ(std::get<core::Start>(source.next_said()->content).confirmed, confirmed);
    source.take_said();
  }
}

TEST_F(PlayedSourceTest, ExposesInTheDimmersLight) {
  player_.fields_ = 50;
  PlayedSource& source = make(false);
  PlayedDimmer dimmer(source);
  ASSERT_TRUE(dimmer.start());
  ASSERT_TRUE(dimmer.set_level(300));
  ASSERT_TRUE(source.start());
  core::Field field;
  std::uint8_t grey = 0;
  ASSERT_TRUE(grab(field, grey));
  EXPECT_EQ(field.lamp_permille, 300);
  ASSERT_TRUE(dimmer.set_level(800));
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(grab(field, grey));
  }

  EXPECT_EQ(field.lamp_permille, 800) << "after those that were made ahead";
}

TEST_F(PlayedSourceTest, StopsWhileTheTrackingWaits) {
  PlayedSource& source = make(true);
  ASSERT_TRUE(source.start());
  source.stop();
  source.stop();

  const auto lease = source.grab_for(milliseconds(1));

  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), Error::kNotReady);
}

}  // namespace
}  // namespace tubesight::board
