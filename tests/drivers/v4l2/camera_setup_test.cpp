#include "drivers/v4l2/camera_setup.h"

#include <cerrno>

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::Scan;
using drivers::V4l2Settings;

/// Starts a camera that refuses; gives the message behind the camera's name.
std::string refusal(CameraBench& bench, Error error) {
  const auto started = bench.grabber().start();
  EXPECT_FALSE(started);
  if (!started) {
    EXPECT_EQ(started.error(), error);
  }
  EXPECT_EQ(bench.kernel().open_devices(), 0);
  EXPECT_EQ(bench.kernel().mapped(), 0);
  const std::string message = bench.message();
  const std::size_t name = message.find(": ");
  return name == std::string::npos ? message : message.substr(name + 2);
}

TEST(CameraSetup, TheBestFormatIsTaken) {
  CameraBench bench;
  bench.camera().formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_GREY};
  bench.camera().padding_bytes = 1;
  ASSERT_TRUE(bench.grabber().start());

  EXPECT_EQ(bench.grab()->field().pixels.stride_px, 65) << "GREY, which is lent";
}

TEST(CameraSetup, ACameraWithoutTheWantedFormatSaysWhatItOffers) {
  V4l2Settings settings = settings_of();
  settings.format = "Y10";
  CameraBench bench(settings);
  bench.camera().formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_GREY};

  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "offers formats MJPG, GREY, expected Y10 64 x 48 progressive");
}

TEST(CameraSetup, ASizeThatTheDriverRoundsIsRefused) {
  V4l2Settings settings = settings_of();
  settings.width_px = 63;
  CameraBench bench(settings);
  bench.camera().widths_of = 16;

  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "offers GREY 64 x 48 progressive, expected GREY, NV12, YUYV, UYVY, Y10 or Y16 63 x 48 "
            "progressive");
}

TEST(CameraSetup, AProgressiveCameraIsNoInterlacedOneAndTheOtherWayRound) {
  CameraBench interlaced(settings_of(Scan::kEvenFirst));
  CameraBench progressive;
  progressive.camera().fields = {V4L2_FIELD_INTERLACED};

  EXPECT_EQ(refusal(interlaced, Error::kUnsupported),
            "offers GREY 64 x 48 progressive, expected GREY, NV12, YUYV, UYVY, Y10 or Y16 64 x 48 "
            "with two fields a frame");
  EXPECT_EQ(refusal(progressive, Error::kUnsupported),
            "offers GREY 64 x 48 interlaced, expected GREY, NV12, YUYV, UYVY, Y10 or Y16 64 x 48 "
            "progressive");
}

TEST(CameraSetup, TheWantedLayoutOfFieldsIsTaken) {
  V4l2Settings settings = settings_of(Scan::kEvenFirst);
  settings.fields = drivers::FieldLayout::kAlternate;
  CameraBench bench(settings);
  bench.camera().fields = {V4L2_FIELD_INTERLACED, V4L2_FIELD_ALTERNATE};
  ASSERT_TRUE(bench.grabber().start());

  EXPECT_EQ(bench.grabber().fields_a_buffer(), 1);
}

TEST(CameraSetup, BuffersThatAreTooSmallForTheirFormatAreRefused) {
  CameraBench bench;
  bench.camera().missing_bytes = 1;

  EXPECT_EQ(refusal(bench, Error::kIo),
            "gives buffers of 3071 bytes, expected 3072 for the format that it agreed to");
}

TEST(CameraSetup, OneBufferIsTooFew) {
  CameraBench bench;
  bench.camera().most_buffers = 1;

  EXPECT_EQ(refusal(bench, Error::kIo), "gives 1 buffers, expected 2 to 32");
}

TEST(CameraSetup, TwoBuffersAreEnough) {
  CameraBench bench;
  bench.camera().most_buffers = 2;
  ASSERT_TRUE(bench.grabber().start());

  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(bench.good_within(1));
  }
}

TEST(CameraSetup, ARefusalToStreamIsTriedAgainByTheNextStart) {
  CameraBench bench;
  for (const int error : {-EIO, -EINVAL}) {
    bench.camera().results[VIDIOC_STREAMON] = {error};
    EXPECT_EQ(refusal(bench, Error::kIo),
              std::string("does not start to stream: ") + std::strerror(-error));
  }

  ASSERT_TRUE(bench.grabber().start());
  EXPECT_TRUE(bench.good_within(1));
}

