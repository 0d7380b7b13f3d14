#include "core/base/trigonometry.h"

#include <cstdint>

namespace tubesight::core {
namespace {

// Taylor series on [-pi/4, pi/4]: the first term left out is below 2e-17 of the leading one.
double sine_series(double x) {
  const double s = x * x;
  double sum = 1.0;
  for (int n = 16; n >= 2; n -= 2) {
    sum = 1.0 - s / static_cast<double>(n * (n + 1)) * sum;
  }
  return x * sum;
}

double cosine_series(double x) {
  const double s = x * x;
  double sum = 1.0;
  for (int n = 17; n >= 1; n -= 2) {
    sum = 1.0 - s / static_cast<double>(n * (n + 1)) * sum;
  }
  return sum;
}

}  // namespace

SineCosine sine_cosine(double angle_rad) {
  // pi/2 in two parts: the first has trailing zeros, so that its multiples are exact.
  constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
  constexpr double kHalfPiLow = 6.07710050650619224932e-11;
  const double turns = angle_rad / (kPi / 2.0);
  const auto quarter = static_cast<std::int64_t>(turns + (turns < 0.0 ? -0.5 : 0.5));
  const auto count = static_cast<double>(quarter);
  const double x = (angle_rad - count * kHalfPiHigh) - count * kHalfPiLow;
  const double s = sine_series(x);
  const double c = cosine_series(x);
  switch (((quarter % 4) + 4) % 4) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace tubesight::core
