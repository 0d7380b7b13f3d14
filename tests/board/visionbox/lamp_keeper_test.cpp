#include "board/visionbox/lamp_keeper.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hal/dimmer_contract.h"

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;

/// A lamp whose faults a test sets while it shines.
class FakeLamp final : public LampDevice, public hal::Dimmer {
 public:
  hal::Dimmer& dimmer() override { return *this; }
  const std::string& message() const override { return message_; }

  core::Result<void> start() override {
    if (absent_) {
      return core::Unexpected(core::Error::kIo);
    }
    started_ = true;
    return {};
  }
  void stop() override {
    started_ = false;
    put(-1);
  }
  core::Result<void> set_level(std::int32_t permille) override {
    if (broken_) {
      return core::Unexpected(core::Error::kDisconnected);
    }
    put(permille);
    return {};
  }
  std::int32_t level_permille() const override { return 0; }

  /// Levels so far; -1: stopped.
  std::vector<std::int32_t> levels() {
    const std::lock_guard lock(mutex_);
    return levels_;
  }
  std::int32_t last() {
    const auto all = levels();
    return all.empty() ? 0 : all.back();
  }

  std::atomic<bool> absent_{false};
  std::atomic<bool> broken_{false};
  std::atomic<bool> started_{false};

 private:
  void put(std::int32_t level) {
    const std::lock_guard lock(mutex_);
    levels_.push_back(level);
  }
  std::string message_ = "lamp on x: there is no such chip";
  std::mutex mutex_;
  std::vector<std::int32_t> levels_;
};

class KeeperMaker {
 public:
  hal::Dimmer& dimmer() { return keeper_; }

 private:
  FakeLamp lamp_;
  LampKeeper keeper_{
      lamp_, {milliseconds(0), std::chrono::seconds(0), 1000}, [](const std::string&) {}};
};

}  // namespace
}  // namespace tubesight::board

namespace tubesight::support {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(LampKeeper, DimmerContract, board::KeeperMaker);

}  // namespace
}  // namespace tubesight::support

namespace tubesight::board {
namespace {

class LampKeeperTest : public testing::Test {
 protected:
  template <typename Condition>
  static bool within_two_seconds(Condition condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return condition();
  }
  FakeLamp lamp_;
  std::mutex mutex_;
  std::vector<std::string> told_;
  LampKeeper keeper_{
      lamp_, {milliseconds(100), std::chrono::seconds(0), 1000}, [this](const std::string& line) {
        const std::lock_guard lock(mutex_);
        told_.push_back(line);
      }};
};

TEST_F(LampKeeperTest, LeadsTheLevelUpAndDownAndLeavesTheLampDark) {
  ASSERT_TRUE(keeper_.start());
  ASSERT_TRUE(keeper_.set_level(1000));
  EXPECT_EQ(keeper_.level_permille(), 1000) << "what is wanted";
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 1000; }));
  keeper_.stop();

  const auto levels = lamp_.levels();
  const auto full = std::find(levels.begin(), levels.end(), 1000);
  EXPECT_TRUE(std::is_sorted(levels.begin(), full));
  EXPECT_GT(full - levels.begin(), 2) << "in steps";
  EXPECT_TRUE(std::is_sorted(full, levels.end(), std::greater<>()));
  EXPECT_EQ(*(levels.end() - 2), 0) << "down to the dark, and then it was stopped";
  EXPECT_EQ(levels.back(), -1);
  EXPECT_FALSE(keeper_.report().open);
}

TEST_F(LampKeeperTest, KnowsWhichLightShoneWhen) {
  ASSERT_TRUE(keeper_.start());
  const core::FieldTime before = monotonic_now();
  ASSERT_TRUE(keeper_.set_level(800));
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 800; }));
  const core::FieldTime after = monotonic_now();

  EXPECT_EQ(keeper_.level_permille_at(before), 0);
  const std::int32_t between = keeper_.level_permille_at(before + (after - before) / 2);
  EXPECT_GT(between, 0);
  EXPECT_LE(between, 800);
  EXPECT_EQ(keeper_.level_permille_at(after + std::chrono::hours(1)), 800);
}

