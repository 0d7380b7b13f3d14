#include "core/tracking/candidates.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class Candidates : public ::testing::Test {
 protected:
  // How many tubes the window shows beyond doubt, and those that rounding may put either way.
  struct Expected {
    std::set<TubeAddress> inside;
    std::set<TubeAddress> border;
  };

  [[nodiscard]] Expected brute_force(const SyntheticSheet& sheet, const ToolPlace& place,
                                     TubeAddress anchor) const {
    Expected expected;
    const auto& w = scene_.settings->start.window_px;
    const auto hits = [&](const std::array<double, 2>& at, double slack) {
      return at[0] > w[0] - slack && at[0] < w[2] + slack && at[1] > w[1] - slack &&
             at[1] < w[3] + slack;
    };
    for (std::int32_t row = anchor.row - 25; row <= anchor.row + 25; ++row) {
      for (std::int32_t column = anchor.column - 25; column <= anchor.column + 25; ++column) {
        const TubeAddress tube{row, column};
        if (scene_.map->state(tube) == TubeState::kAbsent) {
          continue;
        }
        const auto at = sheet.image_of(place, tube);
        // A point behind the camera has an image too; the sheet lies before it everywhere here, but
        // far tubes come near the picture again in the distortion's fold.
        const auto back = sheet.sheet_point(place, at);
        const auto center = sheet.center_of(tube);
        if (!back || std::hypot((*back)[0] - center[0], (*back)[1] - center[1]) > 0.01) {
          continue;
        }
        if (hits(at, 0.45)) {
          expected.inside.insert(tube);
        } else if (hits(at, 0.55)) {
          expected.border.insert(tube);
        }
      }
    }
    return expected;
  }

  void expect_all(const ToolPlace& place) {
    const SyntheticSheet sheet(*scene_.settings);
    const TubeAddress anchor = sheet.nearest({place.x_mm, place.y_mm});
    const auto pose = pose_at<S>(*scene_.settings, sheet, place, anchor);
    list_candidates<S>(scene_.model, *scene_.map, pose, list_);
    const Expected expected = brute_force(sheet, place, anchor);
    EXPECT_GT(expected.inside.size(), 5U);
    std::set<TubeAddress> listed;
    for (const Candidate<S>& candidate : list_) {
      EXPECT_TRUE(listed.insert(candidate.address).second) << "listed twice";
      EXPECT_TRUE(expected.inside.contains(candidate.address) ||
                  expected.border.contains(candidate.address))
          << "surplus: " << candidate.address.row << ", " << candidate.address.column;
      EXPECT_LT(distance(candidate.center_px, sheet.image_of(place, candidate.address)), 0.01);
      EXPECT_EQ(candidate.state, scene_.map->state(candidate.address));
    }
    for (const TubeAddress& tube : expected.inside) {
      EXPECT_TRUE(listed.contains(tube)) << "missing: " << tube.row << ", " << tube.column;
    }
  }

  Scene<S> scene_;
  CandidateList<S> list_;
};
TYPED_TEST_SUITE(Candidates, Scalars);

TYPED_TEST(Candidates, AreAllTubesOfTheWindowAndNoOthers) {
  this->scene_.make();
  for (const double alpha : {2.0, 47.0, 90.0, -123.0}) {
    for (const double height : {0.0, 60.0, 90.0}) {
      this->expect_all({250.0, 512.0, height, alpha, 0.6, -0.4});
    }
  }
}

TYPED_TEST(Candidates, LeaveOutVoidsAndKeepPlugs) {
  auto& sheet = this->scene_.settings->tubesheet;
  ASSERT_TRUE(sheet.missing.try_push_back({21, 10}));
  ASSERT_TRUE(sheet.missing.try_push_back({20, 11}));
  ASSERT_TRUE(sheet.plugged.try_push_back({20, 9}));
  sheet.columns = {-50, 12};  // the sheet ends in the window
  this->scene_.make();
  this->expect_all(kOverTube);
  int plugs = 0;
  for (const auto& candidate : this->list_) {
    plugs += candidate.state == TubeState::kPlugged ? 1 : 0;
  }
  EXPECT_EQ(plugs, 1);
}

