#include "core/tracking/field_measurement.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class FieldMeasurement : public ::testing::Test {
 protected:
  void make() {
    scene_.make();
    sheet_ = std::make_unique<SyntheticSheet>(*scene_.settings);
  }

  // Measures everything in one even field from a prediction off by `off_mm`.
  FindingCount measure(const Vector2<Mm<S>>& off_mm = {}, std::uint32_t seed = 1) {
    sheet_->draw(kOverTube, Parity::kEven, seed, frame_);
    auto pose = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
    pose.origin = pose.origin + pose.along(off_mm);
    list_candidates<S>(scene_.model, *scene_.map, pose, candidates_);
    record_.begin_field();
    return measure_field<S>(scene_.model, sheet_->view(frame_, Parity::kEven), pose, candidates_,
                            {0, candidates_.size(), 3}, record_);
  }

  [[nodiscard]] std::set<TubeAddress> measured() const {
    std::set<TubeAddress> addresses;
    for (const auto& tube : record_.measured) {
      addresses.insert(tube.address);
    }
    return addresses;
  }

  // Tubes whose whole image is beyond doubt inside the window.
  [[nodiscard]] std::set<TubeAddress> whole() const {
    std::set<TubeAddress> addresses;
    const auto& w = scene_.settings->start.window_px;
    for (const auto& candidate : candidates_) {
      bool inside = true;
      const auto center = sheet_->center_of(candidate.address);
      for (int k = 0; k < 24; ++k) {
        const double angle = k * 3.14159265358979 / 12.0;
        const auto at = sheet_->image_of(
            kOverTube, {center[0] + 9.3 * std::cos(angle), center[1] + 9.3 * std::sin(angle), 0.0});
        inside = inside && at[0] > w[0] && at[0] < w[2] && at[1] > w[1] && at[1] < w[3];
      }
      if (inside) {
        addresses.insert(candidate.address);
      }
    }
    return addresses;
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
  Frame frame_;
  CandidateList<S> candidates_;
  FieldRecord<S> record_{};
};
TYPED_TEST_SUITE(FieldMeasurement, Scalars);

TYPED_TEST(FieldMeasurement, MeasuresEveryWholeTubeEndOfTheWindow) {
  this->make();
  const FindingCount count = this->measure();
  const auto whole = this->whole();
  ASSERT_GE(whole.size(), 6U);
  const auto measured = this->measured();
  for (const TubeAddress& tube : whole) {
    EXPECT_TRUE(measured.contains(tube)) << tube.row << ", " << tube.column;
  }
  EXPECT_EQ(count.measured, this->record_.measured.size());
  EXPECT_EQ(count.bright + count.disagreeing, 0);
  for (const auto& tube : this->record_.measured) {
    EXPECT_LT(distance(tube.center_px, this->sheet_->image_of(kOverTube, tube.address)), 0.12);
  }
}

TYPED_TEST(FieldMeasurement, KeepsKnownPlugsAndVoidsOutOfTheFit) {
  ASSERT_TRUE(this->scene_.settings->tubesheet.plugged.try_push_back({20, 10}));
  ASSERT_TRUE(this->scene_.settings->tubesheet.missing.try_push_back({21, 10}));
  this->make();
  static_cast<void>(this->measure());
  const auto measured = this->measured();
  EXPECT_FALSE(measured.contains({20, 10}));
  EXPECT_FALSE(measured.contains({21, 10}));
  EXPECT_GE(measured.size(), 4U);
}

TYPED_TEST(FieldMeasurement, RecognisesPlugsThatNoListNames) {
  this->make();
  this->sheet_->look.flush_plugs = {{20, 10}};
  this->sheet_->look.rolled_plugs = {{21, 10}};
  this->sheet_->look.noise = 2.0;
  std::set<TubeAddress> plugs;
  for (std::uint32_t field = 1; field <= 6; ++field) {
    const FindingCount count = this->measure({}, field);
    EXPECT_GE(count.bright, 1);
    const auto measured = this->measured();
    EXPECT_FALSE(measured.contains({20, 10})) << field;
    EXPECT_FALSE(measured.contains({21, 10})) << field;
    plugs.clear();
    for (const auto& plug : this->record_.plugs_seen) {
      plugs.insert(plug.address);
    }
  }
  EXPECT_EQ(plugs, (std::set<TubeAddress>{{20, 10}, {21, 10}}));
}

