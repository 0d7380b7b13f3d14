#include "core/picture/rest_average.h"

#include <gtest/gtest.h>

#include "core/picture/rest_check.h"
#include "tests/core/pose/still_picture.h"

namespace tubesight::core::picture {
namespace {

using pose::kStillPlace;
using pose::kUnderTube;
using pose::StillPicture;

class RestAverageOf : public ::testing::Test {
 protected:
  RestAverageOf() { still_.sheet->look.noise = 2.0; }

  RestAverage make() {
    return {still_.sums, still_.settings->camera.width_px, still_.settings->camera.height_px};
  }
  void add(RestAverage& average, const tests::ToolPlace& even, const tests::ToolPlace& odd,
           std::uint32_t seed) {
    still_.sheet->draw(even, Parity::kEven, seed, still_.frame);
    still_.sheet->draw(odd, Parity::kOdd, seed + 50, still_.frame);
    ASSERT_TRUE(average.add(still_.field(Parity::kEven)).has_value());
    ASSERT_TRUE(average.add(still_.field(Parity::kOdd)).has_value());
  }
  static tests::ToolPlace moved(double x_mm, double y_mm) {
    tests::ToolPlace place = kStillPlace;
    place.x_mm += x_mm;
    place.y_mm += y_mm;
    return place;
  }

  StillPicture still_{2};
};

TEST_F(RestAverageOf, FramesAtRestRests) {
  RestAverage average = make();
  for (std::uint32_t i = 0; i < 3; ++i) {
    add(average, kStillPlace, kStillPlace, i);
  }

  const RestOutcome outcome = average.finish();

  EXPECT_TRUE(outcome.rested);
  EXPECT_LT(outcome.frame_shift_px, 0.1);
  EXPECT_LT(outcome.field_shift_px, kLargestFieldShift_px);
}

TEST_F(RestAverageOf, FramesThatTheToolMovedBetweenDoesNot) {
  RestAverage average = make();
  add(average, kStillPlace, kStillPlace, 1);
  add(average, moved(2.0, 0.0), moved(2.0, 0.0), 2);

  const RestOutcome outcome = average.finish();

  EXPECT_FALSE(outcome.rested);
  EXPECT_GT(outcome.frame_shift_px, kLargestFrameShift_px);
}

TEST_F(RestAverageOf, AFrameWhoseFieldsAreApartDoesNot) {
  RestAverage average = make();
  add(average, kStillPlace, moved(0.0, 1.5), 1);

  const RestOutcome outcome = average.finish();

  EXPECT_FALSE(outcome.rested);
  EXPECT_GT(outcome.field_shift_px, kLargestFieldShift_px);
}

TEST_F(RestAverageOf, ALampThatDriftsRests) {
  RestAverage average = make();
  add(average, kStillPlace, kStillPlace, 1);
  still_.sheet->look.gain = 0.9;
  add(average, kStillPlace, kStillPlace, 2);

  const RestOutcome outcome = average.finish();

  EXPECT_TRUE(outcome.rested);
}

TEST(ShiftBetweenFrames, FollowsASmallMove) {
  StillPicture still(2);
  still.draw(kStillPlace);
  PictureAverage average(still.sums, still.settings->camera.width_px,
                         still.settings->camera.height_px);
  ASSERT_TRUE(average.add(still.field(Parity::kEven)).has_value());
  tests::ToolPlace place = kStillPlace;
  place.x_mm += 0.1;
  still.draw(place);
  // What the middle of the picture moves by, from the drawing's own projection.
  const auto before = still.sheet->image_of(kStillPlace, kUnderTube);
  const auto after = still.sheet->image_of(place, kUnderTube);

  const PictureShift shift = shift_between_frames(average, still.field(Parity::kEven));

  ASSERT_TRUE(shift.known);
  EXPECT_NEAR(shift.mean_u_px, after[0] - before[0], 0.05);
  EXPECT_NEAR(shift.mean_v_px, after[1] - before[1], 0.05);
}

}  // namespace
}  // namespace tubesight::core::picture
