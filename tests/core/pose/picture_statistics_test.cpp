// Many poses from drawn pictures against what each pose says of its own error.

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/pose/picture_pose.h"
#include "tests/core/pose/pose_test_support.h"
#include "tests/core/pose/still_picture.h"

namespace tubesight::core::pose {
namespace {

TEST(PictureStatistics, ManyPosesHaveTheErrorsThatTheirCovarianceTells) {
  // The drawing's bores and centres are exact, which is not known: told errors are a little large.
  constexpr int kPoses = 16;
  StillPicture still;
  still.sheet->look.noise = 2.0;
  const auto workspace = std::make_unique<PictureWorkspace>();
  const auto outcome = std::make_unique<PictureOutcome>();
  double sum = 0.0;
  for (int i = 0; i < kPoses; ++i) {
    tests::ToolPlace place = kStillPlace;
    place.x_mm += 0.7 * i;
    place.y_mm -= 0.4 * i;
    place.height_mm += 3.0 * (i % 5);
    place.alpha_deg += 23.0 * i;
    place.beta_deg = 0.1 * (i % 7) - 0.3;
    still.draw(place, static_cast<std::uint32_t>(i));
    std::vector<PictureStart> starts;
    for (const TubeAddress tube : {TubeAddress{19, 10}, {20, 10}, {19, 11}}) {
      starts.push_back(still.start(place, tube));
    }
    *outcome =
        estimate_from_picture(still.averaged(), still.model, *still.map, starts, {}, *workspace);
    ASSERT_TRUE(outcome->has_value()) << i;
    const math::Vector6d error = pose_error(outcome->pose.estimate.T_sheet_tool, true_pose(place));
    const double square = error.dot(outcome->pose.estimate.covariance.inverse() * error);
    EXPECT_LT(square, 22.5) << i;  // 99.9 % of six squares
    sum += square;
  }
  // The mean of n sums of six squares is 6, its deviation sqrt(12 / n); down to 4.5 on the safe
  // side.
  const double deviation = std::sqrt(12.0 / kPoses);
  EXPECT_GT(sum / kPoses, 4.5 - 2.0 * deviation);
  EXPECT_LT(sum / kPoses, 6.0 + 3.0 * deviation);
}

}  // namespace
}  // namespace tubesight::core::pose
