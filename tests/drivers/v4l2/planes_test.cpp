// Drivers that know the calls with planes alone, as those of many boards do.

#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "drivers/v4l2/camera_finder.h"
#include "tests/drivers/v4l2/camera_bench.h"
#include "tests/hal/frame_grabber_contract.h"

namespace tubesight::tests {
namespace {

using core::FieldStatus;
using core::Scan;

void in_planes(FakeCamera& camera) {
  camera.caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  camera.planes = 1;
}

class PlanesMaker {
 public:
  PlanesMaker() { in_planes(bench_.camera()); }
  hal::FrameGrabber& grabber() { return bench_.grabber(); }

 private:
  CameraBench bench_;
};

}  // namespace
}  // namespace tubesight::tests

namespace tubesight::support {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Planes, FrameGrabberContract, tests::PlanesMaker);

}  // namespace
}  // namespace tubesight::support

namespace tubesight::tests {
namespace {

/// A size and scan of a camera, and how its driver lays the lines.
struct Picture {
  std::int32_t width_px;
  std::int32_t height_px;
  Scan scan;
  std::uint32_t format;
  std::uint32_t padding_bytes;
};

std::ostream& operator<<(std::ostream& out, const Picture& picture) {
  return out << picture.width_px << " x " << picture.height_px
             << (picture.scan == Scan::kProgressive ? " progressive, " : " interlaced, ")
             << picture.padding_bytes << " bytes of padding";
}

class CameraPictures : public testing::TestWithParam<Picture> {
 protected:
  static void expect_frames(bool planes) {
    const Picture& picture = GetParam();
    drivers::V4l2Settings settings = settings_of(picture.scan);
    settings.width_px = picture.width_px;
    settings.height_px = picture.height_px;
    settings.fields_per_s = 120.0;
    CameraBench bench(settings);
    if (planes) {
      in_planes(bench.camera());
    }
    const bool progressive = picture.scan == Scan::kProgressive;
    bench.camera().frame_time = progressive ? v4l2_fract{1, 120} : v4l2_fract{1, 60};
    bench.camera().every = core::FieldTime{progressive ? 8'333'333 : 16'666'667};
    bench.camera().fields = {progressive ? V4L2_FIELD_NONE : V4L2_FIELD_INTERLACED};
    bench.camera().formats = {picture.format};
    bench.camera().padding_bytes = picture.padding_bytes;
    ASSERT_TRUE(bench.grabber().start()) << bench.message();
    EXPECT_EQ(bench.grabber().span(), core::FieldTime{8'333'333});
    for (int i = 0; i < (progressive ? 1 : 2); ++i) {
      const auto lease = bench.grab();
      ASSERT_TRUE(lease);
      EXPECT_EQ(lease->field().status, FieldStatus::kGood);
      const std::int32_t more = i == 0 ? 1 : 0;  // an even line more, where the number is odd
      expect_drawn(lease->field(), picture.width_px,
                   progressive ? picture.height_px : (picture.height_px + more) / 2);
    }
  }
};

TEST_P(CameraPictures, AreLentWhole) { expect_frames(false); }

TEST_P(CameraPictures, AreLentWholeFromAPlane) { expect_frames(true); }

INSTANTIATE_TEST_SUITE_P(
    Sizes, CameraPictures,
    testing::Values(Picture{320, 240, Scan::kProgressive, V4L2_PIX_FMT_GREY, 0},
                    Picture{320, 240, Scan::kEvenFirst, V4L2_PIX_FMT_YUYV, 64},
                    Picture{635, 480, Scan::kOddFirst, V4L2_PIX_FMT_GREY, 5},
                    Picture{721, 575, Scan::kEvenFirst, V4L2_PIX_FMT_NV12, 47},
                    Picture{1280, 1024, Scan::kProgressive, V4L2_PIX_FMT_Y10, 0},
                    Picture{1919, 1199, Scan::kProgressive, V4L2_PIX_FMT_GREY, 129},
                    Picture{1920, 1200, Scan::kEvenFirst, V4L2_PIX_FMT_Y16, 0}));

TEST(CameraPlanes, ThePictureBeginsWhereThePlaneSays) {
  CameraBench bench;
  in_planes(bench.camera());
  bench.camera().data_offset = 40;
  bench.camera().padding_bytes = 16;
  ASSERT_TRUE(bench.grabber().start()) << bench.message();

  for (int i = 0; i < 10; ++i) {
    const auto lease = bench.grab();
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().status, FieldStatus::kGood);
    EXPECT_EQ(lease->field().pixels.stride_px, 80) << "nothing was copied";
    expect_drawn(lease->field(), 64, 48);
  }
}

TEST(CameraPlanes, AnOffsetDoesNotCountAsPixels) {
  CameraBench bench;
  in_planes(bench.camera());
  bench.camera().data_offset = 40;
  bench.camera().tamper = [](auto, v4l2_buffer& buffer, auto) { buffer.bytesused -= 1; };
  ASSERT_TRUE(bench.grabber().start());

  EXPECT_EQ(bench.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench.counters().cut_short, 1);
}

TEST(CameraPlanes, AnOffsetThatLeavesNoRoomDamagesTheField) {
  CameraBench bench;
  in_planes(bench.camera());
  ASSERT_TRUE(bench.grabber().start());
  bench.camera().data_offset = 1;  // of memory that was shared without

  EXPECT_EQ(bench.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench.counters().cut_short, 1);
  bench.camera().data_offset = 0;
  EXPECT_TRUE(bench.good_within(8));
}

TEST(CameraPlanes, APictureInTwoPlanesIsRefused) {
  CameraBench bench;
  in_planes(bench.camera());
  bench.camera().planes = 2;

  EXPECT_FALSE(bench.grabber().start());
  EXPECT_NE(bench.message().find("offers GREY 64 x 48 progressive in 2 planes, expected GREY"),
            std::string::npos)
      << bench.message();
  EXPECT_EQ(bench.kernel().open_devices(), 0);
}

TEST(CameraPlanes, TheRateIsAskedForAndRead) {
  drivers::V4l2Settings settings = settings_of();
  settings.fields_per_s = 120.0;
  CameraBench bench(settings);
  in_planes(bench.camera());
  EXPECT_FALSE(bench.grabber().start()) << "it keeps 30";

  bench.camera().changes_rate = true;
  EXPECT_TRUE(bench.start_anew()) << bench.message();
  EXPECT_TRUE(bench.good_within(1));
}

TEST(CameraPlanes, ItComesBackOnAnotherNode) {
  CameraBench bench;
  in_planes(bench.camera());
  ASSERT_TRUE(bench.grabber().start());
  ASSERT_TRUE(bench.good_within(1));
  bench.kernel().unplug(0);
  EXPECT_EQ(bench.next_status(), FieldStatus::kMissing);

  bench.kernel().plug(3, bench.shared_camera());
  bench.kernel().link(kByPath, "/dev/video3");
  ASSERT_TRUE(bench.start_anew()) << bench.message();
  EXPECT_TRUE(bench.good_within(1));
}

TEST(CameraPlanes, ItIsListedWithItsFormats) {
  CameraBench bench;
  in_planes(bench.camera());

  const auto cameras = drivers::v4l2::list_cameras(bench.kernel());

  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].formats, std::vector<std::string>{"GREY"});
}

TEST(CameraPlanes, WhereBothAreKnownTheOthersAreUsed) {
  CameraBench bench;
  bench.camera().caps |= V4L2_CAP_VIDEO_CAPTURE_MPLANE;

  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  EXPECT_TRUE(bench.good_within(1));
}

}  // namespace
}  // namespace tubesight::tests
