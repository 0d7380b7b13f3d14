#include "core/tracking/sheet_observer.h"

#include <algorithm>
#include <cstddef>
#include <random>

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

// A cloth or a shutter over the picture. Without noise it might be the plate.
TYPED_TEST(SheetObserverOf, SeesNothingOfWhatIsOneGreyValueAlone) {
  for (const double noise : {1.5, 0.0}) {
    this->sheet_->look.noise = noise;
    const FieldView clear = this->draw();
    const auto all = this->observer_->observe(clear, this->expect_off_by(0.0, 0.5));
    ASSERT_TRUE(all.fitted);
    for (const int grey : {25, 170}) {
      static_cast<void>(this->draw());
      const auto width = static_cast<std::size_t>(clear.width_px);
      for (std::size_t line = 0; line < this->frame_.size() / width; ++line) {
        std::fill_n(this->frame_.begin() + static_cast<std::ptrdiff_t>(line * width), width / 2,
                    static_cast<std::uint8_t>(grey));
      }
      const auto half = this->observer_->observe(clear, this->expect_off_by(0.0, 0.5));
      ASSERT_TRUE(half.fitted);
      EXPECT_GE(half.fit.used, 6);
      const std::int32_t unseen = all.looked_at - half.looked_at;
      EXPECT_EQ(unseen > 3, noise > 0.0) << unseen;
      EXPECT_LT(this->error_mm(half), 0.3);
      if (noise > 0.0) {
        EXPECT_FALSE(half.contradiction);
        // What is cut by the border alone.
        EXPECT_LE(this->observer_->record().sites.bright.size(), 4);
      }
    }
  }
}

// As by the camera's own LEDs, which light one side: tube-ends enough are no chance.
TYPED_TEST(SheetObserverOf, ConfirmsAStartByManyTubeEndsWhereTheRestIsDark) {
  for (const int grey : {8, 140}) {
    const FieldView field = this->draw();
    const auto width = static_cast<std::size_t>(field.width_px);
    std::mt19937 random(7);
    for (std::size_t i = 0; i < this->frame_.size(); ++i) {
      if (i % width > width * 2 / 5) {
        this->frame_[i] = static_cast<std::uint8_t>(grey + static_cast<int>(random() % 3));
      }
    }
    auto expected = this->expect_off_by(0.0, 0.5);
    expected.confirm_all = true;
    const auto seen = this->observer_->observe(field, expected);
    ASSERT_TRUE(seen.fitted);
    EXPECT_GE(seen.fit.used, 8);
    EXPECT_LT(2 * seen.fit.used, seen.looked_at);
    EXPECT_EQ(seen.contradiction, grey > 100);
  }
}

TYPED_TEST(SheetObserverOf, SeesTubeEndsThroughSpecks) {
  static_cast<void>(this->draw());
  std::mt19937 random(5);
  for (std::size_t i = 0; i < this->frame_.size() / 25; ++i) {
    this->frame_[random() % this->frame_.size()] = 255;
  }
  const auto seen = this->observer_->observe(this->sheet_->view(this->frame_, Parity::kEven),
                                             this->expect_off_by(0.0, 0.5));
  ASSERT_TRUE(seen.fitted);
  EXPECT_FALSE(seen.contradiction);
  EXPECT_EQ(this->observer_->record().sites.bright.size(), 0);
}

// What looks like plugs in one light are tube-ends in the other.
TYPED_TEST(SheetObserverOf, FollowsARaisedBlackLevelOnceTubeEndsProveIt) {
  this->sheet_->look.gain = 0.5;
  this->sheet_->look.offset = 80.0;
  const FieldView raised = this->draw();
  const auto expected = this->expect_off_by(0.0, 0.5);
  ASSERT_TRUE(this->observer_->observe(raised, expected).fitted);
  EXPECT_GT(this->observer_->record().light.region_threshold, 90);
  EXPECT_EQ(this->observer_->record().plugs_seen.size(), 0);
}

TYPED_TEST(SheetObserverOf, KeepsTheThresholdThatTheSettingsSet) {
  this->scene_.settings->edges.region_threshold = 50;
  this->make();
  this->sheet_->look.gain = 0.5;
  this->sheet_->look.offset = 80.0;
  EXPECT_FALSE(this->observer_->observe(this->draw(), this->expect_off_by(0.0, 0.5)).fitted);
  EXPECT_EQ(this->observer_->record().light.region_threshold, 50);
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
