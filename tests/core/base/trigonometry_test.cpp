#include "core/base/trigonometry.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

TEST(SineCosine, HasTheValuesKnownByHand) {
  const struct {
    double angle_deg;
    double sine;
    double cosine;
  } rows[] = {{0, 0, 1},
              {30, 0.5, 0.86602540378443865},
              {45, 0.70710678118654752, 0.70710678118654752},
              {60, 0.86602540378443865, 0.5},
              {90, 1, 0},
              {120, 0.86602540378443865, -0.5},
              {135, 0.70710678118654752, -0.70710678118654752},
              {180, 0, -1},
              {270, -1, 0},
              {-30, -0.5, 0.86602540378443865},
              {-90, -1, 0},
              {-180, 0, -1},
              {360, 0, 1}};
  for (const auto& row : rows) {
    const SineCosine actual = sine_cosine(radians(row.angle_deg));
    EXPECT_NEAR(actual.sine, row.sine, 5e-16) << row.angle_deg;
    EXPECT_NEAR(actual.cosine, row.cosine, 5e-16) << row.angle_deg;
  }
}

TEST(SineCosine, AgreesWithTheStandardLibrary) {
  for (int i = -200000; i <= 200000; ++i) {
    const double angle_rad = i * 5e-5;
    const SineCosine actual = sine_cosine(angle_rad);
    ASSERT_NEAR(actual.sine, std::sin(angle_rad), 4e-16) << angle_rad;
    ASSERT_NEAR(actual.cosine, std::cos(angle_rad), 4e-16) << angle_rad;
  }
  for (int i = -1000; i <= 1000; ++i) {
    const SineCosine actual = sine_cosine(i);
    ASSERT_NEAR(actual.sine, std::sin(i), 4e-16) << i;
    ASSERT_NEAR(actual.cosine, std::cos(i), 4e-16) << i;
  }
}

// The true sine and cosine of the double that radians() gives, rounded to the nearest double: from
// the 64-bit mantissa's sinl and cosl of an x87 unit, an independent source. A processor or a
// compiler that fuses or reorders would show here.
TEST(SineCosine, HasTheSameBitsEverywhere) {
  const struct {
    double angle_deg;
    std::uint64_t sine;
    std::uint64_t cosine;
  } rows[] = {{0.0, 0x0000000000000000, 0x3ff0000000000000},
              {30.0, 0x3fdfffffffffffff, 0x3febb67ae8584cab},
              {45.0, 0x3fe6a09e667f3bcc, 0x3fe6a09e667f3bcd},
              {47.9947, 0x3fe7c755d836fb92, 0x3fe56a14bf4fb435},
              {89.999, 0x3fefffffffeb111d, 0x3ef24d15211548ff},
              {135.0, 0x3fe6a09e667f3bcd, 0xbfe6a09e667f3bcc},
              {-0.0639, 0xbf5245c2d9187a51, 0x3feffffeb21d900d},
              {-271.25, 0x3feffe0cef42e875, 0x3f9656a42728632f}};
  for (const auto& row : rows) {
    const SineCosine actual = sine_cosine(radians(row.angle_deg));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(actual.sine), row.sine) << row.angle_deg;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(actual.cosine), row.cosine) << row.angle_deg;
  }
}

TEST(SineCosine, LiesOnTheUnitCircle) {
  for (int i = 0; i < 3600; ++i) {
    const SineCosine actual = sine_cosine(radians(i * 0.1));
    ASSERT_NEAR(actual.sine * actual.sine + actual.cosine * actual.cosine, 1.0, 1e-15) << i;
  }
}

}  // namespace
}  // namespace tubesight::core
