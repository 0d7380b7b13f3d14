#include "core/tracking/tool_gate.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

/// A gate at 300 mm/s and 3000 mm/s^2 over a lattice of 25.4 mm: the limit is 10.17 mm (410/1024 of
/// a step).
template <typename S>
class ToolGateOf : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.settings->motion = {300.0, 3000.0};
    scene_.make();
    gate_ = std::make_unique<ToolGate<S>>(scene_.model);
    motion_.known = true;
    motion_.interval_s = Unit<S>(0.02);
    gate_->close(Mm<S>(0.125), Mm<S>(0.0));
  }
  void open(double span_s, bool contradicted = false) {
    gate_->open(motion_, Unit<S>(span_s), contradicted);
  }
  [[nodiscard]] Reason refuses(double seen, double expected, double last, double span_s,
                               bool halved = false) const {
    return gate_->refuses({Mm<S>(seen), Mm<S>{}}, Mm<S>(0.125), halved, {Mm<S>(expected), Mm<S>{}},
                          {Mm<S>(last), Mm<S>{}}, Unit<S>(span_s));
  }

  Scene<S> scene_;
  Motion<S> motion_{};
  std::unique_ptr<ToolGate<S>> gate_;
};
TYPED_TEST_SUITE(ToolGateOf, Scalars);

TYPED_TEST(ToolGateOf, OpensByWhatAccelerationAllows) {
  // 3000 mm/s^2 * 0.02 s * (0.02 s + 0.02 s) / 2.
  this->open(0.02);
  EXPECT_NEAR(number(this->gate_->reach_mm()), 1.2, 1e-3);
  EXPECT_EQ(this->gate_->believed_mm(), this->gate_->reach_mm());
  EXPECT_FALSE(this->gate_->exceeds_limit());
}

TYPED_TEST(ToolGateOf, ExceedsTheLimitByReachAndThreeDeviations) {
  // 3000 * 0.071 * (0.071 + 0.02) / 2 = 9.69 mm and 0.375 mm; at 0.0725 s 10.06 mm and 0.375 mm.
  this->open(0.071);
  EXPECT_FALSE(this->gate_->exceeds_limit());
  this->open(0.0725);
  EXPECT_TRUE(this->gate_->exceeds_limit());
  EXPECT_EQ(this->gate_->why_exceeded(), Reason::kRate) << "3 * 0.0996 mm are too much as well";
  // A little less reach, 9.21 mm, and a poor picture.
  this->gate_->close(Mm<TypeParam>(0.5), {});
  this->open(0.069);
  EXPECT_TRUE(this->gate_->exceeds_limit());
  EXPECT_EQ(this->gate_->why_exceeded(), Reason::kUncertain);
}

TYPED_TEST(ToolGateOf, GrowsNoWiderForPicturesThatComeAfterAContradiction) {
  this->open(0.02);
  this->open(0.04, true);
  EXPECT_NEAR(number(this->gate_->reach_mm()), 3.6, 2e-3);
  EXPECT_NEAR(number(this->gate_->believed_mm()), 1.2, 1e-3);
  this->open(0.04, false);
  EXPECT_NEAR(number(this->gate_->believed_mm()), 3.6, 2e-3);
}

TYPED_TEST(ToolGateOf, RefusesAPlaceFartherThanReachAndThreeDeviations) {
  this->open(0.02);
  // 1.2 + 0.375 mm from where it is expected, to either side.
  EXPECT_EQ(this->refuses(4.0 + 1.56, 4.0, 4.0, 0.02), Reason::kNone);
  EXPECT_EQ(this->refuses(4.0 + 1.59, 4.0, 4.0, 0.02), Reason::kJump);
  EXPECT_EQ(this->refuses(4.0 - 1.59, 4.0, 4.0, 0.02), Reason::kJump);
}

TYPED_TEST(ToolGateOf, IsHalfAsWideForAPictureThatLostHalfOfItsTubeEnds) {
  this->open(0.02);
  // 0.6 + 0.375 mm.
  EXPECT_EQ(this->refuses(4.0 + 0.96, 4.0, 4.0, 0.02, true), Reason::kNone);
  EXPECT_EQ(this->refuses(4.0 + 0.99, 4.0, 4.0, 0.02, true), Reason::kJump);
}

TYPED_TEST(ToolGateOf, RefusesASpeedBeyondAQuarterAboveTheLimit) {
  this->open(0.02);
  // 300 mm/s * 1.25 * 0.02 s + 0.375 mm = 7.875 mm from the last place.
  EXPECT_EQ(this->refuses(7.85, 7.0, 0.0, 0.02), Reason::kNone);
  EXPECT_EQ(this->refuses(7.90, 7.0, 0.0, 0.02), Reason::kSpeed);
}

TYPED_TEST(ToolGateOf, TellsTheMarginInDeviationsLessWhatTheToolMayHaveStrayed) {
  EXPECT_NEAR(number(this->gate_->margin(Mm<TypeParam>(2.0))), 16.0, 1e-3);
  this->open(0.02);
  EXPECT_NEAR(number(this->gate_->margin(Mm<TypeParam>(2.0))), 16.0, 1e-3) << "not yet passed over";
  this->gate_->pass_over();
  EXPECT_NEAR(number(this->gate_->margin(Mm<TypeParam>(2.0))), 0.8 / 0.125, 0.01);
  this->gate_->close(Mm<TypeParam>(0.25), {});
  EXPECT_NEAR(number(this->gate_->margin(Mm<TypeParam>(2.0))), 8.0, 1e-3);
}

TYPED_TEST(ToolGateOf, LooksNoFartherThanTheLimitLessThreeDeviations) {
  EXPECT_NEAR(number(this->gate_->widest_look_mm()), 25.4 * 410 / 1024 - 0.375, 1e-3);
  this->gate_->close(Mm<TypeParam>(9.0), {});
  EXPECT_EQ(number(this->gate_->widest_look_mm()), 0.0);
}

}  // namespace
}  // namespace tubesight::core::tracking
