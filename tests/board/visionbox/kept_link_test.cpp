#include "board/visionbox/kept_link.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const tests::Bytes kReadMark{3, 0, 2, 0, 2};
const tests::Bytes kMark{3, 4, 1, 2, 3, 4};

/// A link by a device that is not there until the test plugs it in.
class KeptLinkTest : public ::testing::Test {
 protected:
  drivers::ModbusSettings settings() {
    drivers::ModbusSettings settings;
    settings.serial.line.device = folder_.path("line");
    settings.serial.unit = 17;
    return settings;
  }
  void plug_in() { std::filesystem::create_symlink(line_.device(), folder_.path("line")); }
  /// Looks after the link until this is so.
  bool comes(const std::function<bool()>& so) {
    const MonotonicTime until = monotonic_now() + seconds(10);
    while (!so() && monotonic_now() < until) {
      std::this_thread::sleep_for(milliseconds(5));
      link_.look_after(monotonic_now());
    }
    return so();
  }

  support::TemporaryFolder folder_;
  tests::Pty line_;
  tests::SteadyClock clock_;
  std::vector<std::string> told_;
  KeptLink link_{settings(), tests::make_identity(), clock_, KeptLink::Rank::kLikeOthers,
                 [this](const std::string& line) { told_.push_back(line); }};
};

TEST_F(KeptLinkTest, StartsWithoutALineAndTellsItOnce) {
  ASSERT_TRUE(link_.start());
  const MonotonicTime now = monotonic_now();
  for (int i = 1; i < 5; ++i) {
    link_.look_after(now + i * seconds(2));
  }

  EXPECT_FALSE(link_.start()) << "started already";
  EXPECT_FALSE(link_.report().open);
  EXPECT_EQ(link_.poll_event().error(), core::Error::kDisconnected);
  EXPECT_EQ(link_.send_sighting({}).error(), core::Error::kDisconnected);
  EXPECT_EQ(link_.send_reply({}).error(), core::Error::kDisconnected);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_EQ(told_[0], "link: cannot be opened: " + folder_.path("line") +
                          ": No such file or directory; the box goes on without a robot and tries "
                          "again");
}

TEST_F(KeptLinkTest, ServesTheRobotOnceTheLineIsThere) {
  ASSERT_TRUE(link_.start());
  plug_in();

  ASSERT_TRUE(comes([this] { return link_.report().open; }));

  EXPECT_TRUE(link_.poll_event());
  EXPECT_EQ(tests::ask(line_, kReadMark), kMark);
  EXPECT_TRUE(comes([this] { return link_.report().counters.answers == 1; }));
  EXPECT_EQ(told_.back(), "link: open: " + folder_.path("line"));
}

TEST_F(KeptLinkTest, TellsThatALineIsGone) {
  plug_in();
  ASSERT_TRUE(link_.start());
  ASSERT_TRUE(link_.report().open);

  line_.unplug();

  EXPECT_TRUE(comes([this] { return !link_.report().open; }));
  EXPECT_TRUE(comes([this] { return told_.size() == 2; }));
  EXPECT_EQ(told_.back(), "link: the line is gone, to be opened again");
}

TEST_F(KeptLinkTest, CanBeStoppedAndStarted) {
  plug_in();
  ASSERT_TRUE(link_.start());
  link_.stop();
  EXPECT_EQ(link_.poll_event().error(), core::Error::kDisconnected);

  ASSERT_TRUE(link_.start());
  EXPECT_EQ(tests::ask(line_, kReadMark), kMark);
}

TEST_F(KeptLinkTest, ShowsTheRobotHowTheBoxIsDoing) {
  plug_in();
  ASSERT_TRUE(link_.start());
  drivers::LinkHealth health;
  health.camera = drivers::Health::kWell;
  health.fields = 3;
  health.fields_missing = 0;
  health.fields_late = 0;
  link_.set_health(health);

  // health_valid: camera and counters; camera_health: well.
  EXPECT_EQ(tests::ask(line_, {3, 0x01, 0xF4, 0, 2}), (tests::Bytes{3, 4, 0, 17, 0, 1}));
}

}  // namespace
}  // namespace tubesight::board