TEST(CameraSetup, ABusyCameraSaysSo) {
  CameraBench bench;
  bench.camera().results[VIDIOC_S_FMT] = {-EBUSY};
  EXPECT_EQ(refusal(bench, Error::kIo),
            "is busy: another program takes its pictures, expected it free");

  bench.camera().results[VIDIOC_REQBUFS] = {0, -EBUSY};
  EXPECT_TRUE(refusal(bench, Error::kIo).starts_with("is busy: "));
  EXPECT_TRUE(bench.grabber().start()) << "when it is free";
}

TEST(CameraSetup, ASecondBoxTouchesNothingOfACameraThatOneHas) {
  CameraBench bench;
  bench.camera().inputs.push_back({"Composite 1", 0});
  ASSERT_TRUE(bench.grabber().start());
  V4l2Settings settings = settings_of();
  settings.input = "Composite 1";
  settings.controls = {{"Gain", "70"}};
  FakeCamera::Control gain;
  gain.name = "Gain";
  bench.camera().controls = {gain};
  drivers::V4l2FrameGrabber second(settings, bench.kernel(), bench.kernel());

  ASSERT_FALSE(second.start());
  EXPECT_EQ(second.messages()[0],
            std::string("camera ") + kByPath +
                ": is busy: another program takes its pictures, expected it free");
  EXPECT_EQ(bench.camera().input, 0) << "that of the first box";
  EXPECT_EQ(bench.camera().controls[0].value, 0);
  EXPECT_TRUE(bench.good_within(1));

  bench.grabber().stop();
  EXPECT_TRUE(second.start()) << "when the first one is gone";
}

TEST(CameraSetup, WhatIsNoCameraSaysSo) {
  CameraBench bench;
  bench.camera().caps = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "is no camera, expected one that streams pictures of one plane");

  bench.camera().results[VIDIOC_QUERYCAP] = {-ENOTTY};
  EXPECT_EQ(refusal(bench, Error::kUnsupported), "is no camera");
}

TEST(CameraSetup, ACameraThatIsNotThereNamesThoseThatAre) {
  V4l2Settings settings = settings_of();
  settings.device = "serial:77";
  CameraBench bench(settings);
  bench.camera().serial = "12";

  EXPECT_EQ(refusal(bench, Error::kDisconnected), "is not there, expected one of: serial:12");
}

TEST(CameraSetup, AnotherCameraThanWasCalibratedIsNotTaken) {
  V4l2Settings settings = settings_of();
  settings.calibrated.serial = "4711";
  CameraBench bench(settings);

  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "says no serial number, expected 4711, the one that was calibrated");
  bench.camera().serial = "4712";
  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "has the serial number 4712, expected 4711, the one that was calibrated");
  bench.camera().serial = "4711";
  EXPECT_TRUE(bench.grabber().start());
}

TEST(CameraSetup, TheRateIsTheOneThatTheDriverTells) {
  CameraBench told;
  told.camera().frame_time = {1, 50};
  ASSERT_TRUE(told.grabber().start());
  EXPECT_EQ(told.grabber().span(), std::chrono::milliseconds(20));

  CameraBench pal(settings_of(Scan::kEvenFirst));
  pal.camera().frame_time = {0, 0};
  pal.camera().standard = V4L2_STD_PAL;
  pal.camera().fields = {V4L2_FIELD_INTERLACED};
  ASSERT_TRUE(pal.grabber().start());
  EXPECT_EQ(pal.grabber().span(), std::chrono::milliseconds(20)) << "of the standard";
}

TEST(CameraSetup, ARateThatNobodyTellsMustBeSet) {
  CameraBench silent;
  silent.camera().frame_time = {0, 0};
  EXPECT_EQ(refusal(silent, Error::kUnsupported),
            "does not say its rate, expected fields_per_s to say it");

  V4l2Settings settings = settings_of();
  settings.fields_per_s = 40.0;
  CameraBench set(settings);
  set.camera().frame_time = {0, 0};
  ASSERT_TRUE(set.grabber().start());
  EXPECT_EQ(set.grabber().span(), std::chrono::milliseconds(25));
}