TYPED_TEST(FieldMeasurement, FindsNothingOnAnEvenSheet) {
  this->make();
  for (std::int32_t row = 10; row < 30; ++row) {
    for (std::int32_t column = 0; column < 20; ++column) {
      this->sheet_->look.flush_plugs.push_back({row, column});
    }
  }
  const FindingCount count = this->measure();
  EXPECT_EQ(count.measured, 0);
  EXPECT_GE(count.looked_at, 6);
  EXPECT_EQ(count.bright, count.looked_at);
}

TYPED_TEST(FieldMeasurement, FollowsARaisedBlackLevelButNotPlugs) {
  this->make();
  const auto follow = [&] {
    const auto pose = pose_at<TypeParam>(*this->scene_.settings, *this->sheet_, kOverTube, kTube);
    return follow_darkness<TypeParam>(this->scene_.model,
                                      this->sheet_->view(this->frame_, Parity::kEven), pose,
                                      this->candidates_, this->record_.light);
  };
  // As contrast halved around 128: 12 and 140 become 70 and 134.
  this->sheet_->look.gain = 0.5;
  this->sheet_->look.offset = 64.0;
  EXPECT_EQ(this->measure().measured, 0);
  ASSERT_TRUE(follow());
  EXPECT_NEAR(this->record_.light.region_threshold, 102, 6);
  EXPECT_GE(this->measure().measured, 6);
  EXPECT_FALSE(follow());  // it is as dark as that now
  // Plugs are as bright as the sheet: nothing is followed.
  this->record_.light = {};
  for (std::int32_t row = 10; row < 30; ++row) {
    for (std::int32_t column = 0; column < 20; ++column) {
      this->sheet_->look.flush_plugs.push_back({row, column});
    }
  }
  EXPECT_EQ(this->measure().measured, 0);
  EXPECT_FALSE(follow());
  EXPECT_EQ(this->record_.light.region_threshold, LightLevels{}.region_threshold);
}

TYPED_TEST(FieldMeasurement, ShiftsThePoseOntoTubeEndsThreeTenthsOfAStepOff) {
  this->make();
  using M = Mm<TypeParam>;
  for (const Vector2<M>& off :
       {Vector2<M>{M(7.0), M(0)}, Vector2<M>{M(-4.0), M(5.0)}, Vector2<M>{M(0), M(-7.0)}}) {
    this->sheet_->draw(kOverTube, Parity::kOdd, 1, this->frame_);
    const auto truth = pose_at<TypeParam>(*this->scene_.settings, *this->sheet_, kOverTube, kTube);
    auto pose = truth;
    pose.origin = pose.origin + pose.along(off);
    list_candidates<TypeParam>(this->scene_.model, *this->scene_.map, pose, this->candidates_);
    LightLevels light;

    const bool shifted = shift_onto_dark_regions<TypeParam>(
        this->scene_.model, this->sheet_->view(this->frame_, Parity::kOdd), this->candidates_,
        M(9.5), light, pose);

    ASSERT_TRUE(shifted);
    EXPECT_LT((vector(pose.origin) - vector(truth.origin)).norm(), 0.7);
  }
}

TYPED_TEST(FieldMeasurement, DoesNotShiftFartherThanTheToolCanHaveCome) {
  this->make();
  using M = Mm<TypeParam>;
  this->sheet_->draw(kOverTube, Parity::kOdd, 1, this->frame_);
  auto pose = pose_at<TypeParam>(*this->scene_.settings, *this->sheet_, kOverTube, kTube);
  pose.origin = pose.origin + pose.along({M(7.0), M(0)});
  const auto before = pose.origin;
  list_candidates<TypeParam>(this->scene_.model, *this->scene_.map, pose, this->candidates_);
  LightLevels light;

  EXPECT_FALSE(shift_onto_dark_regions<TypeParam>(this->scene_.model,
                                                  this->sheet_->view(this->frame_, Parity::kOdd),
                                                  this->candidates_, M(4.0), light, pose));
  EXPECT_TRUE(pose.origin == before);
}

}  // namespace
}  // namespace tubesight::core::tracking
