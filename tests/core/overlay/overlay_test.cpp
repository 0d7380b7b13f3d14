#include "core/overlay/overlay.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/overlay/palette.h"
#include "core/overlay/readout.h"
#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;
using tests::centroid_milli;
using tests::point_milli;

constexpr std::int32_t kWidth = 635;
constexpr std::int32_t kHeight = 480;

// An overlay of the camera's picture.
Canvas display() { return Canvas(kWidth, overlay_height_px(kWidth, kHeight)); }

std::vector<PixelPoint> marks_of(const Canvas& canvas, Rgb colour) {
  return canvas.pixels_of(colour, kHeight);
}

OverlayInput empty_input() {
  OverlayInput input;
  input.sighting.state = TrackState::kLost;
  input.sighting.reason = Reason::kJump;
  return input;
}

TubeSighting tube_at(std::int64_t u_milli, std::int64_t v_milli) {
  return {{3, 4}, point_milli(u_milli, v_milli), 9000, false};
}

TEST(CopyGrey, PutsTheSameValueIntoThreeChannels) {
  const std::array<std::uint8_t, 8> grey{10, 20, 99, 99, 30, 255, 99, 99};
  Canvas canvas(2, 2);

  copy_grey({grey.data(), 2, 2, 4}, canvas.view());

  EXPECT_EQ(canvas.at(0, 0), (Rgb{10, 10, 10}));
  EXPECT_EQ(canvas.at(1, 0), (Rgb{20, 20, 20}));
  EXPECT_EQ(canvas.at(0, 1), (Rgb{30, 30, 30}));
  EXPECT_EQ(canvas.at(1, 1), (Rgb{255, 255, 255}));
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(CopyGrey, LeavesTheLinesBelowAlone) {
  const std::array<std::uint8_t, 2> grey{10, 20};
  Canvas canvas(2, 3);
  canvas.set(0, 1, {1, 2, 3});

  copy_grey({grey.data(), 2, 1, 2}, canvas.view());

  EXPECT_EQ(canvas.at(1, 0), (Rgb{20, 20, 20}));
  EXPECT_EQ(canvas.at(0, 1), (Rgb{1, 2, 3}));
}

TEST(CopyGreyDeathTest, RefusesAnotherWidthAndTooFewLines) {
  const std::array<std::uint8_t, 8> grey{};
  Canvas wide(3, 2);
  Canvas low(2, 1);

  EXPECT_DEATH(copy_grey({grey.data(), 2, 2, 4}, wide.view()), "");
  EXPECT_DEATH(copy_grey({grey.data(), 2, 2, 4}, low.view()), "");
}

TEST(OverlayDeathTest, RefusesAPictureThatTheReadoutWouldFill) {
  Canvas canvas(kWidth, readout_height_px(kWidth));

  EXPECT_DEATH(draw_overlay(canvas.view(), empty_input()), "");
}

TEST(Overlay, WithoutKnowledgeLeavesTheWholeCamerasPictureAlone) {
  Canvas canvas = display();
  for (std::int32_t v = 0; v < canvas.height(); ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      canvas.set(u, v, {7, 8, 9});
    }
  }

  draw_overlay(canvas.view(), empty_input());

  EXPECT_GT(canvas.height(), kHeight);
  EXPECT_EQ(canvas.pixels_of({7, 8, 9}, kHeight).size(), std::size_t{kWidth} * kHeight);
  EXPECT_EQ(canvas.pixels_of({7, 8, 9}, canvas.height()).size(), std::size_t{kWidth} * kHeight);
}

TEST(Overlay, APictureTooNarrowForTheReadoutHasNone) {
  EXPECT_EQ(overlay_height_px(319, 240), 240);
  EXPECT_GT(overlay_height_px(320, 240), 240);
}

TEST(Overlay, ToolIsDrawnOnlyWhenKnown) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  input.sighting.tool_px = point_milli(300'000, 200'000);
  input.sighting.aligned = true;  // contradicts tool_known: nothing may be vouched for

  draw_overlay(canvas.view(), input);

  EXPECT_TRUE(canvas.pixels_of(palette::kTool, canvas.height()).empty());
  EXPECT_FALSE(canvas.find_text("ALIGNED", 2, palette::kBlack).has_value());
}

