// A mission seen through the driver of a camera: the shipped recording, laid into the buffers of a
// fake kernel's camera, is tracked as its replay is, in whatever format and order of fields it
// comes.

#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/scalar.h"
#include "drivers/v4l2/v4l2_frame_grabber.h"
#include "tests/benchmark/recorded_session.h"
#include "tests/drivers/v4l2/fake_kernel.h"

namespace tubesight::tests {
namespace {

using core::FixedPoint;
using std::chrono::milliseconds;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush";
constexpr const char* kDevice = "/dev/v4l/by-path/camera";

/// How the camera delivers.
struct Delivery {
  std::string name;
  std::uint32_t format;
  std::uint32_t field;
};

class CameraMission : public testing::TestWithParam<Delivery> {
 protected:
  void SetUp() override {
    drivers::Messages messages;
    ASSERT_TRUE(mission_.load(kFolder, messages));
    const core::CameraSettings& camera = mission_.settings().camera;
    settings_.device = kDevice;
    settings_.width_px = camera.width_px;
    settings_.height_px = camera.height_px;
    settings_.scan = camera.scan;
    kernel_.link(kDevice, "/dev/video0");
    camera_->formats = {GetParam().format};
    camera_->fields = {GetParam().field};
    camera_->padding_bytes = 10;
    const core::FieldTime span =
        mission_.fields()[1].mid_exposure - mission_.fields()[0].mid_exposure;
    const bool alternate = GetParam().field == V4L2_FIELD_ALTERNATE;
    camera_->every = alternate ? span : 2 * span;
    camera_->tamper = [this, alternate](std::int64_t number, v4l2_buffer& buffer,
                                        std::span<std::byte> memory) {
      for (int i = 0; i < (alternate ? 1 : 2); ++i) {
        const std::size_t at = static_cast<std::size_t>(alternate ? number : 2 * number + i);
        if (at < mission_.fields().size()) {
          lay(mission_.fields()[at], buffer.field, memory);
        }
      }
    };
    ASSERT_TRUE(session_.configure(mission_.settings()));
  }

  /// The pixels of a field into their places of a buffer.
  void lay(const core::Field& field, std::uint32_t order, std::span<std::byte> memory) const {
    const core::FieldView& view = field.pixels;
    const std::size_t bytes_a_pixel = bytes_of(GetParam().format);
    const std::size_t first =
        GetParam().format == V4L2_PIX_FMT_UYVY || GetParam().format == V4L2_PIX_FMT_Y16 ? 1 : 0;
    const auto width = static_cast<std::size_t>(view.width_px);
    const std::size_t stride = width * bytes_a_pixel + camera_->padding_bytes;
    for (std::int32_t line = 0; line < view.lines; ++line) {
      std::int32_t to = view.first_line + line * view.line_step;
      if (order == V4L2_FIELD_TOP || order == V4L2_FIELD_BOTTOM) {
        to = line;
      } else if (V4L2_FIELD_IS_SEQUENTIAL(order)) {
        const bool above = (view.first_line == 0) == (order == V4L2_FIELD_SEQ_TB);
        to = line + (above ? 0 : settings_.height_px / 2);
      }
      for (std::size_t u = 0; u < width; ++u) {
        memory[static_cast<std::size_t>(to) * stride + u * bytes_a_pixel + first] =
            static_cast<std::byte>(view.pixels[static_cast<std::ptrdiff_t>(line) * view.stride_px +
                                               static_cast<std::ptrdiff_t>(u)]);
      }
    }
  }
  static std::size_t bytes_of(std::uint32_t format) {
    return format == V4L2_PIX_FMT_GREY || format == V4L2_PIX_FMT_NV12 ? 1 : 2;
  }

