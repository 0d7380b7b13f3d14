#include "core/tracking/field_order.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

/// How the fields were really taken: `t` in fields, as told.
enum class Taken { kAsTold, kSwapped, kAtOnce };

/// When the field with this number was taken, in fields; even numbers are told to be a frame's
/// first.
double instant(int field, Taken taken) {
  const bool first = field % 2 == 0;
  switch (taken) {
    case Taken::kAsTold: return field;
    case Taken::kSwapped: return first ? field + 1 : field - 1;
    case Taken::kAtOnce: return first ? field + 0.5 : field - 0.5;
  }
  return field;
}

using Way = std::function<double(double)>;  // mm along x after so many fields

constexpr std::int32_t kFastestChange = 853;  // 3000 mm/s^2 at 60 fields a second, in 1/1024 mm

class FieldOrderOf : public ::testing::TestWithParam<Taken> {
 protected:
  /// Rest for 20 fields, then the way; until it is judged wrong or the fields are used up.
  int fields_until_wrong(const Way& way, int most, double noise_mm = 0.02) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, noise_mm);
    for (int i = 0; i < most; ++i) {
      const double t = instant(i, GetParam()) - 20.0;
      const double x = (t > 0.0 ? way(t) : 0.0) + noise(random);
      order_.take({static_cast<std::int32_t>(std::lround(x * 1024.0)),
                   static_cast<std::int32_t>(std::lround(noise(random) * 1024.0))},
                  i % 2 == 0);
      if (order_.wrong()) {
        return i;
      }
    }
    return -1;
  }

  FieldOrder order_;
};

class FieldOrderAsTold : public FieldOrderOf {};
INSTANTIATE_TEST_SUITE_P(All, FieldOrderAsTold, ::testing::Values(Taken::kAsTold));
class FieldOrderNotAsTold : public FieldOrderOf {};
INSTANTIATE_TEST_SUITE_P(All, FieldOrderNotAsTold,
                         ::testing::Values(Taken::kSwapped, Taken::kAtOnce));

TEST_P(FieldOrderNotAsTold, IsFoundInTheFirstSecondOfASlowMove) {
  for (const double mm_s : {6.0, 10.0, 15.0}) {
    order_.begin();
    const int found = fields_until_wrong([&](double t) { return mm_s / 60.0 * t; }, 100, 0.01);
    EXPECT_GE(found, 20 + 2 * 15) << mm_s;
    EXPECT_LT(found, 20 + 60) << mm_s;
  }
}

TEST_P(FieldOrderNotAsTold, ExplainsAFastMoveThatContradictsItself) {
  for (const double mm_s : {40.0, 100.0, 300.0}) {
    const double v = mm_s / 60.0;
    const double a = 2000.0 / 3600.0;
    const double ramp = v / a;
    order_.begin();
    fields_until_wrong([&](double t) { return t < ramp ? a * t * t / 2.0 : v * (t - ramp / 2.0); },
                       26);
    EXPECT_TRUE(order_.explains(kFastestChange)) << mm_s;
  }
}

TEST_P(FieldOrderAsTold, IsNeverFoundWrongInMovesAndVibrations) {
  for (const double hz : {7.0, 12.0, 14.9, 15.0, 15.1, 18.0, 25.0, 29.5, 30.5}) {
    for (const double mm_s : {0.0, 6.0, 20.0, 100.0}) {
      for (const double amplitude : {0.05, 0.15, 0.5}) {
        for (const double phase : {0.0, 0.7, 1.9, 3.3, 5.0}) {
          order_.begin();
          const auto way = [&](double t) {
            return mm_s / 60.0 * t +
                   amplitude * (std::sin(2.0 * M_PI * hz / 60.0 * t + phase) - std::sin(phase));
          };
          EXPECT_EQ(fields_until_wrong(way, 200), -1) << hz << " Hz, " << mm_s << ", " << phase;
        }
      }
    }
  }
}

TEST_P(FieldOrderAsTold, ExplainsNoJumpAndNoHardAcceleration) {
  for (const double jump : {1.5, 4.0, 8.0}) {
    for (const double start : {0.5, 1.5}) {
      order_.begin();
      fields_until_wrong([&](double t) { return t > start ? jump : 0.0; }, 24);
      EXPECT_FALSE(order_.explains(kFastestChange)) << jump << ", " << start;
    }
  }
  for (const double change : {1.2, 2.0, 4.0}) {
    order_.begin();
    fields_until_wrong([&](double t) { return change * t * t / 2.0; }, 24);
    EXPECT_FALSE(order_.explains(kFastestChange)) << change;
  }
}

TEST_P(FieldOrderAsTold, IsSettledByAMoveUntilTheNextStart) {
  EXPECT_EQ(fields_until_wrong([](double t) { return 0.3 * t; }, 60), -1);
  // Whatever comes now, the settings were right: a fault of the camera's.
  for (int i = 0; i < 80; ++i) {
    order_.take({static_cast<std::int32_t>(1024 * (i + (i % 2 == 0 ? 1 : -1))), 0}, i % 2 == 0);
  }
  EXPECT_FALSE(order_.wrong());
  EXPECT_FALSE(order_.explains(kFastestChange));
}

TEST(FieldOrder, StartsAnewAfterAFieldThatIsMissing) {
  FieldOrder order;
  for (int i = 0; i < 80; ++i) {
    order.take({102 * (i + (i % 2 == 0 ? 1 : -1)), 0}, i % 2 == 0);
    order.miss();
  }
  EXPECT_FALSE(order.wrong());
}

TEST(FieldOrder, IsNotMisledByAChangeOfTheTubeThatPlacesAreSeenFrom) {
  FieldOrder order;
  for (int i = 0; i < 80; ++i) {
    const int from = 26010 * (i / 8);  // another tube every eight fields
    if (i % 8 == 0 && i > 0) {
      order.shift({-26010, 0});
    }
    order.take({102 * (i + (i % 2 == 0 ? 1 : -1)) - from, 0}, i % 2 == 0);
  }
  EXPECT_TRUE(order.wrong());
}

}  // namespace
}  // namespace tubesight::core::tracking
