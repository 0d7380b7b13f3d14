#include "core/verification/recent_fields.h"

#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::verification {
namespace {

using std::chrono::milliseconds;
using Recent = RecentFields<FixedPoint>;

void push(Recent& recent, std::int64_t number, std::int64_t time_ms) {
  RecentField<FixedPoint> field;
  field.sighting.field = number;
  field.sighting.time = milliseconds(time_ms);
  recent.push(field);
}

TEST(RecentFields, FindTheNearestAndOfTwoTheEarlier) {
  const auto recent = std::make_unique<Recent>();
  EXPECT_EQ(recent->nearest(milliseconds(5)), nullptr);
  push(*recent, 7, 100);
  push(*recent, 8, 120);
  push(*recent, 9, 140);

  EXPECT_EQ(recent->nearest(milliseconds(0))->sighting.field, 7);
  EXPECT_EQ(recent->nearest(milliseconds(129))->sighting.field, 8);
  EXPECT_EQ(recent->nearest(milliseconds(130))->sighting.field, 8);
  EXPECT_EQ(recent->nearest(milliseconds(131))->sighting.field, 9);
  EXPECT_EQ(recent->nearest(milliseconds(900))->sighting.field, 9);
}

TEST(RecentFields, KeepTheLastAndForgetTheOldest) {
  const auto recent = std::make_unique<Recent>();
  for (int i = 0; i < 3 * Recent::kCapacity; ++i) {
    push(*recent, i, 10 * i);
  }
  const std::int64_t last = 3 * Recent::kCapacity - 1;

  EXPECT_EQ(recent->last().sighting.field, last);
  EXPECT_NE(recent->find(last), nullptr);
  EXPECT_NE(recent->find(last - Recent::kCapacity + 1), nullptr);
  EXPECT_EQ(recent->find(last - Recent::kCapacity), nullptr);
  EXPECT_EQ(recent->find(last + 1), nullptr);
  EXPECT_EQ(recent->nearest(milliseconds(0))->sighting.field, last - Recent::kCapacity + 1);
}

TEST(RecentFields, HoldASecondOf120FieldsTwice) { static_assert(Recent::kCapacity >= 2 * 120); }

TEST(RecentFields, AreForgottenWhereTheTimeOfFieldsDoesNotGoOn) {
  const auto recent = std::make_unique<Recent>();
  RecentField<FixedPoint> field;
  field.sighting.status = FieldStatus::kGood;
  for (const int time_ms : {3'600'000, 100, 120}) {  // the first was stamped an hour ahead
    field.sighting.time = milliseconds(time_ms);
    field.sighting.field = time_ms;
    recent->push(field);
  }
  EXPECT_EQ(recent->newest(), milliseconds(120));
  EXPECT_EQ(recent->nearest(milliseconds(3'600'000))->sighting.field, 120);
  EXPECT_EQ(recent->find(3'600'000), nullptr);
}

TEST(RecentFields, KnowWhatTheyForgotUntilTheClockIsAnother) {
  const auto recent = std::make_unique<Recent>();
  RecentField<FixedPoint> field;
  field.sighting.status = FieldStatus::kGood;
  const auto come = [&](int time_ms) {
    field.sighting.time = milliseconds(time_ms);
    recent->push(field);
  };
  come(3'600'000);
  EXPECT_FALSE(recent->forgot_nearer(milliseconds(1))) << "it is kept";
  recent->clear();
  EXPECT_TRUE(recent->forgot_nearer(milliseconds(3'600'000)));
  come(3'600'020);
  EXPECT_TRUE(recent->forgot_nearer(milliseconds(3'600'010)));
  EXPECT_FALSE(recent->forgot_nearer(milliseconds(3'600'011)));
  recent->clear();
  recent->clear();  // twice before one field
  EXPECT_TRUE(recent->forgot_nearer(milliseconds(3'600'020)));
  come(100);
  EXPECT_FALSE(recent->forgot_nearer(milliseconds(90)));
}

TEST(RecentFields, TellTheLatestInstantThoughALateFieldIsOlder) {
  const auto recent = std::make_unique<Recent>();
  push(*recent, 1, 100);
  push(*recent, 2, 150);  // given up
  push(*recent, 3, 117);  // came after all

  EXPECT_EQ(recent->newest(), milliseconds(150));
  EXPECT_EQ(recent->nearest(milliseconds(118))->sighting.field, 3);
}

}  // namespace
}  // namespace tubesight::core::verification