  RecordedSession mission_;
  FakeKernel kernel_;
  std::shared_ptr<FakeCamera> camera_ = kernel_.plug(0, std::make_shared<FakeCamera>());
  drivers::V4l2Settings settings_;
  SessionRun<FixedPoint> session_;
};

TEST_P(CameraMission, IsSeenAsItsReplayIs) {
  SessionRun<FixedPoint> replay;
  ASSERT_TRUE(replay.configure(mission_.settings()));
  drivers::V4l2FrameGrabber grabber(settings_, kernel_, kernel_);
  ASSERT_TRUE(grabber.start()) << grabber.messages().front();
  int aligned = 0;
  for (std::size_t i = 0; i < mission_.fields().size(); ++i) {
    const auto lease = grabber.grab_for(milliseconds(100));
    ASSERT_TRUE(lease) << i;
    ASSERT_EQ(lease->field().status, core::FieldStatus::kGood) << i;
    session_.give(lease->field());
    session_.step();
    replay.give(mission_.fields()[i]);
    replay.step();

    const core::Sighting& seen = session_.output().sighting;
    const core::Sighting& expected = replay.output().sighting;
    ASSERT_EQ(seen.state, expected.state) << i;
    ASSERT_EQ(seen.tool_known, expected.tool_known) << i;
    EXPECT_EQ(seen.tool, expected.tool) << i;
    EXPECT_EQ(seen.primary, expected.primary) << i;
    EXPECT_EQ(seen.tracked, expected.tracked) << i;
    EXPECT_EQ(seen.aligned, expected.aligned) << i;
    // Drivers' stamps are whole microseconds: what is predicted from them differs by as little.
    EXPECT_NEAR(seen.offset_um_q8, expected.offset_um_q8, 256) << i;
    aligned += seen.aligned ? 1 : 0;
  }
  EXPECT_EQ(aligned, 11) << "as in expected_fields.csv";
  EXPECT_EQ(grabber.report().counters.lost_fields, 0);
}

using CameraAway = CameraMission;

TEST_P(CameraAway, NothingIsVouchedForUntilTheNextStart) {
  drivers::V4l2FrameGrabber grabber(settings_, kernel_, kernel_);
  ASSERT_TRUE(grabber.start());
  for (int i = 0; i < 20; ++i) {
    const auto lease = grabber.grab_for(milliseconds(100));
    ASSERT_TRUE(lease);
    session_.give(lease->field());
    session_.step();
  }
  ASSERT_EQ(session_.output().sighting.state, core::TrackState::kTracking);
  kernel_.unplug(0);
  ASSERT_FALSE(grabber.grab_for(milliseconds(100)));
  grabber.stop();
  kernel_.plug(5, camera_);
  kernel_.link(kDevice, "/dev/video5");
  kernel_.advance(milliseconds(200));
  ASSERT_TRUE(grabber.start());

  for (int i = 0; i < 20; ++i) {
    const auto lease = grabber.grab_for(milliseconds(100));
    ASSERT_TRUE(lease);
    session_.give(lease->field());
    session_.step();
    EXPECT_NE(session_.output().sighting.state, core::TrackState::kTracking) << i;
    EXPECT_FALSE(session_.output().sighting.aligned) << i;
  }
  EXPECT_EQ(session_.output().sighting.state, core::TrackState::kLost);
}

INSTANTIATE_TEST_SUITE_P(
    Deliveries, CameraMission,
    testing::Values(Delivery{"GreyInterlaced", V4L2_PIX_FMT_GREY, V4L2_FIELD_INTERLACED},
                    Delivery{"YuyvInterlaced", V4L2_PIX_FMT_YUYV, V4L2_FIELD_INTERLACED},
                    Delivery{"UyvySequential", V4L2_PIX_FMT_UYVY, V4L2_FIELD_SEQ_TB},
                    Delivery{"Y16Sequential", V4L2_PIX_FMT_Y16, V4L2_FIELD_SEQ_BT},
                    Delivery{"GreyAlternate", V4L2_PIX_FMT_GREY, V4L2_FIELD_ALTERNATE}),
    [](const auto& delivery) { return delivery.param.name; });
INSTANTIATE_TEST_SUITE_P(Deliveries, CameraAway,
                         testing::Values(Delivery{"GreyInterlaced", V4L2_PIX_FMT_GREY,
                                                  V4L2_FIELD_INTERLACED}),
                         [](const auto& delivery) { return delivery.param.name; });

}  // namespace
}  // namespace tubesight::tests
