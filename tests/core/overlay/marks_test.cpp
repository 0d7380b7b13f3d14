#include "core/overlay/marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/overlay/overlay.h"
#include "core/overlay/palette.h"
#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;
using tests::centroid_milli;
using tests::point_milli;

Canvas display() { return Canvas(635, overlay_height_px(635, 480)); }

// Pixels of a colour above the readout.
std::vector<PixelPoint> marks_of(const Canvas& canvas, Rgb colour) {
  return canvas.pixels_of(colour, 480);
}

class ToolFrame : public testing::TestWithParam<std::array<std::int64_t, 2>> {};

// What lies within the rim is what the operator looks at.
TEST_P(ToolFrame, StandsAroundTheNearestPixelAndLeavesTheTubeEndFree) {
  const auto [u_milli, v_milli] = GetParam();
  std::array<std::size_t, 2> pixels{};
  for (const bool aligned : {false, true}) {
    Canvas canvas = display();
    OverlayInput input;
    input.sighting.tool_known = true;
    input.sighting.tool_px = point_milli(u_milli, v_milli);
    input.sighting.aligned = aligned;
    input.tool_rim = HalfSize{35, 27};

    draw_overlay(canvas.view(), input);

    const auto blue = marks_of(canvas, palette::kTool);
    ASSERT_FALSE(blue.empty());
    const PixelPoint center = centroid_milli(blue);
    EXPECT_LE(std::abs(center.u_px - u_milli), 501);
    EXPECT_LE(std::abs(center.v_px - v_milli), 501);
    const auto [left, right] = std::minmax_element(
        blue.begin(), blue.end(),
        [](const PixelPoint& a, const PixelPoint& b) { return a.u_px < b.u_px; });
    // Eight pixels beyond the rim to each side.
    EXPECT_EQ(right->u_px - left->u_px, 2 * 43);
    EXPECT_EQ(blue.back().v_px - blue.front().v_px, 2 * 35);
    const PixelPoint middle = nearest_pixel(input.sighting.tool_px);
    for (std::int32_t v = -27; v <= 27; ++v) {
      for (std::int32_t u = -35; u <= 35; ++u) {
        ASSERT_EQ(canvas.at(middle.u_px + u, middle.v_px + v), Rgb{}) << u << ", " << v;
      }
    }
    // Aligned is a whole frame; otherwise each side is open in its middle.
    for (const auto& [u, v] : {std::pair{0, -35}, {0, 35}, {-43, 0}, {43, 0}}) {
      EXPECT_EQ(canvas.at(middle.u_px + u, middle.v_px + v) == palette::kTool, aligned);
    }
    pixels[aligned ? 1 : 0] = blue.size();
  }
  EXPECT_GT(pixels[1], pixels[0]);
}

INSTANTIATE_TEST_SUITE_P(Places, ToolFrame,
                         testing::Values(std::array<std::int64_t, 2>{318'000, 190'000},
                                         std::array<std::int64_t, 2>{100'400, 90'600},
                                         std::array<std::int64_t, 2>{200'499, 300'501},
                                         std::array<std::int64_t, 2>{580'999, 53'001}));

struct AxesCase {
  std::int64_t row_u;  // from the primary tube to the next row's, px
  std::int64_t row_v;
  std::int64_t column_u;
  std::int64_t column_v;
};

class Axes : public testing::TestWithParam<AxesCase> {};

// Each pixel of an axis lies on the ray from the primary tube to its neighbour, as far as the brush
// and the arrow head allow; it begins at two fifths of the way, outside the tube-end, and ends at
// four fifths. Its letter stands beside it.
void expect_axis(const std::vector<PixelPoint>& pixels, PixelPoint origin, std::int64_t du,
                 std::int64_t dv) {
  ASSERT_GT(pixels.size(), 40U);
  const double length = std::hypot(static_cast<double>(du), static_cast<double>(dv));
  double farthest = 0.0;
  double nearest = length;
  int letter = 0;
  for (const PixelPoint& pixel : pixels) {
    const double u = pixel.u_px - origin.u_px;
    const double v = pixel.v_px - origin.v_px;
    const double along = (u * static_cast<double>(du) + v * static_cast<double>(dv)) / length;
    const double across = (u * static_cast<double>(dv) - v * static_cast<double>(du)) / length;
    // The head is 5 px to each side, the brush reaches 1.42 px, rounding 0.71 px and 0.25 px more.
    if (std::abs(across) > 7.4) {
      EXPECT_LE(std::abs(across), 17.0);
      EXPECT_NEAR(along, 0.75 * length, 6.0);
      ++letter;
      continue;
    }
    farthest = std::max(farthest, along);
    nearest = std::min(nearest, along);
    EXPECT_LE(std::abs(across), along < 0.8 * length - 14.0 ? 2.4 : 7.4);
  }
  EXPECT_GE(letter, 9);
  EXPECT_NEAR(nearest, 0.4 * length - 1.0, 1.2);
  // The brush reaches 1 to 1.42 px beyond the tip, which is rounded by up to 0.71 px.
  EXPECT_NEAR(farthest, 0.8 * length + 1.0, 1.2);
}

