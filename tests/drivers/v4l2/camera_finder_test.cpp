#include "drivers/v4l2/camera_finder.h"

#include <cerrno>

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using drivers::V4l2Settings;

TEST(CameraFinder, ListsWhatSettingsCanName) {
  FakeKernel kernel;
  auto grabber = std::make_shared<FakeCamera>();
  grabber->formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_GREY};
  grabber->inputs = {{"S-Video", 0, V4L2_STD_ALL}};
  grabber->standard = V4L2_STD_PAL;
  grabber->controls.resize(1);
  grabber->controls[0].name = "Gain";
  auto other = std::make_shared<FakeCamera>();
  other->serial = "12";
  auto no_camera = std::make_shared<FakeCamera>();
  no_camera->caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  kernel.plug(0, grabber);
  kernel.plug(1, no_camera);
  kernel.plug(2, other);
  kernel.link("/dev/v4l/by-path/pci-0", "/dev/video0");

  const auto cameras = drivers::v4l2::list_cameras(kernel);

  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name(), "/dev/v4l/by-path/pci-0");
  EXPECT_EQ(cameras[0].formats, (std::vector<std::string>{"MJPG (not taken)", "GREY"}));
  EXPECT_EQ(cameras[0].inputs, (std::vector<std::string>{"S-Video"}));
  EXPECT_EQ(cameras[0].standards, (std::vector<std::string>{"NTSC", "PAL"}));
  EXPECT_EQ(cameras[0].standard, "PAL");
  EXPECT_EQ(cameras[0].controls, std::vector<std::string>{"Gain"});
  EXPECT_EQ(cameras[1].standard, "");
  EXPECT_EQ(cameras[0].card, "Grabber");
  EXPECT_EQ(cameras[1].name(), "serial:12");
  EXPECT_EQ(kernel.open_devices(), 0);
}

TEST(CameraFinder, ACameraThatABoxHasIsListedAsTaken) {
  CameraBench bench;
  EXPECT_FALSE(drivers::v4l2::list_cameras(bench.kernel())[0].taken);
  ASSERT_TRUE(bench.grabber().start());

  EXPECT_TRUE(drivers::v4l2::list_cameras(bench.kernel())[0].taken);
  EXPECT_TRUE(bench.good_within(1)) << "nothing was changed";
}

// Below by-id two of a model without numbers have one name, and it leads to either.
TEST(CameraFinder, ANameByIdOfTwoCamerasNamesNeither) {
  V4l2Settings settings = settings_of();
  settings.device = "/dev/v4l/by-id/usb-Grabber-video-index0";
  CameraBench bench(settings);
  bench.kernel().link(settings.device, "/dev/video0");
  const auto other = bench.kernel().plug(1, std::make_shared<FakeCamera>());
  other->bus = "usb-2";

  ASSERT_FALSE(bench.grabber().start());
  EXPECT_EQ(bench.message(), "camera " + settings.device + ": is there more than once (" + kByPath +
                                 ", bus:usb-2), expected one: name it by its place");

  other->card = "Another";
  EXPECT_TRUE(bench.grabber().start()) << bench.message();
}

TEST(CameraFinder, ACameraOfAnotherUserSaysWhoMayHaveIt) {
  CameraBench bench;
  bench.camera().opening = -EACCES;
  ASSERT_FALSE(bench.grabber().start());
  EXPECT_EQ(bench.message(), std::string("camera ") + kByPath +
                                 ": cannot be opened: Permission denied, expected a user of the "
                                 "group video");
  const auto listed = drivers::v4l2::list_cameras(bench.kernel());
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0].refused, "Permission denied, expected a user of the group video");

  bench.camera().opening = 0;
  EXPECT_TRUE(bench.grabber().start());
}

TEST(CameraFinder, FindsADeviceByWhatStays) {
  FakeKernel kernel;
  auto first = std::make_shared<FakeCamera>();
  auto second = std::make_shared<FakeCamera>();
  second->bus = "usb-2";
  second->serial = "12";
  kernel.plug(4, first);
  kernel.plug(7, second);

  const std::vector<std::string> seventh{"/dev/video7"};
  EXPECT_EQ(drivers::v4l2::find_cameras(kernel, "bus:usb-2"), seventh);
  EXPECT_EQ(drivers::v4l2::find_cameras(kernel, "serial:12"), seventh);
  for (const std::string none : {"serial:13", "bus:usb-3", "/dev/v4l/by-path/none"}) {
    EXPECT_TRUE(drivers::v4l2::find_cameras(kernel, none).empty()) << none;
  }
}

// Makers of webcams give all of them one number.
TEST(CameraFinder, ANumberOfTwoCamerasNamesNeither) {
  V4l2Settings settings = settings_of();
  settings.device = "serial:2009";
  CameraBench bench(settings);
  bench.camera().serial = "2009";
  const auto other = bench.kernel().plug(10, std::make_shared<FakeCamera>());
  other->serial = "2009";
  other->bus = "usb-2";

  const auto started = bench.grabber().start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kUnsupported);
  EXPECT_EQ(bench.message(), std::string("camera serial:2009: is there more than once (") +
                                 kByPath + ", bus:usb-2), expected one: name it by its place");
  EXPECT_EQ(bench.kernel().open_devices(), 0);
  const auto listed = drivers::v4l2::list_cameras(bench.kernel());
  ASSERT_EQ(listed.size(), 2U);
  EXPECT_EQ(listed[0].name(), kByPath) << "and not by its number";
  EXPECT_EQ(listed[1].name(), "bus:usb-2");

  bench.kernel().unplug(10);
  EXPECT_TRUE(bench.grabber().start()) << bench.message();
}

}  // namespace
}  // namespace tubesight::tests
