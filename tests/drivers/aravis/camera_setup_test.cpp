// What is agreed with a camera, and what it says when it has not what is wanted.

#include <gtest/gtest.h>

#include "tests/drivers/aravis/gige_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using drivers::aravis::Quantity;
using drivers::aravis::Region;
using std::chrono::microseconds;

class GigeSetup : public testing::Test {
 protected:
  /// Starts a camera that `change` has had its way with.
  template <typename Change>
  void with(const drivers::AravisSettings& settings, Change change) {
    bench_ = std::make_unique<GigeBench>(settings);
    change(bench_->camera());
    started_ = bench_->grabber().start();
  }
  void with(const drivers::AravisSettings& settings) {
    with(settings, [](FakeGigeCamera&) {});
  }
  void expect_refusal(Error error, const std::string& message) {
    ASSERT_FALSE(started_);
    EXPECT_EQ(started_.error(), error);
    EXPECT_EQ(bench_->message(), "camera address:10.0.0.2: " + message);
    EXPECT_EQ(bench_->library().open_devices(), 0);
    EXPECT_EQ(bench_->report().trouble, drivers::AravisTrouble::kNotOpen);
  }

  drivers::AravisSettings settings_ = gige_settings();
  std::unique_ptr<GigeBench> bench_;
  core::Result<void> started_;
};

TEST_F(GigeSetup, AllThatIsWantedIsSet) {
  settings_.left_px = 8;
  settings_.top_px = 4;
  settings_.binning = 2;
  settings_.fields_per_s = 50.0;
  settings_.exposure_ms = 1.5;
  settings_.gain = 3.0;
  settings_.packet_bytes = 1400;
  settings_.resend = true;
  settings_.priority = 51;
  with(settings_, [](FakeGigeCamera& camera) { camera.bytes_beside = 64; });
  ASSERT_TRUE(started_) << bench_->message();

  FakeGigeCamera& camera = bench_->camera();
  EXPECT_EQ(camera.region, (Region{8, 4, 64, 48}));
  EXPECT_EQ(camera.binned, 2);
  EXPECT_EQ(camera.format, "Mono8");
  EXPECT_EQ(camera.numbers[Quantity::kFrames_per_s].value, 50.0);
  EXPECT_EQ(camera.numbers[Quantity::kExposure_us].value, 1500.0);
  EXPECT_TRUE(camera.numbers[Quantity::kExposure_us].by_hand);
  EXPECT_EQ(camera.numbers[Quantity::kGain].value, 3.0);
  EXPECT_TRUE(camera.numbers[Quantity::kGain].by_hand);
  EXPECT_EQ(camera.packet, 1400);
  EXPECT_EQ(camera.trigger, "");
  EXPECT_TRUE(camera.plan.resend);
  EXPECT_EQ(camera.plan.priority, 51);
  EXPECT_EQ(camera.plan.buffer_bytes, 64U * 48U + 64U);
  EXPECT_EQ(camera.plan.buffers, 12) << "250 ms at 50 a second";
  EXPECT_EQ(bench_->grabber().span(), std::chrono::milliseconds(20));
}