TEST_P(Axes, PointAlongPositiveRowAndColumn) {
  const AxesCase& axes = GetParam();
  const PixelPoint origin{300, 200};
  Canvas canvas = display();
  OverlayInput input;
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

TEST(Offset, HasAnArrowFromTheTubesCentreToTheRingWhereThereIsRoom) {
  for (const std::int32_t far : {30, 12}) {
    Canvas canvas = display();
    Painter painter(canvas.view());

    draw_offset(painter, MarkScale(640), point_milli(300'000, 200'000),
                point_milli(1000 * (300 - far), 200'000));

    const auto blue = marks_of(canvas, palette::kTool);
    EXPECT_EQ(blue.empty(), far == 12);
    for (const PixelPoint& pixel : blue) {
      EXPECT_LE(pixel.u_px, 301);
      EXPECT_GE(pixel.u_px, 300 - far + 7);
      EXPECT_LE(std::abs(pixel.v_px - 200), 6);
    }
  }
}

TEST(Clicks, StandWithTheirTipOnThePlaceAndSayWhatBecameOfThem) {
  std::array<std::size_t, 3> pixels{};
  for (const ClickVerdict verdict :
       {ClickVerdict::kTaken, ClickVerdict::kRefused, ClickVerdict::kBlamed}) {
    Canvas canvas = display();
    Painter painter(canvas.view());
    const Rgb colour = verdict == ClickVerdict::kTaken ? palette::kClick : palette::kClickRefused;

    draw_click(painter, MarkScale(640), {point_milli(300'000, 200'000), {40, -61}, verdict});

    const auto drawn = marks_of(canvas, colour);
    ASSERT_FALSE(drawn.empty());
    EXPECT_EQ(canvas.at(300, 200), colour);
    // A brush of two reaches one farther.
    EXPECT_EQ(drawn.back().v_px, 201);
    EXPECT_TRUE(canvas.find_text("40,-61", 1, colour).has_value());
    pixels[static_cast<std::size_t>(verdict)] = drawn.size();
    // Hollow but for the one to blame.
    EXPECT_EQ(canvas.at(300, 191) == colour, verdict == ClickVerdict::kBlamed);
  }
  EXPECT_EQ(pixels[0], pixels[1]);
  EXPECT_GT(pixels[2], pixels[1]);
}

TEST(ContradictedClaim, IsARingWithABar) {
  Canvas canvas = display();
  Painter painter(canvas.view());

  draw_contradicted_claim(painter, MarkScale(640), {300, 200});

  EXPECT_EQ(canvas.at(300, 200), palette::kClaim);
  EXPECT_EQ(canvas.at(315, 200), palette::kClaim);
  EXPECT_EQ(canvas.at(300, 185), palette::kClaim);
  EXPECT_NE(canvas.at(308, 192), palette::kClaim);
  EXPECT_EQ(canvas.at(308, 208), palette::kClaim);
}

TEST(Estimates, EstimatesShowWhatIsExpectedWhere) {
  Canvas canvas = display();
  OverlayInput input = OverlayInput{};
  const std::array<Estimate, 3> estimates{
      Estimate{{41, -7}, point_milli(100'400, 100'400), TubeState::kOpen},
      Estimate{{42, 60}, point_milli(200'000, 100'000), TubeState::kPlugged},
      Estimate{{43, 61}, point_milli(300'000, 100'000), TubeState::kAbsent}};
  input.estimates = estimates;

  draw_overlay(canvas.view(), input);

  EXPECT_EQ(canvas.at(100, 100), palette::kEstimateOpen);
  EXPECT_EQ(centroid_milli(marks_of(canvas, palette::kEstimateAbsent)),
            (PixelPoint{300'000, 100'000}));
  EXPECT_EQ(canvas.at(203, 100), palette::kEstimatePlugged);
  EXPECT_EQ(canvas.at(197, 97), palette::kEstimatePlugged);
  // Addresses stand centred beneath: 5 characters are 29 px wide.
  EXPECT_EQ(canvas.find_text("41,-7", 1, palette::kEstimateOpen), (PixelPoint{86, 108}));
  EXPECT_EQ(canvas.find_text("42,60", 1, palette::kEstimatePlugged), (PixelPoint{186, 108}));
  EXPECT_FALSE(canvas.find_text("43,61", 1, palette::kEstimateAbsent).has_value());
}

TEST(Estimates, EstimatesTooNearToEachOtherHaveNoAddress) {
  OverlayInput input = OverlayInput{};
  std::array<Estimate, 2> estimates{Estimate{{41, 60}, point_milli(100'000, 100'000)},
                                    Estimate{{41, 61}, point_milli(120'000, 100'000)}};
  input.estimates = estimates;
  Canvas near = display();
  draw_overlay(near.view(), input);
  estimates[1].center_px = point_milli(140'000, 100'000);
  Canvas apart = display();
  draw_overlay(apart.view(), input);

  EXPECT_FALSE(near.find_text("41,60", 1, palette::kEstimateOpen).has_value());
  EXPECT_FALSE(near.find_text("41,61", 1, palette::kEstimateOpen).has_value());
  EXPECT_TRUE(apart.find_text("41,60", 1, palette::kEstimateOpen).has_value());
  EXPECT_TRUE(apart.find_text("41,61", 1, palette::kEstimateOpen).has_value());
}

TEST(Estimates, AddressesOfEstimatesAreNeverCutOff) {
  for (const auto& [u, v] : {std::pair{3, 100}, {631, 100}, {300, 465}, {300, 478}, {-5, 100}}) {
    Canvas canvas = display();
    OverlayInput input = OverlayInput{};
    const std::array<Estimate, 1> estimates{Estimate{{41, 60}, point_milli(1000 * u, 1000 * v)}};
    input.estimates = estimates;

    draw_overlay(canvas.view(), input);

    // The dot alone, 9 pixels at most; a part of an address would be more.
    EXPECT_LE(marks_of(canvas, palette::kEstimateOpen).size(), 9U) << u << ", " << v;
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
