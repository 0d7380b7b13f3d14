#include "drivers/v4l2/v4l2_frame_grabber.h"

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"
#include "tests/hal/frame_grabber_contract.h"

namespace tubesight::tests {
namespace {

using core::Parity;
using core::Scan;
using std::chrono::microseconds;
using std::chrono::milliseconds;

class ProgressiveMaker {
 public:
  hal::FrameGrabber& grabber() { return bench_.grabber(); }

 private:
  CameraBench bench_;
};

class InterlacedMaker {
 public:
  InterlacedMaker() {
    bench_.camera().fields = {V4L2_FIELD_INTERLACED};
    bench_.camera().formats = {V4L2_PIX_FMT_YUYV};
  }
  hal::FrameGrabber& grabber() { return bench_.grabber(); }

 private:
  CameraBench bench_{settings_of(Scan::kOddFirst)};
};

}  // namespace
}  // namespace tubesight::tests

namespace tubesight::support {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Progressive, FrameGrabberContract, tests::ProgressiveMaker);
INSTANTIATE_TYPED_TEST_SUITE_P(Interlaced, FrameGrabberContract, tests::InterlacedMaker);

}  // namespace
}  // namespace tubesight::support

namespace tubesight::tests {
namespace {

void expect_fields(CameraBench& bench, std::int32_t width_px, std::int32_t lines, Parity first) {
  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  core::Field before;
  for (int i = 0; i < 6; ++i) {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    const core::Field& field = lease->field();
    const Parity second = first == Parity::kEven ? Parity::kOdd : Parity::kEven;
    EXPECT_EQ(field.parity, i % 2 == 0 ? first : second);
    EXPECT_EQ(field.status, core::FieldStatus::kGood);
    EXPECT_EQ(field.number, i);
    EXPECT_EQ(field.sequence, i);
    if (i > 0) {
      EXPECT_NEAR(static_cast<double>((field.mid_exposure - before.mid_exposure).count()),
                  16'666'667.0, 1000.0);
    }
    expect_drawn(field, width_px, lines);
    before = field;
  }
  EXPECT_EQ(bench.counters().lost_fields, 0);
  EXPECT_EQ(bench.report().trouble, drivers::CameraTrouble::kNone);
}

TEST(V4l2FrameGrabber, WholeFramesAreLentWhereTheDriverPutThem) {
  CameraBench bench;
  bench.camera().padding_bytes = 16;
  ASSERT_TRUE(bench.grabber().start());

  for (int i = 0; i < 10; ++i) {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    expect_drawn(lease->field(), 64, 48);
    EXPECT_EQ(lease->field().pixels.stride_px, 80) << "with the padding: nothing was copied";
    EXPECT_EQ(lease->field().parity, Parity::kProgressive);
    EXPECT_EQ(lease->field().number, 2 * i);
    EXPECT_EQ(lease->field().sequence, i);
  }
  EXPECT_TRUE(bench.report().stamps);
  EXPECT_TRUE(bench.report().counts);
}

TEST(V4l2FrameGrabber, BothFieldsOfAnInterlacedBufferAreLent) {
  for (const Scan scan : {Scan::kEvenFirst, Scan::kOddFirst}) {
    CameraBench bench(settings_of(scan));
    bench.camera().fields = {V4L2_FIELD_INTERLACED};

    expect_fields(bench, 64, 24, scan == Scan::kOddFirst ? Parity::kOdd : Parity::kEven);
    EXPECT_EQ(bench.kernel().calls(VIDIOC_DQBUF), 3) << "two of each";
  }
}

TEST(V4l2FrameGrabber, AFrameOfAnOddNumberOfLinesHasOneEvenLineMore) {
  drivers::V4l2Settings settings = settings_of(Scan::kEvenFirst);
  settings.width_px = 63;
  settings.height_px = 47;
  CameraBench bench(settings);
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  ASSERT_TRUE(bench.grabber().start());

  {
    const auto even = bench.grab();
    ASSERT_TRUE(even);
    expect_drawn(even->field(), 63, 24);
  }
  const auto odd = bench.grab();
  ASSERT_TRUE(odd);
  expect_drawn(odd->field(), 63, 23);
}

TEST(V4l2FrameGrabber, FieldsByTurnsComeOneABuffer) {
  CameraBench bench(settings_of(Scan::kEvenFirst));
  bench.camera().fields = {V4L2_FIELD_ALTERNATE};
  bench.camera().every = core::FieldTime{16'666'667};

  expect_fields(bench, 64, 24, Parity::kEven);
  EXPECT_EQ(bench.grabber().fields_a_buffer(), 1);
}

TEST(V4l2FrameGrabber, FieldsMayStandOneBelowTheOther) {
  CameraBench even(settings_of(Scan::kEvenFirst));
  even.camera().fields = {V4L2_FIELD_SEQ_TB};
  expect_fields(even, 64, 24, Parity::kEven);
  EXPECT_EQ(even.counters().odd_order, 0);

  CameraBench odd(settings_of(Scan::kOddFirst));
  odd.camera().fields = {V4L2_FIELD_SEQ_BT};
  expect_fields(odd, 64, 24, Parity::kOdd);
  EXPECT_EQ(odd.counters().odd_order, 0);
}

TEST(V4l2FrameGrabber, LumaOfEveryFormatIsTheSame) {
  for (const std::uint32_t format : {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_YUYV,
                                     V4L2_PIX_FMT_UYVY, V4L2_PIX_FMT_Y10, V4L2_PIX_FMT_Y16}) {
    CameraBench bench(settings_of(Scan::kEvenFirst));
    bench.camera().fields = {V4L2_FIELD_INTERLACED};
    bench.camera().formats = {V4L2_PIX_FMT_MJPEG, format};
    bench.camera().padding_bytes = 6;

    expect_fields(bench, 64, 24, Parity::kEven);
  }
}

TEST(V4l2FrameGrabber, ABufferGoesBackWhenItsLastFieldDoes) {
  CameraBench bench(settings_of(Scan::kEvenFirst));
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  ASSERT_TRUE(bench.grabber().start());
  const int queued = bench.kernel().calls(VIDIOC_QBUF);

  ASSERT_TRUE(bench.grab());
  EXPECT_EQ(bench.kernel().calls(VIDIOC_QBUF), queued);
  ASSERT_TRUE(bench.grab());
  EXPECT_EQ(bench.kernel().calls(VIDIOC_QBUF), queued + 1);
}

TEST(V4l2FrameGrabber, InstantsAreThoseOfTheMiddleOfTheExposure) {
  drivers::V4l2Settings settings = settings_of();
  settings.exposure_ms = 4.0;
  CameraBench bench(settings);
  ASSERT_TRUE(bench.grabber().start());
  const core::FieldTime begin = bench.kernel().now();

  const auto lease = bench.grab();

  // The frame ends 1/30 s after the beginning, its readout takes as long, and half of 4 ms.
  ASSERT_TRUE(lease);
  EXPECT_NEAR(static_cast<double>((lease->field().mid_exposure - begin).count()), -2e6, 2e3);
}

TEST(V4l2FrameGrabber, StampsOfTheStartOfExposureAreReadAsSuch) {
  drivers::V4l2Settings settings = settings_of();
  settings.exposure_ms = 4.0;
  CameraBench bench(settings);
  bench.camera().stamp_flags |= V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  ASSERT_TRUE(bench.grabber().start());
  const core::FieldTime begin = bench.kernel().now();

  const auto lease = bench.grab();

  ASSERT_TRUE(lease);
  EXPECT_NEAR(static_cast<double>((lease->field().mid_exposure - begin).count()), 33.333e6 + 2e6,
              2e3);
}

TEST(V4l2FrameGrabber, WaitsNoLongerThanItMay) {
  CameraBench bench;
  ASSERT_TRUE(bench.grabber().start());
  const core::FieldTime begin = bench.kernel().now();

  const auto lease = bench.grab(20);

  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), core::Error::kTimeout);
  EXPECT_EQ(bench.kernel().now() - begin, milliseconds(20));
  EXPECT_TRUE(bench.grab(20)) << "the grabber stays started";
}

