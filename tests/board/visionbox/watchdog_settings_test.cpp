#include "board/visionbox/watchdog_settings.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/board/visionbox/box_settings_bench.h"

namespace tubesight::board {
namespace {

TEST_F(BoxSettingsTest, AWatchdogIsAPathAndATime) {
  ASSERT_TRUE(load(kSource));
  EXPECT_FALSE(box_->watchdog.wanted());
  ASSERT_TRUE(load(std::string(kSource) + "[watchdog]\ndevice = \"/dev/watchdog\"\n"));
  EXPECT_EQ(box_->watchdog.device, "/dev/watchdog");
  EXPECT_EQ(box_->watchdog.timeout_s, 15);
  for (const int timeout_s : {10, 3600}) {
    ASSERT_TRUE(load(std::string(kSource) + "[watchdog]\ndevice = \"/dev/watchdog1\"\n" +
                     "timeout_s = " + std::to_string(timeout_s) + "\n"));
    EXPECT_EQ(box_->watchdog.timeout_s, timeout_s);
  }

  EXPECT_FALSE(load(std::string(kSource) + "[watchdog]\ndevice = \"watchdog\"\ntimeout_s = 9\n"));
  EXPECT_TRUE(
      told("watchdog.device: 'watchdog', expected a path from the root: "
           "\"/dev/watchdog\""));
  EXPECT_TRUE(told("watchdog.timeout_s: 9, expected")) << messages_.back();
  EXPECT_FALSE(load(std::string(kSource) + "[watchdog]\ntimeout_s = 15\n"));
  EXPECT_TRUE(told("watchdog.device: missing"));
}

}  // namespace
}  // namespace tubesight::board
