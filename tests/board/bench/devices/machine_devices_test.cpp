#include "board/bench/devices/machine_devices.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(MachineDevices, NetworkCamerasAreListedByAddressAndThoseOfUsbByNumber) {
  EXPECT_EQ(network_cameras_text({{"21877", "192.168.1.20", "Maker Model", "GigEVision"},
                                  {"", "192.168.1.21", "Maker Other", "GigEVision"},
                                  {"A-3", "USB3", "Maker Third", "USB3Vision"}}),
            "network cameras, by the device to write into [source] of kind \"aravis\":\n"
            "  address:192.168.1.20\n"
            "      Maker Model, GigEVision\n"
            "      also serial:21877\n"
            "      calibration: serial = \"21877\", model = \"Maker Model\"\n"
            "  address:192.168.1.21\n"
            "      Maker Other, GigEVision\n"
            "      says no serial number\n"
            "      calibration: model = \"Maker Other\"\n"
            "  serial:A-3\n"
            "      Maker Third, USB3Vision\n"
            "      calibration: serial = \"A-3\", model = \"Maker Third\"\n");
  EXPECT_EQ(network_cameras_text({}), "no network cameras\n");
}

TEST(MachineDevices, ACameraIsListedByWhatStaysWithWhatItOffers) {
  drivers::v4l2::CameraInfo grabber;
  grabber.node = "/dev/video0";
  grabber.by_path = "/dev/v4l/by-path/pci-0";
  grabber.bus = "usb-1";
  grabber.card = "Grabber";
  grabber.driver = "em28xx";
  grabber.inputs = {"Composite", "S-Video"};
  grabber.standards = {"NTSC", "PAL"};
  grabber.standard = "PAL";
  grabber.taken = true;
  grabber.controls = {"Brightness", "Contrast"};
  grabber.formats = {"YUYV 720 x 480", "MJPG 720 x 480 (not taken)"};
  drivers::v4l2::CameraInfo usb = grabber;
  usb.node = "/dev/video2";
  usb.serial = "4711";
  usb.taken = false;
  usb.inputs.clear();
  usb.standards.clear();
  usb.controls.clear();
  usb.formats.clear();
  drivers::v4l2::CameraInfo busy;
  busy.node = "/dev/video4";
  busy.by_id = "/dev/v4l/by-id/c";
  busy.refused = "Permission denied";
  drivers::v4l2::CameraInfo twin = usb;
  twin.alone = false;

  EXPECT_EQ(cameras_text({grabber, usb, busy, twin}),
            "cameras, by the device to write into [source] of kind \"v4l2\":\n"
            "  /dev/v4l/by-path/pci-0\n"
            "      /dev/video0, Grabber, driver em28xx, bus:usb-1\n"
            "      busy: another program takes its pictures\n"
            "      says no serial number\n"
            "      calibration: model = \"em28xx Grabber\"\n"
            "      inputs: Composite, S-Video\n"
            "      standards: NTSC, PAL; set to PAL\n"
            "      YUYV 720 x 480\n"
            "      MJPG 720 x 480 (not taken)\n"
            "      controls: Brightness, Contrast\n"
            "  serial:4711\n"
            "      /dev/video2, Grabber, driver em28xx, bus:usb-1\n"
            "      also /dev/v4l/by-path/pci-0\n"
            "      calibration: serial = \"4711\", model = \"em28xx Grabber\"\n"
            "  /dev/v4l/by-id/c\n"
            "      /dev/video4, cannot be opened: Permission denied\n"
            "  /dev/v4l/by-path/pci-0\n"
            "      /dev/video2, Grabber, driver em28xx, bus:usb-1\n"
            "      not named by its serial number, which another one has, too\n"
            "      calibration: serial = \"4711\", model = \"em28xx Grabber\"\n");
}

TEST(MachineDevices, GpioChipsAreListedWithTheirLinesAndUsers) {
  drivers::GpioChip chip;
  chip.name = "gpiochip0";
  chip.label = "pinctrl-bcm2711";
  chip.lines = {{"ID_SDA", ""}, {"", ""}, {"GPIO8", "spi0"}};

  EXPECT_EQ(gpio_text({chip}),
            "GPIO chips, by the chip to write into [lamp]:\n"
            "  pinctrl-bcm2711\n"
            "      gpiochip0, 3 lines\n"
            "      free: 0 (ID_SDA), 1\n"
            "      used: 2 (GPIO8) by spi0\n");
}

TEST(MachineDevices, PwmChipsAreListedByTheirDevice) {
  EXPECT_EQ(pwm_text({{"pwmchip0", "fe20c000.pwm", 2}, {"pwmchip1", "", 1}}),
            "PWM chips, by the chip to write into [lamp]:\n"
            "  fe20c000.pwm\n      pwmchip0, 2 channels\n"
            "  pwmchip1\n      pwmchip1, 1 channel\n");
}

TEST(MachineDevices, WhatThereIsNoneOfIsSaid) {
  EXPECT_EQ(cameras_text({}) + gpio_text({}) + pwm_text({}),
            "no cameras\nno GPIO chips\nno PWM chips\n");
}

}  // namespace
}  // namespace tubesight::board