TEST(V4l2FrameGrabber, GivesEverythingBackWhenStopped) {
  CameraBench bench;
  ASSERT_TRUE(bench.grabber().start());
  ASSERT_TRUE(bench.grab());
  EXPECT_EQ(bench.kernel().mapped(), 6);

  bench.grabber().stop();

  EXPECT_EQ(bench.kernel().mapped(), 0);
  EXPECT_EQ(bench.kernel().open_devices(), 0);
  EXPECT_EQ(bench.report().trouble, drivers::CameraTrouble::kNotOpen);
}

// A camera that fails for a night is opened some thousand times, and refuses now this and now that.
TEST(V4l2FrameGrabber, AThousandOpeningsLeaveNothingBehind) {
  CameraBench bench;
  constexpr unsigned long kRefused[] = {VIDIOC_QUERYCAP, VIDIOC_S_FMT,    VIDIOC_REQBUFS,
                                        VIDIOC_QUERYBUF, VIDIOC_QBUF,     VIDIOC_STREAMON,
                                        VIDIOC_G_FMT,    VIDIOC_ENUM_FMT, VIDIOC_DQBUF};
  for (std::size_t i = 0; i < 1000; ++i) {
    const unsigned long request = kRefused[i % std::size(kRefused)];
    bench.camera().results[request] = {-EIO};
    if (request == VIDIOC_REQBUFS || request == VIDIOC_QBUF) {
      bench.camera().results[request].assign({0, 0, -EIO});
    }
    if (bench.grabber().start()) {
      static_cast<void>(bench.next_status());
      bench.grabber().stop();
    }
    bench.camera().results.clear();
    ASSERT_EQ(bench.kernel().open_devices(), 0) << i;
    ASSERT_EQ(bench.kernel().mapped(), 0) << i;
  }
  ASSERT_TRUE(bench.grabber().start());
  EXPECT_TRUE(bench.good_within(1));
}

TEST(V4l2FrameGrabber, NumbersGoOnOverARestart) {
  CameraBench bench(settings_of(Scan::kEvenFirst));
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  ASSERT_TRUE(bench.grabber().start());
  ASSERT_TRUE(bench.grab());
  core::Field before;
  {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    before = lease->field();
  }
  ASSERT_TRUE(bench.start_anew());

  const auto lease = bench.grab();

  ASSERT_TRUE(lease);
  EXPECT_EQ(lease->field().number, before.number + 1);
  EXPECT_GT(lease->field().sequence, before.sequence + 100) << "no track goes on over it";
  EXPECT_GT(lease->field().mid_exposure, before.mid_exposure);
}

}  // namespace
}  // namespace tubesight::tests