TEST_F(LampKeeperTest, ABoxStartsWithoutItsLampAndTakesItWhenItComes) {
  lamp_.absent_ = true;
  ASSERT_TRUE(keeper_.start());
  EXPECT_TRUE(keeper_.set_level(500)) << "the first one is taken in any case";
  ASSERT_TRUE(within_two_seconds([&] { return keeper_.report().failures > 0; }));

  const auto refused = keeper_.set_level(500);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), core::Error::kIo);
  EXPECT_EQ(keeper_.level_permille(), 0);
  EXPECT_FALSE(keeper_.report().open);

  lamp_.absent_ = false;
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 500; }));
  EXPECT_TRUE(keeper_.set_level(500));
  const std::lock_guard lock(mutex_);
  EXPECT_EQ(told_,
            (std::vector<std::string>{"lamp on x: there is no such chip", "lamp: is there again"}));
}

TEST_F(LampKeeperTest, ALampThatGoesIsToldAndOpenedAgain) {
  ASSERT_TRUE(keeper_.start());
  ASSERT_TRUE(keeper_.set_level(500));
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 500; }));
  lamp_.broken_ = true;
  ASSERT_TRUE(keeper_.set_level(600)) << "it is not known yet";
  ASSERT_TRUE(within_two_seconds([&] { return !keeper_.set_level(600); }));
  EXPECT_FALSE(lamp_.started_);

  lamp_.broken_ = false;
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 600; }));
  EXPECT_TRUE(keeper_.set_level(600));
  EXPECT_GE(keeper_.report().failures, 1);
}

TEST_F(LampKeeperTest, ALampThatGoesAtASteadyLevelIsFoundOut) {
  ASSERT_TRUE(keeper_.start());
  ASSERT_TRUE(keeper_.set_level(500));
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 500; }));
  lamp_.absent_ = true;
  lamp_.broken_ = true;

  ASSERT_TRUE(within_two_seconds([&] { return !keeper_.report().open; })) << "nobody sets a level";
  EXPECT_EQ(keeper_.report().level_permille, 0);
  EXPECT_EQ(keeper_.level_permille_at(monotonic_now()), 0) << "nobody knows what shines";
  EXPECT_FALSE(keeper_.set_level(500));
}

TEST_F(LampKeeperTest, NoMoreShinesThanMay) {
  ASSERT_TRUE(keeper_.start());
  ASSERT_TRUE(keeper_.set_level(800));
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 800; }));

  keeper_.set_most(300);
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() == 300; }));
  EXPECT_EQ(keeper_.level_permille(), 800) << "what is wanted is not forgotten";
  keeper_.set_most(1000);
  EXPECT_TRUE(within_two_seconds([&] { return lamp_.last() == 800; }));
}

TEST_F(LampKeeperTest, AnEndInTheMiddleOfALeadGoesDownFromThere) {
  ASSERT_TRUE(keeper_.start());
  ASSERT_TRUE(keeper_.set_level(1000));
  ASSERT_TRUE(within_two_seconds([&] { return lamp_.last() > 200; }));
  keeper_.stop();

  const auto levels = lamp_.levels();
  const auto highest = std::max_element(levels.begin(), levels.end());
  EXPECT_TRUE(std::is_sorted(highest, levels.end(), std::greater<>()));
  EXPECT_EQ(*(levels.end() - 2), 0);
  EXPECT_EQ(levels.back(), -1);
}

// The tracking thread asks for a level with each field, the box for a limit, others for the report,
// and the device comes and goes.
TEST_F(LampKeeperTest, AStormOfLevelsEndsInTheDark) {
  ASSERT_TRUE(keeper_.start());
  std::atomic<bool> ended{false};
  std::thread limits([&] {
    for (int i = 0; !ended; ++i) {
      keeper_.set_most(i % 2 == 0 ? 300 : 1000);
      lamp_.broken_ = i % 50 == 49;
      EXPECT_LE(keeper_.report().level_permille, 1000);
    }
  });
  const MonotonicTime end = monotonic_now() + milliseconds(300);
  for (int i = 0; monotonic_now() < end; ++i) {
    static_cast<void>(keeper_.set_level(i % 3 * 500));
    const std::int32_t level = keeper_.level_permille_at(monotonic_now() - milliseconds(i % 40));
    EXPECT_TRUE(level >= 0 && level <= 1000);
  }
  ended = true;
  limits.join();
  lamp_.broken_ = false;
  keeper_.stop();

  EXPECT_LE(lamp_.last(), 0) << "dark, or stopped";
  EXPECT_FALSE(lamp_.started_);
}

TEST_F(LampKeeperTest, MakingDarkIsAStartAndAStop) {
  EXPECT_EQ(make_dark(lamp_), "");
  EXPECT_EQ(lamp_.levels(), (std::vector<std::int32_t>{-1}));
  lamp_.absent_ = true;
  EXPECT_EQ(make_dark(lamp_), "lamp on x: there is no such chip");
}

}  // namespace
}  // namespace tubesight::board
