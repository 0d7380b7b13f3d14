#include "core/tracking/circle_shift.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class CircleShift : public ObservedScene<S> {
 protected:
  using ObservedScene<S>::scene_;
  using ObservedScene<S>::sheet_;
  using ObservedScene<S>::frame_;

  // A field with 1.3 % white pixels, looked at with a pose that is off.
  bool shift(const Vector2<Mm<S>>& off, double reach_mm) {
    sheet_->draw(kOverTube, Parity::kEven, 1, frame_);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < frame_.size() / 76; ++i) {
      frame_[random() % frame_.size()] = 255;
    }
    truth_ = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
    pose_ = truth_;
    pose_.origin = pose_.origin + pose_.along(off);
    list_candidates<S>(scene_.model, *scene_.map, pose_, candidates_);
    return shift_onto_circles<S>(scene_.model, sheet_->view(frame_, Parity::kEven), candidates_,
                                 Mm<S>(reach_mm), pose_);
  }

  CandidateList<S> candidates_;
  SheetPose<S> truth_{};
  SheetPose<S> pose_{};
};
TYPED_TEST_SUITE(CircleShift, Scalars);

TYPED_TEST(CircleShift, LaysThePoseOntoTubeEndsUnderSpecks) {
  using M = Mm<TypeParam>;
  for (const Vector2<M>& off :
       {Vector2<M>{M(5.0), M(0)}, Vector2<M>{M(-3.0), M(4.0)}, Vector2<M>{M(0), M(-5.0)}}) {
    ASSERT_TRUE(this->shift(off, 7.0));
    EXPECT_LT((vector(this->pose_.origin) - vector(this->truth_.origin)).norm(), 1.0);
  }
}

TYPED_TEST(CircleShift, GoesNoFartherThanTheToolCanHaveCome) {
  using M = Mm<TypeParam>;
  EXPECT_FALSE(this->shift({M(5.0), M(0)}, 3.0));
}

TYPED_TEST(CircleShift, FindsNothingOnPlate) {
  using M = Mm<TypeParam>;
  for (std::int32_t row = 10; row < 30; ++row) {
    for (std::int32_t column = 0; column < 20; ++column) {
      this->sheet_->look.flush_plugs.push_back({row, column});
    }
  }
  EXPECT_FALSE(this->shift({M(2.0), M(0)}, 7.0));
}

}  // namespace
}  // namespace tubesight::core::tracking
