#include "core/tracking/attitude_gate.h"

#include <gtest/gtest.h>

#include "core/base/overflow.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

constexpr double kRad = 3.14159265358979323846 / 180.0;
constexpr double kField_s = 1.0 / 60.0;

/// A level sheet over a camera that looks at it square, in fields 1/60 s apart; each picture knows
/// its numbers to a tenth of what they are systematically off.
template <typename S>
class AttitudeGateOf : public ::testing::Test {
 protected:
  void make() {
    scene_.make();
    last_.pose.x_axis = {Unit<S>(1.0), {}, {}};
    last_.pose.y_axis = {{}, Unit<S>(1.0), {}};
    last_.pose.normal = {{}, {}, Unit<S>(1.0)};
    last_.tool.height_mm = Mm<S>(50.0);
    last_.fit.used = 25;
    last_.looked_at = 30;
    last_.attitude = {Mm<S>(0.02), Mm<S>(0.0004), Mm<S>(0.0006)};
    motion_.known = true;
    motion_.interval_s = Unit<S>(kField_s);
  }
  /// The next picture, turned and risen; the prediction is turned and risen by the share of it.
  [[nodiscard]] Reason refuses(double heading_deg, double lean_deg, double rise_mm,
                               double predicted = 0.0) const {
    Observation<S> seen = last_;
    move<S>(seen.pose, {Mm<S>(lean_deg * kRad), {}, Mm<S>(heading_deg * kRad)}, {});
    seen.tool.height_mm = Mm<S>(50.0 + rise_mm);
    SheetPose<S> pose = last_.pose;
    move<S>(pose, {Mm<S>(predicted * lean_deg * kRad), {}, Mm<S>(predicted * heading_deg * kRad)},
            {});
    return refuses_attitude<S>(scene_.model, seen, pose, Mm<S>(50.0 + predicted * rise_mm), last_,
                               motion_, Unit<S>(kField_s));
  }

  Scene<S> scene_;
  Observation<S> last_{};
  Motion<S> motion_{};
};
TYPED_TEST_SUITE(AttitudeGateOf, Scalars);

TYPED_TEST(AttitudeGateOf, BelievesWhatRobotsDo) {
  this->make();
  EXPECT_EQ(this->refuses(0.0, 0.0, 0.0), Reason::kNone);
  EXPECT_EQ(this->refuses(0.8, 0.4, 0.8), Reason::kNone);
  EXPECT_EQ(this->refuses(-0.8, -0.4, -0.8), Reason::kNone);
  EXPECT_EQ(this->refuses(4.0, 0.4, 4.0, 1.0), Reason::kNone) << "as it moved before";
}

TYPED_TEST(AttitudeGateOf, DoubtsAStepOfFourDegreesInOneField) {
  this->make();
  EXPECT_EQ(this->refuses(4.0, 0.0, 0.0), Reason::kJump);
  EXPECT_EQ(this->refuses(-4.0, 0.0, 0.0), Reason::kJump);
  this->motion_.known = false;
  EXPECT_EQ(this->refuses(4.0, 0.0, 0.0), Reason::kNone) << "240 degrees a second";
  EXPECT_EQ(this->refuses(9.0, 0.0, 0.0), Reason::kSpeed);
}

TYPED_TEST(AttitudeGateOf, DoubtsAStepOfLean) {
  this->make();
  EXPECT_EQ(this->refuses(0.0, 2.0, 0.0), Reason::kSpeed);
  EXPECT_EQ(this->refuses(0.0, -2.0, 0.0), Reason::kSpeed);
}

TYPED_TEST(AttitudeGateOf, DoubtsAStepOfHeight) {
  this->make();
  EXPECT_EQ(this->refuses(0.0, 0.0, 3.4), Reason::kJump);
  EXPECT_EQ(this->refuses(0.0, 0.0, -3.4), Reason::kJump);
  EXPECT_EQ(this->refuses(0.0, 0.0, 9.0), Reason::kSpeed);
}

// Half a turn in 0.6 s: 600 degrees a second, 2000 degrees/s^2; leans of 3 degrees as fast as one
// likes.
TYPED_TEST(AttitudeGateOf, LetsPassWhatTheSettingsSay) {
  auto& motion = this->scene_.settings->motion;
  motion.max_turn_speed_deg_s = 600.0;
  motion.max_turn_acceleration_deg_s2 = 2000.0;
  motion.max_lean_speed_deg_s = 180.0;
  motion.max_lean_acceleration_deg_s2 = 10000.0;
  motion.max_height_speed_mm_s = 500.0;
  motion.max_height_acceleration_mm_s2 = 20000.0;
  this->make();
  EXPECT_EQ(this->refuses(10.0, 0.0, 0.0, 0.9), Reason::kNone);
  EXPECT_EQ(this->refuses(0.0, 3.0, 0.0), Reason::kNone);
  EXPECT_EQ(this->refuses(0.0, 0.0, 5.0), Reason::kNone);
}

// The greatest acceleration that a file may have, behind a tenth of a second without a picture.
TYPED_TEST(AttitudeGateOf, KeepsItsNumbersInRangeWhateverTheSettingsSay) {
  this->scene_.settings->motion.max_height_acceleration_mm_s2 = 1.0e6;
  this->make();
  static_cast<void>(take_overflow_flag());
  EXPECT_EQ(refuses_attitude<TypeParam>(this->scene_.model, this->last_, this->last_.pose,
                                        this->last_.tool.height_mm, this->last_, this->motion_,
                                        Unit<TypeParam>(0.1)),
            Reason::kNone);
  EXPECT_FALSE(take_overflow_flag());
}

TYPED_TEST(AttitudeGateOf, HeightIsLimitedAsThePlaceWhereNothingElseIsSet) {
  this->scene_.settings->motion.max_acceleration_mm_s2 = 20000.0;
  this->make();
  EXPECT_EQ(this->refuses(0.0, 0.0, 4.0), Reason::kNone);
  EXPECT_EQ(this->refuses(0.0, 0.0, 7.0), Reason::kSpeed);
}

TYPED_TEST(AttitudeGateOf, DoubtsAPictureWhoseTubeEndsAreSuddenlyGone) {
  this->make();
  Observation<TypeParam> seen = this->last_;
  const auto refused = [&](std::int32_t used) {
    seen.fit.used = used;
    return refuses_attitude<TypeParam>(this->scene_.model, seen, this->last_.pose,
                                       this->last_.tool.height_mm, this->last_, this->motion_,
                                       Unit<TypeParam>(kField_s));
  };
  EXPECT_EQ(refused(2), Reason::kNoTubes);
  EXPECT_EQ(refused(8), Reason::kNoTubes);
  EXPECT_EQ(refused(9), Reason::kNone);
  EXPECT_TRUE(few_are_left<TypeParam>(seen, this->last_, 2)) << "nor half";
  seen.looked_at = 5;
  EXPECT_EQ(refused(1), Reason::kNone) << "of so few a share says nothing";
  EXPECT_FALSE(few_are_left<TypeParam>(seen, this->last_, 2));
}

}  // namespace
}  // namespace tubesight::core::tracking
