#include "core/tracking/field_clock.h"

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

using std::chrono::milliseconds;

Field field_at(std::int64_t sequence, std::int64_t at_ms, FieldStatus status = FieldStatus::kGood) {
  Field field;
  field.sequence = sequence;
  field.mid_exposure = milliseconds(at_ms);
  field.status = status;
  return field;
}

/// A clock that believed a field 100 at 1000 ms, and sees those given to it.
class FieldClockOf : public ::testing::Test {
 protected:
  void SetUp() override {
    clock_.begin();
    clock_.believe(field_at(100, 1000));
    clock_.see(field_at(100, 1000));
  }
  FieldClock::Passed pass(const Field& field, bool believed = true) {
    EXPECT_EQ(clock_.refuses(field), Reason::kNone);
    const FieldClock::Passed passed = clock_.pass(field);
    if (believed) {
      clock_.believe(field);
    }
    clock_.see(field);
    return passed;
  }

  FieldClock clock_;
};

TEST_F(FieldClockOf, RefusesTimeAndNumbersThatGoBack) {
  EXPECT_EQ(clock_.refuses(field_at(101, 1000)), Reason::kTime) << "the same instant is no later";
  EXPECT_EQ(clock_.refuses(field_at(101, 999)), Reason::kTime);
  EXPECT_EQ(clock_.refuses(field_at(99, 1020)), Reason::kSequence);
  EXPECT_EQ(clock_.refuses(field_at(100, 1020)), Reason::kNone) << "not every camera counts";
  EXPECT_EQ(clock_.refuses(field_at(0, 1020, FieldStatus::kMissing)), Reason::kNone)
      << "a missing field has no number";
}

TEST_F(FieldClockOf, TellsTheTimeSinceTheLastBelievedField) {
  EXPECT_EQ(pass(field_at(101, 1020), false).since_good, milliseconds(20));
  EXPECT_EQ(pass(field_at(102, 1040), false).since_good, milliseconds(40));
  EXPECT_EQ(pass(field_at(103, 1060), true).since_good, milliseconds(60));
  EXPECT_EQ(pass(field_at(104, 1080), true).since_good, milliseconds(20));
}

TEST_F(FieldClockOf, MissesNumbersThatWereLeftOut) {
  EXPECT_FALSE(pass(field_at(101, 1020)).missing);
  EXPECT_TRUE(pass(field_at(103, 1040)).missing);
  EXPECT_FALSE(pass(field_at(104, 1060)).missing);
}

TEST_F(FieldClockOf, TakesNumbersThatGrowByTwoAsUsual) {
  EXPECT_TRUE(pass(field_at(102, 1020)).missing) << "not known yet";
  EXPECT_FALSE(pass(field_at(104, 1040)).missing);
  EXPECT_TRUE(pass(field_at(107, 1060)).missing);
}

TEST_F(FieldClockOf, MissesTimeWhereNumbersTellNothing) {
  // Usual are 20 ms: up to 30 stamps only waver.
  EXPECT_FALSE(pass(field_at(100, 1020)).missing);
  EXPECT_FALSE(pass(field_at(100, 1049)).missing);
  EXPECT_TRUE(pass(field_at(100, 1081)).missing);
}

TEST_F(FieldClockOf, LetsLostNumbersLastAtLeastWhatOneTook) {
  EXPECT_EQ(pass(field_at(101, 1020)).since_good, milliseconds(20));
  EXPECT_EQ(pass(field_at(102, 1038)).since_good, milliseconds(20)) << "told by the number before";
  // Stamps say 20 ms, four numbers of 18 ms say 72.
  const FieldClock::Passed passed = pass(field_at(106, 1058));
  EXPECT_TRUE(passed.missing);
  EXPECT_EQ(passed.since_good, milliseconds(72));
}

TEST_F(FieldClockOf, TakesAMissingFieldForTimeAloneAndForgetsItsInstant) {
  static_cast<void>(pass(field_at(101, 1020)));
  const FieldClock::Passed missing = pass(field_at(0, 1055, FieldStatus::kMissing), false);
  EXPECT_TRUE(missing.missing);
  EXPECT_EQ(missing.since_good, milliseconds(35));
  // It comes after all, from before its giving up.
  const FieldClock::Passed late = pass(field_at(102, 1040));
  EXPECT_FALSE(late.missing);
  EXPECT_EQ(late.since_good, milliseconds(20));
}

TEST_F(FieldClockOf, TakesTheNumbersForTheTimeWhereStampsWaver) {
  const auto at = [](std::int64_t number, std::int64_t off_ms, FieldStatus status) {
    return field_at(100 + number, 1000 + 20 * number + off_ms, status);
  };
  std::int64_t number = 1;
  for (const std::int64_t off_ms : {0, 4, -5, 3, -2, 5, -4, 1, 4, -3, 0, -5, 5, 2, -1, -4}) {
    const FieldClock::Passed passed = pass(at(number, off_ms, FieldStatus::kGood));
    if (number > 8) {
      EXPECT_FALSE(passed.missing) << number;
      EXPECT_NEAR(static_cast<double>(passed.since_good.count()), 20e6, 1.5e6) << number;
    }
    ++number;
  }
  const FieldClock::Passed damaged = pass(at(number, 5, FieldStatus::kDamaged), false);
  EXPECT_NEAR(static_cast<double>(damaged.since_good.count()), 20e6, 1.5e6);
  const FieldClock::Passed second = pass(at(number + 1, -4, FieldStatus::kGood));
  EXPECT_NEAR(static_cast<double>(second.since_good.count()), 40e6, 3e6);
  const FieldClock::Passed gap = pass(at(number + 4, 2, FieldStatus::kGood));
  EXPECT_TRUE(gap.missing);
  EXPECT_NEAR(static_cast<double>(gap.since_good.count()), 60e6, 4e6);
  // Two fields left out, and no number tells.
  const FieldClock::Passed cut = pass(field_at(100 + number + 5, 1000 + 20 * (number + 7)));
  EXPECT_TRUE(cut.missing);
  EXPECT_GE(cut.since_good, milliseconds(56));
}

TEST_F(FieldClockOf, LearnsTheUsualSpanAnewAfterAStart) {
  static_cast<void>(pass(field_at(101, 1020)));
  EXPECT_EQ(clock_.usual_span_ns(), 20'000'000);
  static_cast<void>(pass(field_at(102, 1038)));
  static_cast<void>(pass(field_at(103, 1060)));
  EXPECT_EQ(clock_.usual_span_ns(), 18'000'000) << "the shortest";
  clock_.begin();
  EXPECT_EQ(clock_.usual_span_ns(), 0);
  EXPECT_FALSE(pass(field_at(104, 1160)).missing) << "ten a second are usual now";
  EXPECT_EQ(clock_.usual_span_ns(), 100'000'000);
}

}  // namespace
}  // namespace tubesight::core::tracking