TEST(Overlay, AnUnknownDirectionIsLeftOut) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  input.sighting.primary_known = true;
  input.sighting.primary_px = point_milli(300'000, 200'000);
  input.next_column_px = point_milli(380'000, 200'000);

  draw_overlay(canvas.view(), input);

  EXPECT_TRUE(marks_of(canvas, palette::kRow).empty());
  EXPECT_FALSE(marks_of(canvas, palette::kColumn).empty());
}

TEST(Overlay, TubeEndsAreMarkedByKindAtTheirCentres) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  std::array<TubeSighting, 3> tubes{tube_at(100'300, 80'700), tube_at(200'600, 90'200),
                                    tube_at(300'100, 100'900)};
  tubes[1].quality_permyriad = 0;
  tubes[2].plug = true;
  input.tubes = tubes;

  draw_overlay(canvas.view(), input);

  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kUsed)), (PixelPoint{100'000, 81'000}));
  // A brush of two pixels is half a pixel off its line.
  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kRejected)), (PixelPoint{201'500, 90'500}));
  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kPlug)), (PixelPoint{300'000, 101'000}));
}

TEST(Overlay, EveryUsedTubeEndHasItsCrossHair) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  std::vector<TubeSighting> tubes;
  for (std::int32_t i = 0; i < kMaxTubesInView; ++i) {
    tubes.push_back(tube_at(1000 * (20 + 50 * (i % 12)), 1000 * (20 + 45 * (i / 12))));
  }
  input.tubes = tubes;

  draw_overlay(canvas.view(), input);

  // 11 + 11 - 1 pixels each, and one at each centre.
  EXPECT_EQ(marks_of(canvas, palette::kUsed).size(), tubes.size() * 21);
  for (std::int32_t i = 0; i < kMaxTubesInView; ++i) {
    EXPECT_EQ(canvas.at(20 + 50 * (i % 12), 20 + 45 * (i / 12)), palette::kUsed) << i;
  }
}

TEST(Overlay, PrimaryTubeHasTheAxesInPlaceOfACrossHairUnlessItIsRejected) {
  OverlayInput input = empty_input();
  std::array<TubeSighting, 1> tubes{tube_at(200'000, 200'000)};
  input.sighting.primary_known = true;
  input.sighting.primary = tubes[0].address;
  input.sighting.primary_px = tubes[0].center_px;
  input.tubes = tubes;
  Canvas used = display();
  draw_overlay(used.view(), input);
  tubes[0].quality_permyriad = 0;
  Canvas rejected = display();
  draw_overlay(rejected.view(), input);

  EXPECT_TRUE(marks_of(used, palette::kUsed).empty());
  EXPECT_FALSE(marks_of(rejected, palette::kRejected).empty());
}

TEST(Overlay, SearchWindowIsDrawnOnItsOwnOutermostPixels) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  input.window = PixelBox{40, 36, 595, 330};

  draw_overlay(canvas.view(), input);

  const auto pixels = marks_of(canvas, palette::kWindow);
  EXPECT_EQ(pixels.size(), 2U * 556U + 2U * 293U);
  for (const PixelPoint& p : pixels) {
    EXPECT_TRUE(p.u_px == 40 || p.u_px == 595 || p.v_px == 36 || p.v_px == 330);
    EXPECT_TRUE(p.u_px >= 40 && p.u_px <= 595 && p.v_px >= 36 && p.v_px <= 330);
  }
}

TEST(Overlay, OptimumAndAxisPointStandOnTheirPixels) {
  Canvas canvas = display();
  OverlayInput input = empty_input();
  input.optimum_px = point_milli(317'600, 190'400);
  input.sighting.axis_known = true;
  input.sighting.axis_px = point_milli(402'200, 250'700);

  draw_overlay(canvas.view(), input);

  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kWindow)), (PixelPoint{318'000, 190'000}));
  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kAxis)), (PixelPoint{402'000, 251'000}));
}

