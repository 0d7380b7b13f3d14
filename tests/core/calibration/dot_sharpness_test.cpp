// Dots that are sharp, smeared, out of focus or cut off by the sensor, drawn.

#include "core/calibration/dot_sharpness.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/drawn_template.h"

namespace tubesight::core::calibration {
namespace {

class DotSharpnessTest : public testing::Test {
 protected:
  DotSharpnessTest() {
    drawn_.k_per_mm2 = 0.009;
    drawn_.t_camera_target = {-36.0, -36.0, 90.0};
    drawn_.frames = 1;
  }

  [[nodiscard]] DotSharpness look() {
    std::mt19937_64 random(3);
    const picture::AveragedPicture seen = drawn_.draw(random, pixels_);
    std::vector<std::uint16_t> scratch(pixels_.size());
    EXPECT_EQ(finder_->find(seen, {}, scratch, *found_), detection::FinderRefusal::kNone);
    return dot_sharpness(seen, *found_);
  }

  tests::DrawnTemplate drawn_;
  std::vector<std::uint16_t> pixels_;
  std::unique_ptr<detection::LatticeFinder> finder_ = std::make_unique<detection::LatticeFinder>();
  std::unique_ptr<detection::FoundLattice> found_ = std::make_unique<detection::FoundLattice>();
};

TEST_F(DotSharpnessTest, OfACameraAtRestInFocusIsGood) {
  const DotSharpness sharp = look();

  EXPECT_EQ(sharp.dots, 100);
  EXPECT_NEAR(sharp.radius_px, 11.0, 1.0) << "2 mm at 90 mm by 5.06 mm and cells of 0.01 mm";
  // A blur of 0.7 px; the pixel, what is taken between pixels (twice), the slope's step.
  EXPECT_NEAR(sharp.width_px, std::sqrt(6.283 * (0.49 + 4.0 / 12.0)), 0.2);
  EXPECT_LT(sharp.smeared_px, 0.8);
  EXPECT_EQ(fault_of(sharp), DotFault::kNone);
}

TEST_F(DotSharpnessTest, TellsWhichWayTheCameraMoved) {
  drawn_.moved_px = 6;

  const DotSharpness smeared = look();

  EXPECT_NEAR(smeared.smeared_px, 6.0, 1.5);
  EXPECT_LT(std::abs(std::sin(smeared.smeared_deg * 0.0174533)), 0.1) << smeared.smeared_deg;
  EXPECT_EQ(fault_of(smeared), DotFault::kSmeared);
}

TEST_F(DotSharpnessTest, AMoveOfAPixelIsNoFault) {
  drawn_.moved_px = 2;
  EXPECT_EQ(fault_of(look()), DotFault::kNone);
}

TEST_F(DotSharpnessTest, OutOfFocusIsAFault) {
  drawn_.smear_px = 3.2;
  const DotSharpness blurred = look();
  EXPECT_LT(blurred.smeared_px, 2.5);
  EXPECT_EQ(fault_of(blurred), DotFault::kBlurred) << blurred.width_px;
}

TEST_F(DotSharpnessTest, DotsCutOffByTheSensorAreAFault) {
  drawn_.inside = 320.0;
  EXPECT_EQ(fault_of(look()), DotFault::kSaturated);
  drawn_.inside = 240.0;
  EXPECT_EQ(fault_of(look()), DotFault::kNone);
}

TEST_F(DotSharpnessTest, DarkDotsOnPaperCutOffAreToldAndNoFault) {
  drawn_.inside = 40.0;
  drawn_.background = 320.0;
  const DotSharpness dark = look();
  EXPECT_GT(dark.ground_saturated, 90);
  EXPECT_EQ(fault_of(dark), DotFault::kNone);
}

}  // namespace
}  // namespace tubesight::core::calibration