TEST_F(GigeSetup, WhatIsNotWantedStaysAsItIs) {
  with(settings_);
  ASSERT_TRUE(started_) << bench_->message();

  FakeGigeCamera& camera = bench_->camera();
  EXPECT_EQ(camera.numbers[Quantity::kFrames_per_s].value, 30.0);
  EXPECT_EQ(camera.numbers[Quantity::kExposure_us].value, 2000.0);
  EXPECT_EQ(camera.packet, 8000) << "negotiated";
  EXPECT_FALSE(camera.plan.resend) << "some cameras answer with the wrong packets";
  EXPECT_EQ(bench_->grabber().agreed().exposure, microseconds(2000));
  EXPECT_EQ(bench_->grabber().agreed().readout, microseconds(10'000))
      << "that of the most frames a second";
}

// A mirrored picture moves the wrong way, and a test pattern is none of the tool's.
TEST_F(GigeSetup, ACameraThatSomebodyLeftMirroredOrWithATestPatternIsRefused) {
  with(settings_, [](FakeGigeCamera& camera) {
    camera.alterations = {"ReverseX is on", "TestPattern is GreyHorizontalRamp"};
  });
  expect_refusal(Error::kUnsupported,
                 "gives no plain pictures: ReverseX is on, TestPattern is GreyHorizontalRamp, "
                 "expected off");

  bench_->camera().alterations.clear();
  EXPECT_TRUE(bench_->grabber().start()) << "when that is put right";
}

TEST_F(GigeSetup, TheBestFormatIsTaken) {
  with(settings_, [](FakeGigeCamera& camera) {
    camera.formats = {"BayerRG8", "Mono12", "Mono12Packed"};
  });
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->camera().format, "Mono12Packed");
}

TEST_F(GigeSetup, OfOddLinesNoneThatSharesBytes) {
  settings_.width_px = 63;
  with(settings_, [](FakeGigeCamera& camera) { camera.formats = {"Mono12p", "Mono12"}; });
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->camera().format, "Mono12");
}

TEST_F(GigeSetup, OddLinesThatShareBytesAreRefused) {
  settings_.width_px = 62;
  settings_.format = "Mono10p";
  with(settings_, [](FakeGigeCamera& camera) { camera.formats = {"Mono10p"}; });
  expect_refusal(Error::kUnsupported, "lines of 62 pixels, expected a multiple of 4 with Mono10p");
}

TEST_F(GigeSetup, ACameraWithoutGreyFormatsSaysWhatItOffers) {
  with(settings_, [](FakeGigeCamera& camera) { camera.formats = {"BayerRG8", "RGB8"}; });
  expect_refusal(Error::kUnsupported,
                 "offers BayerRG8, RGB8, expected Mono8 or another of grey values");
}

TEST_F(GigeSetup, AFormatThatIsNotThereIsNotReplaced) {
  settings_.format = "Mono12";
  with(settings_);
  expect_refusal(Error::kUnsupported, "offers Mono8, expected Mono12");
}

TEST_F(GigeSetup, AFormatThatIsNotKeptIsRefused) {
  with(settings_, [](FakeGigeCamera& camera) { camera.kept_format = "BayerRG8"; });
  expect_refusal(Error::kIo, "format Mono8: keeps BayerRG8");
}

TEST_F(GigeSetup, APictureOfAnotherSizeIsRefused) {
  settings_.width_px = 62;
  with(settings_, [](FakeGigeCamera& camera) { camera.widths_of = 4; });
  expect_refusal(Error::kUnsupported,
                 "gives 60 x 48 at 0, 0 of its 1024 x 768, expected 62 x 48 at 0, 0");
}

TEST_F(GigeSetup, ARegionBesideTheSensorIsRefused) {
  settings_.left_px = 1000;
  with(settings_);
  expect_refusal(
      Error::kUnsupported,
      "refuses its region (out of range) of its 1024 x 768, expected 64 x 48 at 1000, 0");
}

TEST_F(GigeSetup, BinningThatIsNotThereIsMissedOnlyWhereItIsWanted) {
  with(settings_, [](FakeGigeCamera& camera) { camera.binning = false; });
  EXPECT_TRUE(started_);
  settings_.binning = 2;
  with(settings_, [](FakeGigeCamera& camera) { camera.binning = false; });
  expect_refusal(Error::kUnsupported, "has no binning, expected 2");
}

TEST_F(GigeSetup, AnExposureOutOfRangeSaysTheRange) {
  settings_.exposure_ms = 50.0;
  with(settings_);
  expect_refusal(Error::kUnsupported, "exposure in us 50000: out of range, offers 10 to 30000");
}

TEST_F(GigeSetup, AnExposureInTheCamerasStepsIsKeptAndUsed) {
  settings_.exposure_ms = 1.0;
  with(settings_,
       [](FakeGigeCamera& camera) { camera.numbers[Quantity::kExposure_us].step = 32.0; });
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->grabber().agreed().exposure, microseconds(992));
}