TEST(Overlay, MarksThatLeaveThePictureNeverComeInOnTheOtherSide) {
  // The centre lies up to the mark's size outside; nothing may appear in the opposite half.
  for (const auto& [u, v] : {std::pair{-3, 200}, {638, 200}, {300, -4}, {-2, -2}, {640, -6}}) {
    Canvas canvas = display();
    OverlayInput input = empty_input();
    const std::array<TubeSighting, 1> tubes{tube_at(1000 * u, 1000 * v)};
    input.tubes = tubes;
    input.sighting.tool_known = true;
    input.sighting.tool_px = tubes[0].center_px;
    input.sighting.axis_known = true;
    input.sighting.axis_px = tubes[0].center_px;
    input.sighting.primary_known = true;
    input.sighting.primary_px = tubes[0].center_px;
    input.next_row_px = point_milli(1000 * u, 1000 * (v + 60));
    input.next_column_px = point_milli(1000 * (u + 20), 1000 * v);
    const std::array<Click, 1> clicks{Click{tubes[0].center_px, {3, 4}, ClickVerdict::kBlamed}};
    input.news.clicks = clicks;
    input.news.claimed_px = tubes[0].center_px;

    draw_overlay(canvas.view(), input);

    for (const Rgb colour :
         {palette::kTool, palette::kUsed, palette::kRow, palette::kColumn, palette::kAxis,
          palette::kWhite, palette::kClaim, palette::kClickRefused}) {
      for (const PixelPoint& pixel : marks_of(canvas, colour)) {
        EXPECT_LE(std::abs(pixel.u_px - u), 60) << u << ", " << v;
        EXPECT_LE(std::abs(pixel.v_px - v), 60) << u << ", " << v;
      }
    }
    EXPECT_TRUE(canvas.guards_intact());
  }
}

