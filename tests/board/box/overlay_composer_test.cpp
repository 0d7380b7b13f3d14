#include "board/box/overlay_composer.h"

#include <array>
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
    news_.take(input, *output_);
    ASSERT_EQ(output_->sighting.state, core::TrackState::kTracking);
    describe<FixedPoint>(*session_, *output_, news_, 0, false, *snapshot_);
  }

  std::unique_ptr<drivers::SessionFile> file_ = std::make_unique<drivers::SessionFile>();
  std::unique_ptr<drivers::ReplayFrameGrabber> grabber_;
  std::unique_ptr<core::session::Session<FixedPoint>> session_ =
      std::make_unique<core::session::Session<FixedPoint>>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  OverlayNews news_;
  std::unique_ptr<OverlaySnapshot> snapshot_ = std::make_unique<OverlaySnapshot>();
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

// Colours of one pixel or more in the camera's part of the picture.
bool shows(const core::RgbImageView& picture, std::int32_t height_px, Rgb colour) {
  for (std::int32_t v = 0; v < height_px; ++v) {
    for (std::int32_t u = 0; u < picture.width_px; ++u) {
      if (pixel_of(picture, {u, v}) == colour) {
        return true;
      }
    }
  }
  return false;
}

TEST_F(OverlayComposerTest, FramesTheRimAsItIsSeenThere) {
  OverlayComposer composer(file_->settings);

  const auto picture = composer.compose(grabber_->frame(), *snapshot_);

  // The ray tracer's own account of the tube-end: centers.csv, frame 4, half_w and half_h.
  constexpr std::array<std::int32_t, 2> kRimHalf_px{31, 23};
  const PixelPoint centre = core::overlay::nearest_pixel(output_->sighting.tool_px);
  const auto is_frame = [&](std::int32_t u, std::int32_t v) {
    return pixel_of(picture, {centre.u_px + u, centre.v_px + v}) == core::overlay::palette::kTool;
  };
  std::int32_t left = 0;
  while (left < 100 && !is_frame(-left, -10)) {
    ++left;
  }
  std::int32_t up = 0;
  while (up < 100 && !is_frame(-15, -up)) {
    ++up;
  }
  // Four pixels of gap; the rim's image is a little off its middle by perspective.
  EXPECT_NEAR(left, kRimHalf_px[0] + 5, 3);
  EXPECT_NEAR(up, kRimHalf_px[1] + 5, 3);
}

TEST_F(OverlayComposerTest, ShowsTheClicksOfTheStart) {
  OverlayComposer composer(file_->settings);

  const auto picture = composer.compose(grabber_->frame(), *snapshot_);

  EXPECT_TRUE(shows(picture, 480, core::overlay::palette::kClick));
  EXPECT_FALSE(shows(picture, 480, core::overlay::palette::kClickRefused));
}

TEST_F(OverlayComposerTest, ShowsWhereAContradictedClaimIs) {
  OverlayComposer composer(file_->settings);
  core::Reply reply;
  const core::TubeAddress tool = output_->sighting.tool;
  const core::TubeAddress claimed{tool.row, tool.column + 1};
  reply.content = core::ClaimReply{claimed, core::ClaimVerdict::kContradicted,
                                   core::ClaimDoubt::kNone, tool, 0};
  ASSERT_TRUE(output_->replies.try_push_back(reply));
  news_.take({}, *output_);
  describe<FixedPoint>(*session_, *output_, news_, 0, false, *snapshot_);

  const auto picture = composer.compose(grabber_->frame(), *snapshot_);

  core::ImagePoint at{};
  ASSERT_TRUE(session_->tracker().locate(claimed, at));
  EXPECT_EQ(pixel_of(picture, core::overlay::nearest_pixel(at)), core::overlay::palette::kClaim);
}

TEST_F(OverlayComposerTest, DrawsTheAxesFromThePrimaryTubeTowardsItsNeighbours) {
  OverlayComposer composer(file_->settings);
  const core::TubeAddress primary = output_->sighting.primary;
  core::ImagePoint row{};
  core::ImagePoint column{};
  // The settings' steps alone say which neighbour is which.
  ASSERT_TRUE(session_->tracker().locate({primary.row + 1, primary.column}, row));
  ASSERT_TRUE(session_->tracker().locate({primary.row, primary.column + 1}, column));

  // Without the pins of the start, which stand over all other marks.
  describe<FixedPoint>(*session_, *output_, OverlayNews(), 0, false, *snapshot_);

  const auto picture = composer.compose(grabber_->frame(), *snapshot_);

  const core::ImagePoint origin = output_->sighting.primary_px;
  EXPECT_EQ(pixel_of(picture, between(origin, row, 0.6)), core::overlay::palette::kRow);
  EXPECT_EQ(pixel_of(picture, between(origin, column, 0.6)), core::overlay::palette::kColumn);
}

TEST_F(OverlayComposerTest, KeepsTheRecordedPictureInGreyWhereNoMarkIs) {
  OverlayComposer composer(file_->settings);
  const core::ImageView frame = grabber_->frame();

  const auto picture = composer.compose(frame, *snapshot_);

  ASSERT_EQ(picture.width_px, frame.width_px);
  EXPECT_EQ(picture.height_px, core::overlay::overlay_height_px(frame.width_px, frame.height_px));
  // Above the search window there are no marks, nor where the guidetube stands.
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    if (v >= file_->settings.start.window_px[1] - 4 && v <= file_->settings.start.window_px[3]) {
      continue;
    }
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      const std::uint8_t grey = frame.line(v)[u];
      ASSERT_EQ(pixel_of(picture, {u, v}), (Rgb{grey, grey, grey})) << u << ", " << v;
    }
  }
}

TEST_F(OverlayComposerTest, DrawsEstimatesOnlyWhenAsked) {
  OverlayComposer composer(file_->settings);
  const auto bytes_of = [](const core::RgbImageView& picture) {
    return std::vector<std::uint8_t>(
        picture.pixels,
        picture.pixels + static_cast<std::ptrdiff_t>(picture.height_px) * picture.stride_bytes);
  };

  const auto plain = bytes_of(composer.compose(grabber_->frame(), *snapshot_));
  describe<FixedPoint>(*session_, *output_, news_, 0, true, *snapshot_);
  const auto marked = bytes_of(composer.compose(grabber_->frame(), *snapshot_));
  describe<FixedPoint>(*session_, *output_, news_, 0, false, *snapshot_);
  const auto again = bytes_of(composer.compose(grabber_->frame(), *snapshot_));

  EXPECT_NE(plain, marked);
  EXPECT_EQ(plain, again);
}

}  // namespace
}  // namespace tubesight::board
