// A watchdog of the kernel on a faked kernel: what is asked of it, in which order.

#include "drivers/watchdog/device_watchdog.h"

#include <cerrno>
#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "tests/hal/watchdog_contract.h"
#include "tests/support/fake_watchdog_kernel.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using std::chrono::seconds;

class DeviceMaker {
 public:
  hal::Watchdog& watchdog() { return watchdog_; }

 private:
  support::FakeWatchdogKernel kernel_;
  DeviceWatchdog watchdog_{"/dev/watchdog", kernel_};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {
INSTANTIATE_TYPED_TEST_SUITE_P(Device, WatchdogContract, drivers::DeviceMaker);
}  // namespace tubesight::support

namespace tubesight::drivers {
namespace {

TEST(DeviceWatchdog, DisarmsByTheMagicCharacterOnACleanStop) {
  support::FakeWatchdogKernel kernel;
  DeviceWatchdog watchdog("/dev/watchdog", kernel);
  ASSERT_TRUE(watchdog.start(seconds(15)));
  EXPECT_TRUE(kernel.armed);
  ASSERT_TRUE(watchdog.feed());

  watchdog.stop();

  EXPECT_FALSE(kernel.armed);
  EXPECT_EQ(kernel.calls, "open /dev/watchdog;timeout 15;feed;write V;close;");
  EXPECT_EQ(watchdog.name(), "fake");
  EXPECT_EQ(watchdog.note(), "");
}

TEST(DeviceWatchdog, StaysArmedWhereNobodyStopsIt) {
  support::FakeWatchdogKernel kernel;
  {
    DeviceWatchdog watchdog("/dev/watchdog", kernel);
    ASSERT_TRUE(watchdog.start(seconds(15)));
  }

  EXPECT_TRUE(kernel.armed) << "as after the death of the program";
  EXPECT_EQ(kernel.calls, "open /dev/watchdog;timeout 15;close;");
}

TEST(DeviceWatchdog, SaysWhyItCannotBeHad) {
  const auto why = [](int status) {
    support::FakeWatchdogKernel kernel;
    kernel.open_status = status;
    DeviceWatchdog watchdog("/dev/watchdog", kernel);
    EXPECT_EQ(watchdog.start(seconds(15)).error(), core::Error::kIo);
    EXPECT_FALSE(watchdog.feed());
    return watchdog.message();
  };
  EXPECT_EQ(why(-ENOENT),
            "/dev/watchdog: is not there: its driver is not loaded, or this machine has none "
            "(softdog stands in)");
  EXPECT_EQ(why(-EBUSY),
            "/dev/watchdog: is in use by another program, expected one owner (RuntimeWatchdogSec= "
            "of systemd takes it, too)");
  EXPECT_EQ(why(-EACCES),
            "/dev/watchdog: may not be opened by this user, expected a udev rule that lets it");
  EXPECT_EQ(why(-EIO), "/dev/watchdog: cannot be opened: Input/output error");
}

TEST(DeviceWatchdog, DisarmsWhatItCannotUse) {
  support::FakeWatchdogKernel kernel;
  kernel.timeout_status = -EINVAL;
  DeviceWatchdog watchdog("/dev/watchdog", kernel);

  EXPECT_EQ(watchdog.start(seconds(60)).error(), core::Error::kOutOfRange);

  EXPECT_FALSE(kernel.armed) << "nobody would feed it";
  EXPECT_EQ(watchdog.message(),
            "/dev/watchdog: refuses 60 s: Invalid argument, expected less: many take 15 s at most");
  kernel.timeout_status = 0;
  kernel.abilities_status = -ENOTTY;
  EXPECT_EQ(watchdog.start(seconds(15)).error(), core::Error::kIo);
  EXPECT_EQ(watchdog.message(), "/dev/watchdog: is no watchdog: Inappropriate ioctl for device");
}

TEST(DeviceWatchdog, TellsWhatTheHardwareDoesInstead) {
  support::FakeWatchdogKernel kernel;
  kernel.most_s = 10;
  kernel.stopped = false;
  DeviceWatchdog watchdog("/dev/watchdog", kernel);

  ASSERT_TRUE(watchdog.start(seconds(15)));

  EXPECT_EQ(watchdog.timeout(), seconds(10));
  EXPECT_EQ(watchdog.note(),
            "/dev/watchdog: takes 10 s for 15 s; cannot be ended: the machine resets after the box "
            "has stopped");
  watchdog.stop();
  kernel.timed = false;
  ASSERT_TRUE(watchdog.start(seconds(15)));
  EXPECT_TRUE(watchdog.note().starts_with("/dev/watchdog: takes no time-out and keeps its own"));
}

TEST(DeviceWatchdog, IsToldGoneWhenItCannotBeFedAndComesBack) {
  support::FakeWatchdogKernel kernel;
  DeviceWatchdog watchdog("/dev/watchdog", kernel);
  ASSERT_TRUE(watchdog.start(seconds(15)));
  kernel.feed_status = -ENODEV;

  EXPECT_EQ(watchdog.feed().error(), core::Error::kDisconnected);

  EXPECT_EQ(watchdog.message(), "/dev/watchdog: cannot be fed: No such device");
  watchdog.stop();
  kernel.feed_status = 0;
  ASSERT_TRUE(watchdog.start(seconds(15)));
  EXPECT_TRUE(watchdog.feed());
}

TEST(DeviceWatchdog, TheSystemsOwnKernelRefusesWhatIsNoWatchdog) {
  const support::TemporaryFolder folder;
  DeviceWatchdog none(folder.path("watchdog"));
  EXPECT_EQ(none.start(seconds(15)).error(), core::Error::kIo);
  EXPECT_NE(none.message().find("is not there"), std::string::npos) << none.message();

  DeviceWatchdog file(folder.write("file", "not a device"));
  EXPECT_EQ(file.start(seconds(15)).error(), core::Error::kIo);
  EXPECT_NE(file.message().find("is no watchdog"), std::string::npos) << file.message();
  EXPECT_EQ(folder.read("file"), "not a device") << "nothing was written to it";
}

}  // namespace
}  // namespace tubesight::drivers