TEST_F(GigeSetup, AnExposureThatIsNotKeptIsRefused) {
  settings_.exposure_ms = 1.0;
  with(settings_,
       [](FakeGigeCamera& camera) { camera.numbers[Quantity::kExposure_us].step = 400.0; });
  expect_refusal(Error::kUnsupported, "keeps exposure in us 1200, expected 1000");
}

TEST_F(GigeSetup, AGainThatIsNotThereIsMissed) {
  settings_.gain = 2.0;
  with(settings_, [](FakeGigeCamera& camera) { camera.numbers.erase(Quantity::kGain); });
  expect_refusal(Error::kUnsupported, "has no gain that can be set, expected 2");
}

TEST_F(GigeSetup, ARateThatNobodySaysIsMissed) {
  const auto change = [](FakeGigeCamera& camera) { camera.numbers.erase(Quantity::kFrames_per_s); };
  with(settings_, change);
  expect_refusal(Error::kUnsupported, "does not say its rate, expected fields_per_s to say it");
  settings_.fields_per_s = 40.0;
  with(settings_, change);
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->grabber().span(), microseconds(25'000));
  EXPECT_EQ(bench_->grabber().agreed().readout, microseconds(25'000));
}

TEST_F(GigeSetup, ATriggeredCameraGoesAtTheRateOfTheSettings) {
  settings_.trigger = "Line1";
  with(settings_);
  expect_refusal(Error::kUnsupported, "does not say its rate, expected fields_per_s to say it");
  settings_.fields_per_s = 60.0;
  with(settings_);
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->camera().trigger, "Line1");
  EXPECT_EQ(bench_->camera().numbers[Quantity::kFrames_per_s].value, 30.0) << "left alone";
}

TEST_F(GigeSetup, ATriggerThatIsNotThereIsRefused) {
  settings_.trigger = "Line7";
  settings_.fields_per_s = 60.0;
  with(settings_);
  expect_refusal(Error::kUnsupported, "trigger 'Line7': no such line");
}

TEST_F(GigeSetup, PacketsLargerThanWantedAreRefused) {
  settings_.packet_bytes = 600;
  with(settings_, [](FakeGigeCamera& camera) { camera.least_packet = 1500; });
  expect_refusal(Error::kUnsupported, "sends packets of 1500 bytes, expected 600");
  with(settings_, [](FakeGigeCamera& camera) { camera.refuses_size = true; });
  expect_refusal(Error::kIo, "packets of 600 bytes: refused");
}

TEST_F(GigeSetup, ACameraOfUsbHasNoPackets) {
  settings_.packet_bytes = 1400;
  with(settings_, [](FakeGigeCamera& camera) { camera.packets = false; });
  ASSERT_TRUE(started_) << bench_->message();
  EXPECT_EQ(bench_->camera().packet, 1500) << "left alone";
  EXPECT_TRUE(bench_->good_within(8));
}

TEST_F(GigeSetup, AnotherCameraThanTheCalibratedOneIsNotOpened) {
  settings_.calibrated.serial = "0815";
  with(settings_);
  expect_refusal(Error::kUnsupported,
                 "has the serial number 4711, expected 0815, the one that was calibrated");
  with(settings_, [](FakeGigeCamera& camera) { camera.serial.clear(); });
  expect_refusal(Error::kUnsupported,
                 "says no serial number, expected 0815, the one that was calibrated");
  settings_.calibrated.serial = "4711";
  with(settings_);
  EXPECT_TRUE(started_);
}

TEST_F(GigeSetup, AnotherProgramsCameraIsBusy) {
  with(settings_, [](FakeGigeCamera& camera) { camera.busy = true; });
  expect_refusal(Error::kIo, "is busy: another program has its control, expected it free");
}

TEST_F(GigeSetup, AStreamThatDoesNotStartIsRefused) {
  with(settings_, [](FakeGigeCamera& camera) { camera.starts = false; });
  expect_refusal(Error::kIo, "does not start to stream: no bandwidth");
  bench_->camera().starts = true;
  EXPECT_TRUE(bench_->settle());
}

}  // namespace
}  // namespace tubesight::tests
