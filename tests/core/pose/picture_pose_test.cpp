#include "core/pose/picture_pose.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/pose/pose_test_support.h"
#include "tests/core/pose/still_picture.h"
#include "tests/support/heap_guard.h"

namespace tubesight::core::pose {
namespace {

class PicturePoseOf : public ::testing::Test {
 protected:
  PicturePoseOf() { still_.sheet->look.noise = 2.0; }

  const PictureOutcome& estimate(const std::vector<PictureStart>& starts) {
    still_.draw(kStillPlace);
    *outcome_ = estimate_from_picture(still_.averaged(), still_.model, *still_.map, starts,
                                      options_, *workspace_);
    return *outcome_;
  }
  [[nodiscard]] std::vector<PictureStart> starts(const std::vector<TubeAddress>& tubes) const {
    std::vector<PictureStart> list;
    for (const TubeAddress tube : tubes) {
      list.push_back(still_.start(kStillPlace, tube));
    }
    return list;
  }
  void expect_right(double lateral_mm, double height_mm) {
    ASSERT_TRUE(outcome_->has_value());
    const auto& at = outcome_->pose.estimate.T_sheet_tool.translation_mm();
    EXPECT_NEAR(at.x(), kStillPlace.x_mm, lateral_mm);
    EXPECT_NEAR(at.y(), kStillPlace.y_mm, lateral_mm);
    EXPECT_NEAR(at.z(), -kStillPlace.height_mm, height_mm);
  }
  [[nodiscard]] const PictureTube* find(TubeAddress address) const {
    const auto* found =
        std::find_if(outcome_->tubes.begin(), outcome_->tubes.end(),
                     [&](const PictureTube& tube) { return tube.address == address; });
    return found == outcome_->tubes.end() ? nullptr : found;
  }

  StillPicture still_;
  PictureOptions options_;
  std::unique_ptr<PictureWorkspace> workspace_ = std::make_unique<PictureWorkspace>();
  std::unique_ptr<PictureOutcome> outcome_ = std::make_unique<PictureOutcome>();
};

const std::vector<TubeAddress> kThree = {{19, 10}, {20, 10}, {19, 11}};

TEST_F(PicturePoseOf, ThreePlacesFindsAllOthersAndThePose) {
  estimate(starts(kThree));

  expect_right(0.02, 0.02);
  EXPECT_GT(outcome_->pose.estimate.tubes, 30);
  EXPECT_EQ(outcome_->pose.estimate.nearest, kUnderTube);
}

TEST_F(PicturePoseOf, APictureAsksForNoMemory) {
  still_.draw(kStillPlace);
  const auto places = starts(kThree);

  const tests::HeapGuard guard;
  picture::PictureAverage average(still_.sums, still_.settings->camera.width_px,
                                  still_.settings->camera.height_px);
  const bool added = average.add(still_.field(Parity::kEven)).has_value() &&
                     average.add(still_.field(Parity::kOdd)).has_value();
  const auto picture = average.finish();
  *outcome_ =
      estimate_from_picture(*picture, still_.model, *still_.map, places, options_, *workspace_);
  const tests::HeapCalls calls = guard.calls();

  EXPECT_TRUE(added && outcome_->has_value());
  EXPECT_EQ(calls.allocations, 0);
}

TEST_F(PicturePoseOf, OnlyTheNamedUsesNoOthers) {
  options_.only_start = true;
  estimate(starts({{18, 10}, {19, 10}, {20, 10}, {18, 11}, {19, 11}, {20, 11}, {19, 9}}));

  expect_right(0.15, 0.15);
  EXPECT_EQ(outcome_->pose.estimate.tubes, 7);
  EXPECT_EQ(outcome_->tubes.size(), 7);
}

TEST_F(PicturePoseOf, PlugsThatNoListNamesAreRecognised) {
  still_.sheet->look.flush_plugs = {{18, 10}};
  still_.sheet->look.rolled_plugs = {{19, 12}};
  estimate(starts(kThree));

  expect_right(0.02, 0.02);
  ASSERT_NE(find({18, 10}), nullptr);
  EXPECT_EQ(find({18, 10})->finding, picture::RimFinding::kBright);
  EXPECT_FALSE(find({18, 10})->used);
  ASSERT_NE(find({19, 12}), nullptr);
  EXPECT_FALSE(find({19, 12})->used);
}

TEST_F(PicturePoseOf, ListedPlugsAndVoidsAreLeftOut) {
  ASSERT_TRUE(still_.settings->tubesheet.plugged.try_push_back({18, 10}));
  ASSERT_TRUE(still_.settings->tubesheet.missing.try_push_back({18, 11}));
  still_.configure();
  estimate(starts(kThree));

  expect_right(0.02, 0.02);
  EXPECT_EQ(find({18, 10}), nullptr);
  EXPECT_EQ(find({18, 11}), nullptr);
}

TEST_F(PicturePoseOf, TwoPlacesAreTooFew) {
  EXPECT_EQ(estimate(starts({{19, 10}, {20, 10}})).refusal, PictureRefusal::kTooFewStarts);
}

TEST_F(PicturePoseOf, APlaceOnTheSheetIsToldByItsNumber) {
  std::vector<PictureStart> places = starts(kThree);
  const auto at = still_.sheet->image_of(kStillPlace, TubeAddress{20, 11});
  places[1].u_px = (places[1].u_px + at[0]) / 2.0;
  places[1].v_px = (places[1].v_px + at[1]) / 2.0;

  estimate(places);

  EXPECT_EQ(outcome_->refusal, PictureRefusal::kStart);
  EXPECT_EQ(outcome_->start, 1);
  EXPECT_NE(outcome_->scan, picture::ScanRefusal::kNone);
}

TEST_F(PicturePoseOf, TwoPlacesInOneTubeEndAreRefused) {
  std::vector<PictureStart> places = starts(kThree);
  places[2].u_px = places[0].u_px - 5.0;
  places[2].v_px = places[0].v_px;

  estimate(places);

  EXPECT_EQ(outcome_->refusal, PictureRefusal::kSameTube);
  EXPECT_EQ(outcome_->start, 2);
}

TEST_F(PicturePoseOf, AnAddressWithoutATubeIsRefused) {
  std::vector<PictureStart> places = starts(kThree);
  places[0].address = {-5000, 3};

  EXPECT_EQ(estimate(places).refusal, PictureRefusal::kNoSuchTube);
}

TEST_F(PicturePoseOf, TubesInOneLineAreRefused) {
  options_.only_start = true;
  estimate(starts({{18, 10}, {19, 10}, {20, 10}}));

  EXPECT_EQ(outcome_->refusal, PictureRefusal::kPose);
  EXPECT_EQ(outcome_->pose.refusal, PoseRefusal::kCollinear);
}

TEST_F(PicturePoseOf, AddressesThatContradictThePictureAreRefused) {
  std::vector<PictureStart> places = starts(kThree);
  std::swap(places[0].address, places[2].address);

  EXPECT_EQ(estimate(places).refusal, PictureRefusal::kPose);
}

TEST_F(PicturePoseOf, APictureWithoutTubesIsRefused) {
  still_.sheet->look.gain = 0.0;
  still_.sheet->look.offset = 120.0;

  EXPECT_EQ(estimate(starts(kThree)).refusal, PictureRefusal::kStart);
}

}  // namespace
}  // namespace tubesight::core::pose
