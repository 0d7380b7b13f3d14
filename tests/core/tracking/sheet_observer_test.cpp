#include "core/tracking/sheet_observer.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class SheetObserverOf : public ObservedScene<S> {
 protected:
  using ObservedScene<S>::scene_;
  using ObservedScene<S>::sheet_;
  using ObservedScene<S>::frame_;

  /// What is expected where the tool is `off_mm` from where the pictures show it.
  [[nodiscard]] Expectation<S> expect_off_by(double off_mm, double reach_mm) const {
    Expectation<S> expected;
    expected.pose = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
    expected.pose.origin = expected.pose.origin + expected.pose.along({Mm<S>(off_mm), Mm<S>{}});
    expected.reach_mm = Mm<S>(reach_mm);
    return expected;
  }
  [[nodiscard]] FieldView draw() {
    sheet_->draw(kOverTube, Parity::kEven, 1, frame_);
    return sheet_->view(frame_, Parity::kEven);
  }
};
TYPED_TEST_SUITE(SheetObserverOf, Scalars);

TYPED_TEST(SheetObserverOf, FindsTheToolFromNearFartherAndFar) {
  const FieldView field = this->draw();
  // 2 and 5 mm are searched across the rims, 9 mm by bisection.
  for (const double off_mm : {0.0, 2.0, 5.0, 9.0}) {
    const auto seen = this->observer_->observe(field, this->expect_off_by(off_mm * 0.9, off_mm));
    ASSERT_TRUE(seen.fitted) << off_mm;
    EXPECT_FALSE(seen.contradiction) << off_mm;
    EXPECT_EQ(seen.trouble, Reason::kNone);
    EXPECT_LT(this->error_mm(seen), 0.3) << off_mm;
    EXPECT_EQ(seen.pose.anchor, kTube);
    EXPECT_GE(this->observer_->record().measured.size(), seen.fit.used);
  }
}

TYPED_TEST(SheetObserverOf, TellsADeviationThatTheSystematicShareBounds) {
  const auto seen = this->observer_->observe(this->draw(), this->expect_off_by(0.0, 0.0));
  ASSERT_TRUE(seen.fitted);
  const double picture = number(seen.picture_deviation_mm);
  EXPECT_GT(picture, 0.0);
  // 0.0996 mm on a perfect picture; the root of the sum of squares.
  EXPECT_NEAR(number(seen.deviation_mm), std::hypot(picture, 102.0 / 1024.0), 1e-4);
}

TYPED_TEST(SheetObserverOf, FindsNoLightAndSaysNothingAgainstTheExpectation) {
  for (const auto& [offset, reason] :
       {std::pair{4.0, Reason::kDark}, {255.0, Reason::kWashedOut}}) {
    this->sheet_->look.gain = 0.0;
    this->sheet_->look.offset = offset;
    const auto seen = this->observer_->observe(this->draw(), this->expect_off_by(0.0, 2.0));
    EXPECT_FALSE(seen.fitted);
    EXPECT_EQ(seen.trouble, reason);
    EXPECT_FALSE(seen.contradiction);
  }
}

TYPED_TEST(SheetObserverOf, IsContradictedBySheetWhereTubeEndsMustBe) {
  // Half a step aside there is sheet between four tube-ends.
  const auto seen = this->observer_->observe(this->draw(), this->expect_off_by(12.7, 1.0));
  EXPECT_FALSE(seen.fitted);
  EXPECT_EQ(seen.trouble, Reason::kNoTubes);
  EXPECT_TRUE(seen.contradiction);
}

TYPED_TEST(SheetObserverOf, GlancesWithoutLearning) {
  const auto expected = this->expect_off_by(0.0, 1.0);
  static_cast<void>(this->observer_->observe(this->draw(), expected));
  const auto threshold = this->observer_->record().light.region_threshold;
  // A much brighter picture: a look follows its light, a glance does not.
  this->sheet_->look.gain = 1.6;
  const FieldView bright = this->draw();
  EXPECT_TRUE(this->observer_->glance(bright, expected).fitted);
  EXPECT_EQ(this->observer_->record().light.region_threshold, threshold);
  EXPECT_TRUE(this->observer_->observe(bright, expected).fitted);
  EXPECT_NE(this->observer_->record().light.region_threshold, threshold);
  // A new start forgets it.
  this->observer_->begin();
  EXPECT_EQ(this->observer_->record().light.region_threshold,
            first_light<TypeParam>(this->scene_.model).region_threshold);
}

TYPED_TEST(SheetObserverOf, ListsNothingOfAFieldThatWasCleared) {
  static_cast<void>(this->observer_->observe(this->draw(), this->expect_off_by(0.0, 1.0)));
  EXPECT_GT(this->observer_->record().measured.size(), 0);
  this->observer_->clear_field();
  EXPECT_EQ(this->observer_->record().measured.size(), 0);
}

}  // namespace
}  // namespace tubesight::core::tracking
