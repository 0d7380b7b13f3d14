#include "core/lighting/lamp_pattern.h"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "core/lighting/lamp_policy.h"

namespace tubesight::core::lighting {
namespace {

using std::chrono::milliseconds;

std::vector<std::int32_t> signs_of(std::uint32_t seed, int count) {
  LampPattern pattern;
  pattern.begin(seed);
  std::vector<std::int32_t> signs;
  for (int i = 0; i < count; ++i) {
    signs.push_back(pattern.sign_after(kChip * i + milliseconds(3)));
  }
  return signs;
}

TEST(LampPattern, HoldsEachSignForAChip) {
  LampPattern pattern;
  pattern.begin(7);
  int changes = 0;
  std::int32_t last = 0;
  int held = 0;
  for (int ms = 0; ms < 60'000; ms += 10) {
    const std::int32_t sign = pattern.sign_after(milliseconds(ms));
    if (last != 0 && sign != last) {
      EXPECT_EQ(held % 5, 0) << "at " << ms << " ms";
      ++changes;
      held = 0;
    }
    last = sign;
    ++held;
  }
  // A sign changes at every second chip as a rule: 600 of 1200, with a sigma of 17.
  EXPECT_NEAR(changes, 600, 90);
}

TEST(LampPattern, HasAsMuchBrightAsDim) {
  std::int32_t sum = 0;
  for (const std::int32_t sign : signs_of(1, 10'000)) {
    ASSERT_EQ(std::abs(sign), 1);
    sum += sign;
  }
  EXPECT_LT(std::abs(sum), 400) << "4 sigma";
}

TEST(LampPattern, DiffersFromSeedToSeed) {
  const auto one = signs_of(1, 2'000);
  for (const std::uint32_t seed : {0U, 2U, 3U, 1U << 31, 0xFFFF'FFFFU}) {
    const auto other = signs_of(seed, 2'000);
    // Nor one that is a little earlier or later.
    for (std::size_t shift = 0; shift < 20; ++shift) {
      std::int32_t likeness = 0;
      for (std::size_t i = 0; i + shift < one.size(); ++i) {
        likeness += one[i] * other[i + shift];
      }
      EXPECT_LT(std::abs(likeness), 250) << "seed " << seed << ", " << shift << " later";
    }
  }
}

TEST(LampPattern, GoesOnWhereTheClockRunsBack) {
  LampPattern pattern;
  pattern.begin(3);
  static_cast<void>(pattern.sign_after(std::chrono::hours(5)));
  std::int32_t sum = 0;
  for (int i = 0; i < 1'000; ++i) {
    sum += pattern.sign_after(kChip * i);
  }
  EXPECT_LT(std::abs(sum), 200);
}

TEST(SwungLevel, StaysWithinTwoPercent) {
  for (std::int32_t level = kDimmest_permille; level <= 990; ++level) {
    const std::int32_t bright = swung_permille(level, 1, kSwing_permille, 1000);
    const std::int32_t dim = swung_permille(level, -1, kSwing_permille, 1000);
    EXPECT_GT(bright, dim);
    EXPECT_LE((bright - dim) * 50, level) << level;
    EXPECT_EQ(bright + dim, 2 * level);
  }
}

TEST(SwungLevel, StaysBelowTheMost) {
  EXPECT_EQ(swung_permille(1000, 1, 10, 1000), 1000);
  EXPECT_EQ(swung_permille(1000, -1, 20, 1000), 960);
  EXPECT_EQ(swung_permille(795, 1, 10, 800), 800);
}

TEST(SwungLevel, LeavesDimLightAlone) {
  EXPECT_EQ(swung_permille(0, 1, 10, 1000), 0);
  EXPECT_EQ(swung_permille(kDimmest_permille - 1, -1, 10, 1000), kDimmest_permille - 1);
}

}  // namespace
}  // namespace tubesight::core::lighting
