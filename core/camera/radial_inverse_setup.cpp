#include "core/camera/radial_inverse_setup.h"

#include <algorithm>
#include <cmath>

#include "core/base/trigonometry.h"

namespace tubesight::core::camera {
namespace {

// Below this slope of R over r the picture is taken to fold over.
constexpr double kLeastSlope = 1.0 / 32.0;
constexpr double kFarthest = 1.8;
// Squares of distorted radii must stay below 4, the end of a Ratio.
constexpr double kFarthestDistorted = 1.95;

double ideal_radius(const RadialDistortion& d, double r) {
  return r * (1.0 + r * r * (d.k + d.k2 * r * r));
}

double slope(const RadialDistortion& d, double r) {
  return 1.0 + r * r * (3.0 * d.k + 5.0 * d.k2 * r * r);
}

// The distorted radius up to which the mapping grows, at most `largest`.
double growing_until(const RadialDistortion& d, double largest) {
  constexpr int kSteps = 512;
  const auto grows = [&d](double r) {
    return slope(d, r) >= kLeastSlope && ideal_radius(d, r) <= kFarthest;
  };
  double last = 0.0;
  for (int i = 1; i <= kSteps && grows(largest * i / kSteps); ++i) {
    last = largest * i / kSteps;
  }
  for (double step = largest / (2 * kSteps); step > largest * 1e-9; step /= 2.0) {
    last += last + step <= largest && grows(last + step) ? step : 0.0;
  }
  return last;
}

// The ideal radius up to which anything can be undone.
double domain_of(const RadialDistortion& d, double pixels) {
  // R^2 with |k| R^2 + |k2| R^4 <= 2, and at most 16,000 px off the axis.
  const double last = growing_until(d, kFarthestDistorted);
  double domain = std::min(ideal_radius(d, last), 16000.0 / pixels);
  while (std::abs(d.k) * domain * domain + std::abs(d.k2) * domain * domain * domain * domain >
         2.0) {
    domain *= 0.99;
  }
  return domain;
}

// r / R where the mapping grows up to r = `largest`.
double radial_factor(const RadialDistortion& d, double R, double largest) {
  double low = 0.0;
  double high = largest;
  for (int i = 0; i < 64; ++i) {
    const double middle = (low + high) / 2.0;
    (ideal_radius(d, middle) < R ? low : high) = middle;
  }
  return (low + high) / 2.0 / R;
}

double start_value(const RadialInverse& inverse, double R2) {
  const double t = (R2 - inverse.middle) * inverse.scale;
  double m = 0.0;
  for (auto c = inverse.coefficients.rbegin(); c != inverse.coefficients.rend(); ++c) {
    m = m * t + *c;
  }
  return m;
}

// Interpolates at Chebyshev's points: Newton's divided differences, expanded into powers of t.
void fit_coefficients(const RadialDistortion& d, double largest, RadialInverse& inverse) {
  constexpr auto kCount = static_cast<std::size_t>(kRadialCoefficients);
  std::array<double, kCount> t{};
  std::array<double, kCount> differences{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = kPi * static_cast<double>(2 * i + 1) / static_cast<double>(2 * kCount);
    const double R2 = inverse.reach2 * (1.0 - sine_cosine(angle).cosine) / 2.0;
    t[i] = (R2 - inverse.middle) * inverse.scale;
    differences[i] = radial_factor(d, std::sqrt(R2), largest);
  }
  for (std::size_t order = 1; order < kCount; ++order) {
    for (std::size_t i = kCount - 1; i >= order; --i) {
      differences[i] = (differences[i] - differences[i - 1]) / (t[i] - t[i - order]);
    }
  }
  // Horner's scheme on (t - t_i): each round multiplies the polynomial so far and adds one term.
  std::array<double, kCount>& c = inverse.coefficients;
  c.fill(0.0);
  for (std::size_t i = kCount; i-- > 0;) {
    for (std::size_t power = kCount - 1; power > 0; --power) {
      c[power] = c[power - 1] - t[i] * c[power];
    }
    c[0] = differences[i] - t[i] * c[0];
  }
}

// The worst error of the radius over the polynomial's range after `steps` of Newton's method.
double worst_error(const RadialDistortion& d, double largest, const RadialInverse& inverse,
                   std::int32_t steps) {
  constexpr int kSamples = 200;
  double worst = 0.0;
  for (int i = 1; i <= kSamples; ++i) {
    const double R2 = inverse.reach2 * i / kSamples;
    const double R = std::sqrt(R2);
    double m = start_value(inverse, R2);
    for (std::int32_t step = 0; step < steps; ++step) {
      m -= (ideal_radius(d, R * m) / R - 1.0) / slope(d, R * m);
    }
    worst = std::max(worst, R * std::abs(m - radial_factor(d, R, largest)));
  }
  return worst;
}

}  // namespace

Result<RadialInverse> fit_radial_inverse(const RadialDistortion& distortion, double corner,
                                         double pixels, double tolerance) {
  if (!(corner > 0.0) || !(corner <= kFarthest * 1.5)) {
    return Unexpected(Error::kOutOfRange);
  }
  const double domain = domain_of(distortion, pixels);
  double largest = growing_until(distortion, corner * 1.25);
  while (largest >= corner && ideal_radius(distortion, largest) > domain) {
    largest -= corner / 1024.0;
  }
  if (!(largest >= corner)) {
    return Unexpected(Error::kOutOfRange);
  }
  RadialInverse inverse;
  const double R = ideal_radius(distortion, largest);
  inverse.reach2 = R * R;
  inverse.domain2 = domain * domain;
  inverse.scale = std::floor(std::min(2.0 / inverse.reach2, 16000.0) * 256.0) / 256.0;
  inverse.middle = std::floor(inverse.reach2 / 2.0 * 1048576.0) / 1048576.0;
  fit_coefficients(distortion, largest, inverse);
  constexpr std::int32_t kMaxSteps = 6;
  while (inverse.newton_steps < kMaxSteps &&
         worst_error(distortion, largest, inverse, inverse.newton_steps) > tolerance) {
    ++inverse.newton_steps;
  }
  return inverse;
}

}  // namespace tubesight::core::camera
