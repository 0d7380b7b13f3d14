#include "board/visionbox/supervisor.h"

#include <cerrno>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/fake_watchdog_kernel.h"
#include "tests/support/notify_socket.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A box whose parts come round as the test says, looked at five times a second of its own.
class SupervisorTest : public testing::Test {
 protected:
  /// Looks for so long; the parts come round, but those that are stuck.
  void pass(MonotonicTime time) {
    const MonotonicTime until = now_ + time;
    for (; now_ < until; now_ += milliseconds(200)) {
      if (!stuck_) {
        ++beats_[static_cast<std::size_t>(Part::kTracking)];
      }
      supervisor_.beat();
      supervisor_.look(now_);
    }
  }

  /// Times that the hardware was fed so far.
  [[nodiscard]] int meals() const {
    int count = 0;
    for (std::size_t at = kernel_.calls.find("feed;"); at != std::string::npos;
         at = kernel_.calls.find("feed;", at + 1)) {
      ++count;
    }
    return count;
  }

  /// Times that the service manager was fed since it was asked last.
  [[nodiscard]] int heard() const {
    int count = 0;
    while (socket_.next(milliseconds(0)) == "WATCHDOG=1") {
      ++count;
    }
    return count;
  }

  support::TemporaryFolder folder_;
  support::NotifySocket socket_{folder_.path("notify")};
  support::FakeWatchdogKernel kernel_;
  WatchdogSettings settings_{"/dev/watchdog", 15};
  std::vector<std::string> told_;
  ServiceManager manager_{{socket_.name(), seconds(5), {}},
                          [this](const std::string& line) { told_.push_back(line); }};
  Beats beats_{0, -1, -1, -1};
  bool stuck_ = false;
  MonotonicTime now_ = std::chrono::hours(1);
  std::unique_ptr<Supervisor> made_ = std::make_unique<Supervisor>(
      [this] { return beats_; }, settings_, manager_,
      [this](const std::string& line) { told_.push_back(line); }, kernel_);
  Supervisor& supervisor_ = *made_;
};

TEST_F(SupervisorTest, FeedsBothWhileThePartsComeRound) {
  pass(seconds(10));

  EXPECT_EQ(meals(), 49) << "at each look, behind the one that armed it";
  EXPECT_EQ(heard(), 10) << "once a second is enough";
  const SupervisionReport report = supervisor_.report();
  EXPECT_TRUE(report.armed);
  EXPECT_EQ(report.timeout_s, 15);
  EXPECT_EQ(report.manager_ms, 5000);
  EXPECT_EQ(report.trouble, "");
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_EQ(told_[0],
            "watchdog: /dev/watchdog (fake) resets the machine 15 s after the box stands still");
}

TEST_F(SupervisorTest, LetsBothStarveWhenAPartStandsStillAndFeedsAgainWhenItComesBack) {
  pass(seconds(2));
  stuck_ = true;
  pass(seconds(4));
  const int before = meals();
  static_cast<void>(heard());

  pass(seconds(10));

  EXPECT_EQ(meals(), before);
  EXPECT_EQ(heard(), 0);
  EXPECT_EQ(supervisor_.report().stuck, "the tracking");
  EXPECT_EQ(told_.back(), "supervision: stands still: the tracking; the watchdogs are not fed");
  stuck_ = false;
  pass(seconds(1));
  EXPECT_GT(meals(), before);
  EXPECT_EQ(heard(), 1);
  EXPECT_EQ(told_.back(), "supervision: every part comes round again, the watchdogs are fed");
}

TEST_F(SupervisorTest, ACleanStopIsFedForHalfAMinuteAndDisarms) {
  pass(seconds(1));
  supervisor_.begin_to_stop();
  const int before = meals();
  supervisor_.look(monotonic_now() + seconds(29));
  EXPECT_EQ(meals(), before + 1) << "the parts may have ended";
  supervisor_.look(monotonic_now() + seconds(31));
  EXPECT_EQ(meals(), before + 1) << "an end that does not come";
  EXPECT_TRUE(kernel_.armed);

  supervisor_.stop();

  EXPECT_FALSE(kernel_.armed);
  EXPECT_FALSE(supervisor_.report().armed);
}

TEST_F(SupervisorTest, AnEndWithoutAStopLeavesTheHardwareArmed) {
  pass(seconds(1));

  made_.reset();

  EXPECT_TRUE(kernel_.armed) << "an exception is no clean stop";
}

TEST_F(SupervisorTest, AHardwareThatCannotBeHadIsToldOnceAndTriedEachSecond) {
  kernel_.open_status = -EBUSY;
  pass(seconds(5));
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_TRUE(told_[0].starts_with("watchdog: /dev/watchdog: is in use by another program"))
      << told_[0];
  EXPECT_TRUE(told_[0].ends_with("; the box goes on without it and tries again")) << told_[0];
  EXPECT_FALSE(supervisor_.report().armed);
  EXPECT_FALSE(supervisor_.report().trouble.empty());
  EXPECT_EQ(heard(), 5) << "the service manager is fed all the same";
  kernel_.open_status = 0;

  pass(seconds(2));

  EXPECT_TRUE(supervisor_.report().armed);
  EXPECT_EQ(supervisor_.report().trouble, "");
}

TEST_F(SupervisorTest, AHardwareThatGoesIsOpenedAgain) {
  pass(seconds(1));
  kernel_.feed_status = -ENODEV;
  pass(milliseconds(200));
  EXPECT_EQ(supervisor_.report().trouble, "/dev/watchdog: cannot be fed: No such device");
  EXPECT_FALSE(supervisor_.report().armed);
  kernel_.feed_status = 0;

  pass(seconds(2));

  EXPECT_TRUE(supervisor_.report().armed);
}

}  // namespace
}  // namespace tubesight::board
