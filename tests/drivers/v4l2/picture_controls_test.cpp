// What other programs change of a camera that a box has: its picture mirrored, turned or moved.

#include "drivers/v4l2/picture_controls.h"

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using drivers::CameraTrouble;

class PictureControls : public testing::Test {
 protected:
  PictureControls() { offer(bench_); }

  static void offer(CameraBench& bench) {
    FakeCamera::Control gain;
    gain.name = "Gain";
    FakeCamera::Control flip;
    flip.name = "Horizontal Flip";
    flip.id = V4L2_CID_HFLIP;
    flip.most = 1;
    FakeCamera::Control zoom;
    zoom.name = "Zoom, Absolute";
    zoom.id = V4L2_CID_ZOOM_ABSOLUTE;
    zoom.value = 10;
    zoom.usual = 10;
    bench.camera().controls = {gain, flip, zoom};
  }
  static constexpr const char* kFlipped =
      ": control 'Horizontal Flip': is 1, expected 0 as it is by default, or the value that is "
      "meant in controls";

  CameraBench bench_;
};

TEST_F(PictureControls, AMirroredPictureThatSomebodyLeftIsRefused) {
  bench_.camera().controls[1].value = 1;
  const auto started = bench_.grabber().start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kUnsupported);
  EXPECT_EQ(bench_.message(), std::string("camera ") + kByPath + kFlipped);
  EXPECT_EQ(bench_.kernel().open_devices(), 0);

  bench_.camera().controls[1].value = 0;
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(PictureControls, AMagnifiedPictureIsRefused) {
  bench_.camera().controls[2].value = 12;
  ASSERT_FALSE(bench_.grabber().start());
  EXPECT_NE(bench_.message().find("control 'Zoom, Absolute': is 12, expected 10"),
            std::string::npos)
      << bench_.message();
}

TEST_F(PictureControls, WhatTheSettingsSayIsMeant) {
  drivers::V4l2Settings settings = settings_of();
  settings.controls = {{"horizontal flip", "1"}};
  CameraBench bench(settings);
  offer(bench);

  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  bench.grabber().look_after();
  EXPECT_TRUE(bench.good_within(2));

  // Somebody turns it back: it is set anew.
  bench.kernel().change_control(bench.camera(), V4L2_CID_HFLIP, 0);
  EXPECT_EQ(bench.next_status(), FieldStatus::kMissing);
  ASSERT_TRUE(bench.start_anew()) << bench.message();
  EXPECT_EQ(bench.camera().controls[1].value, 1);
  EXPECT_TRUE(bench.good_within(1));
}

TEST_F(PictureControls, OneChangedInTheStreamEndsItBeforeAnotherPictureIsTaken) {
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  ASSERT_TRUE(bench_.good_within(1));
  bench_.kernel().change_control(bench_.camera(), V4L2_CID_HFLIP, 1);

  const auto lease = bench_.grab();
  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kAltered);
  EXPECT_EQ(bench_.counters().source_changes, 1);
  EXPECT_FALSE(bench_.start_anew()) << "as long as it stays so";

  bench_.kernel().change_control(bench_.camera(), V4L2_CID_HFLIP, 0);
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(PictureControls, OneChangedWithinAnOpeningIsNotMissed) {
  for (const unsigned long moment : {VIDIOC_REQBUFS, VIDIOC_STREAMON}) {
    bench_.camera().controls[1].value = 0;
    bool done = moment != VIDIOC_REQBUFS;  // the first one asks only whether the camera is free
    bench_.camera().before = [&](unsigned long request) {
      if (request == moment && done) {
        bench_.kernel().change_control(bench_.camera(), V4L2_CID_HFLIP, 1);
      }
      done = done || request == moment;
    };
    ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
    bench_.camera().before = nullptr;
    EXPECT_EQ(bench_.next_status(), FieldStatus::kMissing);
    EXPECT_EQ(bench_.report().trouble, CameraTrouble::kAltered);
    bench_.grabber().stop();
    bench_.camera().events.clear();
  }
}

TEST_F(PictureControls, WhereTheDriverTellsNoChangesTheyAreLookedFor) {
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  bench_.grabber().look_after();
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().controls[1].value = 1;
  bench_.grabber().look_after();

  const auto lease = bench_.grab();
  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kAltered);
}

TEST_F(PictureControls, OtherControlsAreNobodysBusiness) {
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  bench_.kernel().change_control(bench_.camera(), 1, 50);
  bench_.grabber().look_after();

  EXPECT_TRUE(bench_.good_within(2));
}

}  // namespace
}  // namespace tubesight::tests