TYPED_TEST(Candidates, FollowObliqueAndLeftHandedLattices) {
  auto& sheet = this->scene_.settings->tubesheet;
  sheet.row_step_mm = {11.1125, 19.2474};
  sheet.column_step_mm = {22.225, 0.0};
  sheet.bore_mm = 16.0;
  this->scene_.make();
  this->expect_all({250.0, 212.0, 60.0, 10.0, 0.0, 0.0});

  sheet.row_step_mm = {0.0, -16.27};
  sheet.column_step_mm = {16.27, 0.0};
  sheet.addresses = AddressParity::kOddSum;
  this->scene_.make();
  this->expect_all({250.0, -212.0, 60.0, -80.0, 0.0, 0.0});
}

TYPED_TEST(Candidates, FollowShiftedRowsFromAnchorsInBothKinds) {
  auto& sheet = this->scene_.settings->tubesheet;
  for (const double shift : {0.25, -0.4, 0.9}) {
    sheet.odd_row_shift = shift;
    this->scene_.make();
    for (const double y_mm : {508.0, 533.4}) {
      for (const double alpha : {2.0, -123.0}) {
        this->expect_all({250.0, y_mm, 60.0, alpha, 0.6, -0.4});
        this->expect_all({262.0, y_mm, 90.0, alpha, 0.0, 0.0});
      }
    }
  }
  sheet.column_step_mm = {12.7, 0.0};
  sheet.addresses = AddressParity::kEvenSum;
  sheet.odd_row_shift = 0.5;
  this->scene_.make();
  this->expect_all({250.0, 508.0, 60.0, 10.0, 0.0, 0.0});
  this->expect_all({250.0, 533.4, 60.0, 10.0, 0.0, 0.0});
}

TYPED_TEST(Candidates, StandInTheOrderOfTheirDistanceFromTheOptimumPoint) {
  this->scene_.make();
  const SyntheticSheet sheet(*this->scene_.settings);
  const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, kOverTube, kTube);
  list_candidates<TypeParam>(this->scene_.model, *this->scene_.map, pose, this->list_);
  ASSERT_GT(this->list_.size(), 3);
  double last = 0.0;
  for (const auto& candidate : this->list_) {
    const double off = distance(candidate.center_px, this->scene_.settings->start.optimum_px);
    EXPECT_GE(off, last - 1.5);  // the order is that of whole pixels
    last = off;
  }
}

TYPED_TEST(Candidates, AreTheNearestWhenThereAreTooMany) {
  auto& settings = *this->scene_.settings;
  settings.tubesheet.row_step_mm = {0.0, 9.0};
  settings.tubesheet.column_step_mm = {9.0, 0.0};
  settings.tubesheet.bore_mm = 6.0;
  settings.tubesheet.rows = {-100, 300};
  settings.tubesheet.columns = {-100, 300};
  settings.start.window_px = {0, 0, 634, 400};
  this->scene_.make();
  const SyntheticSheet sheet(settings);
  const ToolPlace place{252.0, 504.0, 60.0, 2.0, 0.0, 0.0};
  const TubeAddress anchor{56, 28};
  const auto pose = pose_at<TypeParam>(settings, sheet, place, anchor);
  list_candidates<TypeParam>(this->scene_.model, *this->scene_.map, pose, this->list_);
  const auto expected = this->brute_force(sheet, place, anchor);

  ASSERT_GT(expected.inside.size(), static_cast<std::size_t>(kMaxTubesInView));
  ASSERT_EQ(this->list_.size(), kMaxTubesInView);
  const double farthest =
      distance(this->list_[kMaxTubesInView - 1].center_px, settings.start.optimum_px);
  std::set<TubeAddress> listed;
  for (const auto& candidate : this->list_) {
    listed.insert(candidate.address);
  }
  for (const TubeAddress& tube : expected.inside) {
    if (!listed.contains(tube)) {
      const auto at = sheet.image_of(place, tube);
      EXPECT_GE(
          std::hypot(at[0] - settings.start.optimum_px[0], at[1] - settings.start.optimum_px[1]),
          farthest - 1.5);
    }
  }
}

}  // namespace
}  // namespace tubesight::core::tracking
