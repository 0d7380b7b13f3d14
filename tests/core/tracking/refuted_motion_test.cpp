#include "core/tracking/refuted_motion.h"

#include <chrono>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

/// Pictures of a square pitch of 25.4 mm, 20 ms apart, at 300 mm/s and 3000 mm/s^2 at most: 7.5 mm
/// from one to the next, and 1.2 mm off the way so far.
template <typename S>
class RefutedMotionOf : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.settings->motion = {300.0, 3000.0};
    scene_.make();
    motion_ = std::make_unique<RefutedMotion<S>>(scene_.model);
  }
  static Field field(int number) {
    Field field;
    field.mid_exposure = std::chrono::milliseconds(20 * number);
    return field;
  }
  static PlaceSeen<S> at(double x, double y = 0.0) {
    return {{0, 0}, {Mm<S>(x), Mm<S>(y)}, Mm<S>(0.125)};
  }
  /// The track expects the tool at (x, 0) and moves by `way` from field to field.
  static PlaceExpected<S> expected(double x, double way) {
    return {{Mm<S>(x), Mm<S>{}}, {Mm<S>(way), Mm<S>{}}, Mm<S>(1.2)};
  }
  bool refute(int number, double seen, double expects, double way) {
    return motion_->refute(field(number), at(seen), expected(expects, way));
  }
  bool come_back(int number, double seen) { return motion_->come_back(field(number), at(seen)); }

  Scene<S> scene_;
  std::unique_ptr<RefutedMotion<S>> motion_;
};
TYPED_TEST_SUITE(RefutedMotionOf, Scalars);

TYPED_TEST(RefutedMotionOf, ATrackThatDrivesOverAToolAtRestIsAJump) {
  EXPECT_FALSE(this->refute(1, 10.0, 4.0, 3.0)) << "as two fields ahead";
  EXPECT_TRUE(this->motion_->undecided());
  EXPECT_FALSE(this->refute(2, 10.0, 7.0, 3.0));
  EXPECT_TRUE(this->come_back(3, 10.0));
}

TYPED_TEST(RefutedMotionOf, LatticeStepsDoNotCount) {
  EXPECT_FALSE(this->refute(1, 10.0, 4.0, 3.0));
  EXPECT_FALSE(this->refute(2, 10.0 - 25.4, 7.0, 3.0));
  EXPECT_TRUE(this->come_back(3, 10.0 + 2 * 25.4));
}

TYPED_TEST(RefutedMotionOf, OneRefutedPictureAndTwoThatFitAreAJumpWhereTheyMakeOneMotion) {
  EXPECT_FALSE(this->refute(1, 1.0, 4.0, 3.0));
  EXPECT_FALSE(this->come_back(2, 6.5));
  EXPECT_TRUE(this->motion_->undecided()) << "5.5 mm in a field: it may have come from there";
  EXPECT_TRUE(this->come_back(3, 12.0));
}

TYPED_TEST(RefutedMotionOf, AnOldPictureLeadsNowhere) {
  // At 150 mm/s, the picture of two fields before; then the track's own motion.
  EXPECT_FALSE(this->refute(1, -3.0, 3.0, 3.0));
  EXPECT_FALSE(this->come_back(2, 6.0));
  EXPECT_FALSE(this->come_back(3, 9.0));
  EXPECT_FALSE(this->motion_->undecided());
}

TYPED_TEST(RefutedMotionOf, FieldsInTheWrongOrderLeadNowhere) {
  EXPECT_FALSE(this->refute(1, 6.0, 3.0, 3.0));
  EXPECT_FALSE(this->refute(2, 3.0, 6.0, 3.0));
  EXPECT_FALSE(this->come_back(3, 9.0));
  EXPECT_FALSE(this->motion_->undecided());
}

TYPED_TEST(RefutedMotionOf, OnePictureFarFromTheWholeMotionIsAJump) {
  EXPECT_TRUE(this->refute(1, 10.0, 0.0, 0.0)) << "the tool was at rest";
  this->motion_->forget();
  EXPECT_TRUE(this->motion_->refute(this->field(2), this->at(3.0, 9.0), this->expected(3.0, 3.0)));
  this->motion_->forget();
  EXPECT_FALSE(this->refute(3, 25.4 + 1.5, 0.0, 0.0)) << "hardly beside a tube: a picture may err";
}

TYPED_TEST(RefutedMotionOf, ForgetsWhatIsLongAgo) {
  EXPECT_FALSE(this->refute(1, 3.0, 0.0, 3.0));
  EXPECT_FALSE(this->come_back(40, 3.0));
  EXPECT_FALSE(this->motion_->undecided());
}

}  // namespace
}  // namespace tubesight::core::tracking
