#include "core/overlay/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// Line where the readout's box begins.
std::int32_t box_top(const Canvas& canvas) {
  return canvas.height() - readout_height_px(canvas.width(), canvas.height());
}

std::vector<PixelPoint> marks_of(const Canvas& canvas, Rgb colour) {
  return canvas.pixels_of(colour, box_top(canvas));
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

TEST(CopyGreyDeathTest, RefusesAnotherSize) {
  const std::array<std::uint8_t, 8> grey{};
  Canvas canvas(2, 3);

  EXPECT_DEATH(copy_grey({grey.data(), 2, 2, 4}, canvas.view()), "");
}

TEST(Overlay, WithoutKnowledgeDrawsTheReadoutAlone) {
  Canvas canvas(kWidth, kHeight);
  for (std::int32_t v = 0; v < kHeight; ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      canvas.set(u, v, {7, 8, 9});
    }
  }

  draw_overlay(canvas.view(), empty_input());

  const auto untouched = marks_of(canvas, {7, 8, 9});
  EXPECT_EQ(untouched.size(), static_cast<std::size_t>(kWidth * box_top(canvas)));
}

class ToolCrossHair : public testing::TestWithParam<std::array<std::int64_t, 2>> {};

TEST_P(ToolCrossHair, StandsOnTheNearestPixel) {
  const auto [u_milli, v_milli] = GetParam();
  for (const bool aligned : {false, true}) {
    Canvas canvas(kWidth, kHeight);
    OverlayInput input = empty_input();
    input.sighting.tool_known = true;
    input.sighting.tool_px = point_milli(u_milli, v_milli);
    input.sighting.aligned = aligned;

    draw_overlay(canvas.view(), input);

    const auto blue = marks_of(canvas, palette::kTool);
    ASSERT_FALSE(blue.empty());
    const PixelPoint center = centroid_milli(blue);
    EXPECT_LE(std::abs(center.u_px - u_milli), 501);
    EXPECT_LE(std::abs(center.v_px - v_milli), 501);
    // Large: some 50 px to each side, and symmetrical.
    const auto [left, right] = std::minmax_element(
        blue.begin(), blue.end(),
        [](const PixelPoint& a, const PixelPoint& b) { return a.u_px < b.u_px; });
    EXPECT_EQ(right->u_px - left->u_px, 104);
    EXPECT_EQ(blue.back().v_px - blue.front().v_px, 104);
    // The middle tells whether the box vouches for the tube.
    const PixelPoint middle = nearest_pixel(input.sighting.tool_px);
    EXPECT_EQ(canvas.at(middle.u_px, middle.v_px) == palette::kTool, aligned);
  }
}

INSTANTIATE_TEST_SUITE_P(Places, ToolCrossHair,
                         testing::Values(std::array<std::int64_t, 2>{318'000, 190'000},
                                         std::array<std::int64_t, 2>{100'400, 90'600},
                                         std::array<std::int64_t, 2>{200'499, 300'501},
                                         std::array<std::int64_t, 2>{580'999, 53'001}));

TEST(Overlay, ToolIsDrawnOnlyWhenKnown) {
  Canvas canvas(kWidth, kHeight);
  OverlayInput input = empty_input();
  input.sighting.tool_px = point_milli(300'000, 200'000);
  input.sighting.aligned = true;  // contradicts tool_known: nothing may be vouched for

  draw_overlay(canvas.view(), input);

  EXPECT_TRUE(canvas.pixels_of(palette::kTool, kHeight).empty());
  EXPECT_FALSE(canvas.find_text("ALIGNED", 2, palette::kBlack).has_value());
}

struct AxesCase {
  std::int64_t row_u;  // from the primary tube to the next row's, px
  std::int64_t row_v;
  std::int64_t column_u;
  std::int64_t column_v;
};

class Axes : public testing::TestWithParam<AxesCase> {};

// Each pixel of an axis lies on the ray from the primary tube to its neighbour, as far as the brush
// and the arrow head allow, and the farthest one stands at four fifths of the way.
void expect_axis(const std::vector<PixelPoint>& pixels, PixelPoint origin, std::int64_t du,
                 std::int64_t dv) {
  ASSERT_GT(pixels.size(), 60U);
  const double length = std::hypot(static_cast<double>(du), static_cast<double>(dv));
  double farthest = 0.0;
  for (const PixelPoint& pixel : pixels) {
    const double u = pixel.u_px - origin.u_px;
    const double v = pixel.v_px - origin.v_px;
    const double along = (u * static_cast<double>(du) + v * static_cast<double>(dv)) / length;
    const double across = (u * static_cast<double>(dv) - v * static_cast<double>(du)) / length;
    farthest = std::max(farthest, along);
    EXPECT_GE(along, 0.0);
    // The head is 5 px to each side, the brush reaches 1.42 px, rounding 0.71 px and 0.25 px more.
    EXPECT_LE(std::abs(across), along < 0.8 * length - 14.0 ? 2.4 : 7.4);
  }
  // The brush reaches 1 to 1.42 px beyond the tip, which is rounded by up to 0.71 px.
  EXPECT_NEAR(farthest, 0.8 * length + 1.0, 1.2);
}