// Every mark with its point on the camera's last line, and then far above.
TEST(Overlay, NoMarkReachesTheReadout) {
  const auto drawn_at = [](std::int64_t v_px) {
    Canvas canvas = display();
    OverlayInput input = empty_input();
    const ImagePoint at = point_milli(300'000, 1000 * v_px);
    Sighting& s = input.sighting;
    s.tool_known = s.primary_known = true;
    s.tool_px = s.primary_px = at;
    input.next_row_px = point_milli(300'000, 1000 * (v_px + 60));
    input.next_column_px = point_milli(380'000, 1000 * v_px);
    const std::array<TubeSighting, 1> tubes{TubeSighting{{9, 9}, at, 0, true}};
    input.tubes = tubes;
    const std::array<Estimate, 1> estimates{Estimate{{9, 9}, at, TubeState::kPlugged}};
    input.estimates = estimates;
    const std::array<Click, 1> clicks{Click{at, {9, 9}, ClickVerdict::kTaken}};
    input.news.clicks = clicks;
    input.news.claimed_px = at;
    input.optimum_px = at;
    draw_overlay(canvas.view(), input);
    std::vector<Rgb> below;
    for (std::int32_t v = kHeight; v < canvas.height(); ++v) {
      for (std::int32_t u = 0; u < kWidth; ++u) {
        below.push_back(canvas.at(u, v));
      }
    }
    return below;
  };

  EXPECT_EQ(drawn_at(kHeight - 1), drawn_at(-1000));
}

TEST(Overlay, MarksGrowWithThePicturesWidth) {
  for (const std::int32_t times : {1, 2, 3}) {
    const std::int32_t width = 640 * times;
    const std::int32_t height = 480 * times;
    Canvas canvas(width, overlay_height_px(width, height));
    OverlayInput input = empty_input();
    const std::array<TubeSighting, 1> tubes{tube_at(200'000 * times, 200'000 * times)};
    input.tubes = tubes;
    input.sighting.tool_known = true;
    input.sighting.tool_px = point_milli(400'000 * times, 200'000 * times);

    draw_overlay(canvas.view(), input);

    const auto size_of = [&](Rgb colour) {
      const auto pixels = canvas.pixels_of(colour, height);
      return pixels.back().v_px - pixels.front().v_px + 1;
    };
    EXPECT_EQ(size_of(palette::kUsed), 10 * times + 1);
    EXPECT_EQ(size_of(palette::kTool), 2 * 38 * times + 1);
    // A brush as thick as the picture is large.
    EXPECT_EQ(canvas.pixels_of(palette::kUsed, 196 * times).size(),
              static_cast<std::size_t>(times * times));
  }
}

// Numbers as they may stand in uninitialised or mistaken bytes, the outermost often among them.
class AnyNumbers {
 public:
  explicit AnyNumbers(unsigned seed) : random_(seed) {}

  std::int32_t below(unsigned limit) { return static_cast<std::int32_t>(random_() % limit); }
  bool coin() { return random_() % 2 == 0; }
  std::int32_t number() {
    constexpr std::array<std::int32_t, 6> kEdges{std::numeric_limits<std::int32_t>::min(),
                                                 std::numeric_limits<std::int32_t>::max(),
                                                 0,
                                                 -1,
                                                 635 * 65536,
                                                 480};
    return random_() % 3 == 0 ? kEdges[random_() % kEdges.size()]
                              : static_cast<std::int32_t>(random_());
  }
  std::int64_t large() { return std::int64_t{number()} * 4'294'967'295; }
  ImagePoint point() { return {number(), number()}; }
  TubeAddress address() { return {number(), number()}; }

  Sighting sighting() {
    Sighting s;
    s.time = FieldTime(large());
    s.state = static_cast<TrackState>(below(4));
    s.reason = static_cast<Reason>(below(21));
    s.tracked = number();
    s.primary_known = s.axis_known = s.tool_known = s.judged = true;
    s.primary = address();
    s.tool = address();
    s.primary_px = point();
    s.axis_px = point();
    s.tool_px = point();
    s.height_um_q8 = number();
    s.offset_um_q8 = number();
    s.residual_px_q16 = number();
    s.aligned = coin();
    return s;
  }

 private:
  std::mt19937 random_;
};

// Any bits may arrive here when the tracker is lost: no input may write outside the picture.
TEST(Overlay, AnyInputLeavesTheBytesAroundThePictureAlone) {
  constexpr unsigned kSeed = 20'240'611;
  AnyNumbers any(kSeed);
  for (int round = 0; round < 300; ++round) {
    const std::int32_t width_px = 1 + any.below(700);
    Canvas canvas(width_px, overlay_height_px(width_px, 1 + any.below(300)));
    OverlayInput input;
    input.sighting = any.sighting();
    const std::array<TubeSighting, 2> tubes{
        TubeSighting{any.address(), any.point(), any.number(), false},
        TubeSighting{any.address(), any.point(), any.number(), true}};
    const std::array<Estimate, 2> estimates{
        Estimate{any.address(), any.point(), TubeState::kOpen},
        Estimate{any.address(), any.point(), TubeState::kAbsent}};
    const std::array<Click, 2> clicks{Click{any.point(), any.address(), ClickVerdict::kBlamed},
                                      Click{any.point(), any.address(), ClickVerdict::kTaken}};
    input.tubes = tubes;
    input.estimates = estimates;
    input.window = PixelBox{any.number(), any.number(), any.number(), any.number()};
    input.optimum_px = any.point();
    input.next_row_px = any.point();
    input.next_column_px = any.point();
    input.tool_rim = HalfSize{any.number(), any.number()};
    input.aligned_within_um_q8 = any.number();
    input.news.clicks = clicks;
    input.news.refusal = static_cast<StartRefusal>(any.below(14));
    input.news.claim =
        ClaimReply{any.address(), static_cast<ClaimVerdict>(any.below(3)),
                   static_cast<ClaimDoubt>(any.below(9)), any.address(), any.number()};
    input.news.claimed_px = any.point();
    input.field = any.large();

    draw_overlay(canvas.view(), input);

    ASSERT_TRUE(canvas.guards_intact()) << "seed " << kSeed << ", round " << round;
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
