#include "board/bench/overlay_composer.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/overlay/palette.h"
#include "core/overlay/pixels.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {
namespace {

using core::FixedPoint;
using core::overlay::PixelPoint;
using core::overlay::Rgb;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";

/// The shipped recording with its first field processed.
class OverlayComposerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    drivers::Messages messages;
    ASSERT_TRUE(drivers::load_session_settings(std::string(kFolder) + "session.toml",
                                               drivers::kReplayNeeds, *file_, messages));
    grabber_ = std::make_unique<drivers::ReplayFrameGrabber>(
        file_->settings.camera, std::string(kFolder) + "recording.y4m.xz");
    ASSERT_TRUE(grabber_->start());
    ASSERT_TRUE(session_->configure(file_->settings));
    const auto lease = grabber_->grab_for(std::chrono::milliseconds(0));
    ASSERT_TRUE(lease.has_value());
    core::Event start;
    start.content = core::Start{file_->settings.start.tubes, {}, false};
    core::session::Input input;
    ASSERT_TRUE(input.events.try_push_back(start));
    input.field = lease->field();
    session_->step(input, *output_);
    ASSERT_EQ(output_->sighting.state, core::TrackState::kTracking);
  }

  std::unique_ptr<drivers::SessionFile> file_ = std::make_unique<drivers::SessionFile>();
  std::unique_ptr<drivers::ReplayFrameGrabber> grabber_;
  std::unique_ptr<core::session::Session<FixedPoint>> session_ =
      std::make_unique<core::session::Session<FixedPoint>>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
};

Rgb pixel_of(const core::RgbImageView& picture, PixelPoint at) {
  const std::uint8_t* const p = picture.pixels +
                                static_cast<std::ptrdiff_t>(at.v_px) * picture.stride_bytes +
                                std::ptrdiff_t{3} * at.u_px;
  return {p[0], p[1], p[2]};
}

/// The pixel at `part` of the way from one point to another.
PixelPoint between(core::ImagePoint from, core::ImagePoint to, double part) {
  const auto mix = [part](std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(a + part * (b - a));
  };
  return core::overlay::nearest_pixel({mix(from.u_q16, to.u_q16), mix(from.v_q16, to.v_q16)});
}

TEST_F(OverlayComposerTest, DrawsTheAxesFromThePrimaryTubeTowardsItsNeighbours) {
  OverlayComposer<FixedPoint> composer(file_->settings, false);
  const core::TubeAddress primary = output_->sighting.primary;
  core::ImagePoint row{};
  core::ImagePoint column{};
  // The settings' steps alone say which neighbour is which.
  ASSERT_TRUE(session_->tracker().locate({primary.row + 1, primary.column}, row));
  ASSERT_TRUE(session_->tracker().locate({primary.row, primary.column + 1}, column));

  const auto picture = composer.compose(grabber_->frame(), 0, *session_, *output_);

  const core::ImagePoint origin = output_->sighting.primary_px;
  EXPECT_EQ(pixel_of(picture, between(origin, row, 0.5)), core::overlay::palette::kRow);
  EXPECT_EQ(pixel_of(picture, between(origin, column, 0.5)), core::overlay::palette::kColumn);
}

TEST_F(OverlayComposerTest, KeepsTheRecordedPictureInGreyWhereNoMarkIs) {
  OverlayComposer<FixedPoint> composer(file_->settings, false);
  const core::ImageView frame = grabber_->frame();

  const auto picture = composer.compose(frame, 0, *session_, *output_);

  ASSERT_EQ(picture.width_px, frame.width_px);
  ASSERT_EQ(picture.height_px, frame.height_px);
  // Above the search window there are no marks.
  for (std::int32_t v = 0; v < file_->settings.start.window_px[1] - 4; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      const std::uint8_t grey = frame.line(v)[u];
      ASSERT_EQ(pixel_of(picture, {u, v}), (Rgb{grey, grey, grey})) << u << ", " << v;
    }
  }
}

TEST_F(OverlayComposerTest, DrawsEstimatesOnlyWhenAsked) {
  OverlayComposer<FixedPoint> without(file_->settings, false);
  OverlayComposer<FixedPoint> with(file_->settings, true);
  const auto bytes_of = [](const core::RgbImageView& picture) {
    return std::vector<std::uint8_t>(
        picture.pixels,
        picture.pixels + static_cast<std::ptrdiff_t>(picture.height_px) * picture.stride_bytes);
  };

  const auto plain = bytes_of(without.compose(grabber_->frame(), 0, *session_, *output_));
  const auto marked = bytes_of(with.compose(grabber_->frame(), 0, *session_, *output_));

  EXPECT_NE(plain, marked);
}

}  // namespace
}  // namespace tubesight::board
