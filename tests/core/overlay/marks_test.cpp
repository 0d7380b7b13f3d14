#include "core/overlay/marks.h"

#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/overlay/overlay.h"
#include "core/overlay/palette.h"
#include "core/overlay/readout.h"
#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;
using tests::centroid_milli;
using tests::point_milli;

// Pixels of a colour above the readout's box.
std::vector<PixelPoint> marks_of(const Canvas& canvas, Rgb colour) {
  return canvas.pixels_of(colour, 480 - readout_height_px(635, 480));
}

TEST(Estimates, EstimatesShowWhatIsExpectedWhere) {
  Canvas canvas(635, 480);
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
  Canvas near(635, 480);
  draw_overlay(near.view(), input);
  estimates[1].center_px = point_milli(140'000, 100'000);
  Canvas apart(635, 480);
  draw_overlay(apart.view(), input);

  EXPECT_FALSE(near.find_text("41,60", 1, palette::kEstimateOpen).has_value());
  EXPECT_FALSE(near.find_text("41,61", 1, palette::kEstimateOpen).has_value());
  EXPECT_TRUE(apart.find_text("41,60", 1, palette::kEstimateOpen).has_value());
  EXPECT_TRUE(apart.find_text("41,61", 1, palette::kEstimateOpen).has_value());
}

TEST(Estimates, AddressesOfEstimatesAreNeverCutOff) {
  for (const auto& [u, v] : {std::pair{3, 100}, {631, 100}, {300, 405}, {300, 470}, {-5, 100}}) {
    Canvas canvas(635, 480);
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