TEST_P(Axes, PointAlongPositiveRowAndColumn) {
  const AxesCase& axes = GetParam();
  const PixelPoint origin{300, 200};
  Canvas canvas(kWidth, kHeight);
  OverlayInput input = empty_input();
  input.sighting.primary_known = true;
  input.sighting.primary_px = point_milli(300'000, 200'000);
  input.next_row_px = point_milli(1000 * (300 + axes.row_u), 1000 * (200 + axes.row_v));
  input.next_column_px = point_milli(1000 * (300 + axes.column_u), 1000 * (200 + axes.column_v));

  draw_overlay(canvas.view(), input);

  const auto corner = marks_of(canvas, palette::kWhite);
  ASSERT_EQ(corner.size(), 25U);
  EXPECT_EQ(centroid_milli(corner), (PixelPoint{300'000, 200'000}));
  expect_axis(marks_of(canvas, palette::kRow), origin, axes.row_u, axes.row_v);
  expect_axis(marks_of(canvas, palette::kColumn), origin, axes.column_u, axes.column_v);
}

INSTANTIATE_TEST_SUITE_P(Directions, Axes,
                         testing::Values(AxesCase{0, 60, 80, 0},       // as in the recordings
                                         AxesCase{80, 0, 0, -60},      // camera turned by 90 deg
                                         AxesCase{0, -60, -80, 0},     // by 180 deg
                                         AxesCase{0, 60, -80, 0},      // left-handed
                                         AxesCase{40, 55, 82, -3},     // triangular
                                         AxesCase{-61, -43, 50, -52},  // turned by 45 deg
                                         AxesCase{-7, 90, -100, -21}));

TEST(Overlay, AnUnknownDirectionIsLeftOut) {
  Canvas canvas(kWidth, kHeight);
  OverlayInput input = empty_input();
  input.sighting.primary_known = true;
  input.sighting.primary_px = point_milli(300'000, 200'000);
  input.next_column_px = point_milli(380'000, 200'000);

  draw_overlay(canvas.view(), input);

  EXPECT_TRUE(marks_of(canvas, palette::kRow).empty());
  EXPECT_FALSE(marks_of(canvas, palette::kColumn).empty());
}

TEST(Overlay, TubeEndsAreMarkedByKindAtTheirCentres) {
  Canvas canvas(kWidth, kHeight);
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
  Canvas canvas(kWidth, kHeight);
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
  Canvas used(kWidth, kHeight);
  draw_overlay(used.view(), input);
  tubes[0].quality_permyriad = 0;
  Canvas rejected(kWidth, kHeight);
  draw_overlay(rejected.view(), input);

  EXPECT_TRUE(marks_of(used, palette::kUsed).empty());
  EXPECT_FALSE(marks_of(rejected, palette::kRejected).empty());
}

TEST(Overlay, SearchWindowIsDrawnOnItsOwnOutermostPixels) {
  Canvas canvas(kWidth, kHeight);
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
  Canvas canvas(kWidth, kHeight);
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
    Canvas canvas(kWidth, kHeight);
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

    draw_overlay(canvas.view(), input);

    for (const Rgb colour : {palette::kTool, palette::kUsed, palette::kRow, palette::kColumn,
                             palette::kAxis, palette::kWhite}) {
      for (const PixelPoint& pixel : marks_of(canvas, colour)) {
        EXPECT_LE(std::abs(pixel.u_px - u), 60) << u << ", " << v;
        EXPECT_LE(std::abs(pixel.v_px - v), 60) << u << ", " << v;
      }
    }
    EXPECT_TRUE(canvas.guards_intact());
  }
}

// Any bits may arrive here when the tracker is lost: no input may write outside the picture.
TEST(Overlay, AnyInputLeavesTheBytesAroundThePictureAlone) {
  constexpr unsigned kSeed = 20'240'611;
  std::mt19937 random(kSeed);
  const auto number = [&]() -> std::int32_t {
    constexpr std::array<std::int32_t, 6> kEdges{std::numeric_limits<std::int32_t>::min(),
                                                 std::numeric_limits<std::int32_t>::max(),
                                                 0,
                                                 -1,
                                                 635 * 65536,
                                                 480};
    return random() % 3 == 0 ? kEdges[random() % kEdges.size()]
                             : static_cast<std::int32_t>(random());
  };
  const auto point = [&] { return ImagePoint{number(), number()}; };
  for (int round = 0; round < 300; ++round) {
    Canvas canvas(1 + static_cast<std::int32_t>(random() % 700),
                  1 + static_cast<std::int32_t>(random() % 300));
    OverlayInput input;
    Sighting& s = input.sighting;
    s.time = FieldTime(std::int64_t{number()} * 4'294'967'295);
    s.state = static_cast<TrackState>(random() % 4);
    s.reason = static_cast<Reason>(random() % 15);
    s.tracked = number();
    s.primary_known = s.axis_known = s.tool_known = true;
    s.primary = {number(), number()};
    s.tool = {number(), number()};
    s.primary_px = point();
    s.axis_px = point();
    s.tool_px = point();
    s.height_um_q8 = number();
    s.offset_um_q8 = number();
    s.aligned = random() % 2 == 0;
    const std::array<TubeSighting, 2> tubes{
        TubeSighting{{number(), number()}, point(), number(), false},
        TubeSighting{{number(), number()}, point(), number(), true}};
    const std::array<Estimate, 2> estimates{
        Estimate{{number(), number()}, point(), TubeState::kOpen},
        Estimate{{number(), number()}, point(), TubeState::kAbsent}};
    input.tubes = tubes;
    input.estimates = estimates;
    input.window = PixelBox{number(), number(), number(), number()};
    input.optimum_px = point();
    input.next_row_px = point();
    input.next_column_px = point();
    input.field = std::int64_t{number()} * 4'294'967'295;

    draw_overlay(canvas.view(), input);

    ASSERT_TRUE(canvas.guards_intact()) << "seed " << kSeed << ", round " << round;
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