TEST(CameraSetup, ARateThatIsNotKeptIsRefused) {
  V4l2Settings settings = settings_of();
  settings.fields_per_s = 50.0;
  CameraBench bench(settings);
  EXPECT_EQ(refusal(bench, Error::kUnsupported),
            "gives 30.000000 fields a second, expected 50.000000");

  bench.camera().changes_rate = true;
  ASSERT_TRUE(bench.grabber().start());
  EXPECT_EQ(bench.grabber().span(), std::chrono::milliseconds(20));
}

TEST(CameraSetup, InputsGoByTheirNames) {
  V4l2Settings settings = settings_of();
  settings.input = "Composite 1";
  CameraBench bench(settings);
  EXPECT_EQ(refusal(bench, Error::kUnsupported), "has no input 'Composite 1', offers 'S-Video'");

  bench.camera().inputs.push_back({"Composite 1", 0});
  bench.camera().stays_at_input = true;
  EXPECT_EQ(refusal(bench, Error::kIo), "does not keep its input 'Composite 1'");

  bench.camera().stays_at_input = false;
  EXPECT_TRUE(bench.grabber().start());
}

TEST(CameraSetup, AStandardThatTheDriverDoesNotHaveIsRefused) {
  V4l2Settings settings = settings_of(Scan::kOddFirst);
  settings.standard = "NTSC";
  CameraBench bench(settings);
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  EXPECT_TRUE(refusal(bench, Error::kUnsupported).starts_with("standard NTSC: "));

  bench.camera().standard = V4L2_STD_PAL;
  bench.camera().frame_time = {0, 0};
  ASSERT_TRUE(bench.grabber().start());
  EXPECT_EQ(bench.grabber().span(), core::FieldTime{16'683'333}) << "set to NTSC";
}

V4l2Settings with_control(const char* name, const char* value) {
  V4l2Settings settings = settings_of();
  settings.controls = {{name, value}};
  return settings;
}

void offer_controls(CameraBench& bench) {
  FakeCamera::Control mode;
  mode.name = "Exposure Mode";
  mode.type = V4L2_CTRL_TYPE_MENU;
  mode.most = 2;
  mode.entries = {"Auto", "", "Manual"};
  FakeCamera::Control gain;
  gain.name = "Gain";
  bench.camera().controls = {mode, gain};
}

TEST(CameraSetup, ControlsGoByTheirNamesAndMenusByTheirWords) {
  CameraBench gain(with_control("gain", "70"));
  offer_controls(gain);
  ASSERT_TRUE(gain.grabber().start()) << gain.message();
  EXPECT_EQ(gain.camera().controls[1].value, 70);

  CameraBench mode(with_control("Exposure Mode", "manual"));
  offer_controls(mode);
  ASSERT_TRUE(mode.grabber().start()) << mode.message();
  EXPECT_EQ(mode.camera().controls[0].value, 2);
}

TEST(CameraSetup, WhatAControlDoesNotHaveIsRefused) {
  const auto refused = [](const char* name, const char* value) {
    CameraBench bench(with_control(name, value));
    offer_controls(bench);
    return refusal(bench, Error::kUnsupported);
  };

  EXPECT_EQ(refused("Iris", "1"), "has no control 'Iris', offers 'Exposure Mode', 'Gain'");
  EXPECT_EQ(refused("Gain", "101"), "control 'Gain': '101', expected 0 to 100");
  EXPECT_EQ(refused("Gain", "much"), "control 'Gain': 'much', expected 0 to 100");
  EXPECT_EQ(refused("Exposure Mode", "7"),
            "control 'Exposure Mode': '7', expected 'Auto', 'Manual'");
}

TEST(CameraSetup, AControlThatIsNotKeptIsRefused) {
  CameraBench bench(with_control("Gain", "70"));
  offer_controls(bench);
  bench.camera().controls[1].keeps = false;

  EXPECT_EQ(refusal(bench, Error::kIo), "control 'Gain': is 0, expected 70");
}

}  // namespace
}  // namespace tubesight::tests
