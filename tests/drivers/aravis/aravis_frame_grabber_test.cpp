#include "drivers/aravis/aravis_frame_grabber.h"

#include <gtest/gtest.h>

#include "tests/drivers/aravis/gige_bench.h"
#include "tests/hal/frame_grabber_contract.h"

namespace tubesight::tests {
namespace {

using core::Parity;
using core::Scan;
using std::chrono::milliseconds;

class GigeProgressiveMaker {
 public:
  hal::FrameGrabber& grabber() { return bench_.grabber(); }

 private:
  GigeBench bench_;
};

class GigeInterlacedMaker {
 public:
  GigeInterlacedMaker() { bench_.camera().formats = {"Mono12p"}; }
  hal::FrameGrabber& grabber() { return bench_.grabber(); }

 private:
  GigeBench bench_{gige_settings(Scan::kOddFirst)};
};

}  // namespace
}  // namespace tubesight::tests

namespace tubesight::support {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(GigeProgressive, FrameGrabberContract, tests::GigeProgressiveMaker);
INSTANTIATE_TYPED_TEST_SUITE_P(GigeInterlaced, FrameGrabberContract, tests::GigeInterlacedMaker);

}  // namespace
}  // namespace tubesight::support

namespace tubesight::tests {
namespace {

class GigeFormats : public testing::TestWithParam<const char*> {};

TEST_P(GigeFormats, WholeFramesAreWhatWasDrawn) {
  GigeBench bench;
  bench.camera().formats = {GetParam()};
  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  for (int i = 0; i < 20; ++i) {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    const core::Field& field = lease->field();
    EXPECT_EQ(field.status, i < 3 ? core::FieldStatus::kDamaged : core::FieldStatus::kGood)
        << "the first ones may be old";
    expect_drawn(field, 64, 48);
    EXPECT_EQ(field.parity, Parity::kProgressive);
    EXPECT_EQ(field.number, 2 * i);
    EXPECT_EQ(field.sequence, i);
  }
  EXPECT_TRUE(bench.report().stamps);
  EXPECT_TRUE(bench.report().counts);
  EXPECT_EQ(bench.counters().settling, 3);
  EXPECT_EQ(bench.counters().lost_fields, 0);
  EXPECT_EQ(bench.report().trouble, drivers::AravisTrouble::kNone);
}

TEST_P(GigeFormats, BothFieldsOfAnInterlacedFrameAreLent) {
  for (const Scan scan : {Scan::kEvenFirst, Scan::kOddFirst}) {
    GigeBench bench(gige_settings(scan));
    bench.camera().formats = {GetParam()};
    ASSERT_TRUE(bench.grabber().start()) << bench.message();
    EXPECT_EQ(bench.grabber().fields_a_picture(), 2);
    core::FieldTime before{0};
    for (int i = 0; i < 20; ++i) {
      const auto lease = bench.grab();
      ASSERT_TRUE(lease);
      const core::Field& field = lease->field();
      const bool even = (i % 2 == 0) == (scan == Scan::kEvenFirst);
      EXPECT_EQ(field.parity, even ? Parity::kEven : Parity::kOdd);
      EXPECT_EQ(field.pixels.first_line, even ? 0 : 1);
      EXPECT_EQ(field.number, i);
      EXPECT_EQ(field.sequence, i);
      expect_drawn(field, 64, 24);
      if (i > 0) {
        EXPECT_NEAR(static_cast<double>((field.mid_exposure - before).count()), 16'666'667.0,
                    1000.0);
      }
      before = field.mid_exposure;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, GigeFormats,
                         testing::Values("Mono8", "Mono10", "Mono12", "Mono10Packed",
                                         "Mono12Packed", "Mono10p", "Mono12p"),
                         [](const auto& format) { return std::string(format.param); });

/// A camera's picture, at 120 fields a second.
struct GigePicture {
  std::int32_t width_px;
  std::int32_t height_px;
  Scan scan;
  const char* format;
};

class GigePictures : public testing::TestWithParam<GigePicture> {};

TEST_P(GigePictures, OfAllSizesAreLentWhole) {
  const GigePicture& picture = GetParam();
  drivers::AravisSettings settings = gige_settings(picture.scan);
  settings.width_px = picture.width_px;
  settings.height_px = picture.height_px;
  settings.fields_per_s = 120.0;
  GigeBench bench(settings);
  bench.camera().sensor = {0, 0, 1920, 1200};
  bench.camera().formats = {picture.format};
  bench.camera().numbers[drivers::aravis::Quantity::kFrames_per_s].bounds.most = 200.0;
  const bool pair = picture.scan != Scan::kProgressive;
  bench.camera().every = core::FieldTime{pair ? 16'666'667 : 8'333'333};
  ASSERT_TRUE(bench.settle()) << bench.message();

  EXPECT_EQ(bench.grabber().span(), core::FieldTime{8'333'333});
  const auto lease = bench.grab();
  ASSERT_TRUE(lease);
  EXPECT_EQ(lease->field().status, core::FieldStatus::kGood);
  expect_drawn(lease->field(), picture.width_px, picture.height_px / (pair ? 2 : 1));
  EXPECT_EQ(bench.counters().lost_fields, 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, GigePictures,
                         testing::Values(GigePicture{320, 240, Scan::kOddFirst, "Mono8"},
                                         GigePicture{1280, 1024, Scan::kProgressive, "Mono10p"},
                                         GigePicture{1920, 1200, Scan::kProgressive, "Mono8"},
                                         GigePicture{1920, 1200, Scan::kEvenFirst,
                                                     "Mono12Packed"}));

TEST(AravisFrameGrabber, LinesOfBytesAreLentWhereTheLibraryPutThem) {
  GigeBench bench;
  ASSERT_TRUE(bench.settle());
  const auto lease = bench.grab();
  ASSERT_TRUE(lease);
  const auto* const pixels = reinterpret_cast<const std::byte*>(lease->field().pixels.pixels);
  const auto pool = bench.camera().plan.memory;

  EXPECT_GE(pixels, pool.data());
  EXPECT_LT(pixels, pool.data() + pool.size());
}

// Arrival is at the stamp and 15 ms; the readout takes 10 ms, the exposure 2 ms.
TEST(AravisFrameGrabber, MidExposureIsBeforeReadoutAndHalfTheExposure) {
  GigeBench bench;
  ASSERT_TRUE(bench.settle());
  const auto lease = bench.grab();
  ASSERT_TRUE(lease);

  EXPECT_EQ(bench.library().now() - lease->field().mid_exposure, milliseconds(10 + 1));
}

TEST(AravisFrameGrabber, TheReadoutOfTheSettingsCounts) {
  drivers::AravisSettings settings = gige_settings();
  settings.readout_ms = 4.0;
  GigeBench bench(settings);
  ASSERT_TRUE(bench.settle());
  const auto lease = bench.grab();
  ASSERT_TRUE(lease);

  EXPECT_EQ(bench.library().now() - lease->field().mid_exposure, milliseconds(4 + 1));
}

// The second field's last line comes with the arrival, a field's time after its exposure.
TEST(AravisFrameGrabber, OfTwoFieldsTheFirstIsAFieldsTimeEarlier) {
  GigeBench bench(gige_settings(Scan::kEvenFirst));
  ASSERT_TRUE(bench.settle());
  ASSERT_TRUE(bench.grab());
  core::FieldTime first{0};
  {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    first = lease->field().mid_exposure;
  }
  EXPECT_NEAR(static_cast<double>((bench.library().now() - first).count()),
              2 * 16'666'666.7 + 1'000'000.0, 10.0);
}

TEST(AravisFrameGrabber, BuffersGoBackAndComeAgain) {
  GigeBench bench;
  ASSERT_TRUE(bench.settle());
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(bench.next_status(), core::FieldStatus::kGood) << i;
  }
  bench.grabber().look_after();
  EXPECT_EQ(bench.counters().underruns, 0);
}

TEST(AravisFrameGrabber, AnotherCameraAtTheAddressIsNotTakenWhileItRuns) {
  GigeBench bench;
  bench.camera().serial = "4711";
  ASSERT_TRUE(bench.settle());
  EXPECT_EQ(bench.grabber().doubt(),
            "calibration is bound to no camera: this one is serial = \"4711\", model = \"Fake "
            "Model\"");
  bench.camera().serial = "4712";
  const auto started = bench.start_anew();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kUnsupported);
  EXPECT_EQ(bench.message(),
            "camera address:10.0.0.2: has the serial number 4712, expected 4711, the one that this "
            "box has used so far");

  bench.camera().serial = "4711";
  ASSERT_TRUE(bench.start_anew());
  EXPECT_TRUE(bench.good_within(4));
}

TEST(AravisFrameGrabber, ATimeOutIsNoError) {
  GigeBench bench;
  ASSERT_TRUE(bench.settle());
  const auto lease = bench.grab(1);
  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), core::Error::kTimeout);
  EXPECT_EQ(bench.next_status(), core::FieldStatus::kGood);
}

}  // namespace
}  // namespace tubesight::tests
