#include "board/bench/campaign/binomial_bounds.h"

#include <cmath>

namespace tubesight::board::campaign {
namespace {

// The continued fraction of the incomplete beta function, by Lentz's method: converges in some
// sqrt(max(a, b)) rounds for x below the mean.
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int round = 1; round < 10000; ++round) {
    const double m = round;
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / away_from_zero(1.0 + even * d);
    c = away_from_zero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / away_from_zero(1.0 + odd * d);
    c = away_from_zero(1.0 + odd / c);
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) {
      break;
    }
  }
  return fraction;
}

// The share of the beta distribution (a, b) below x.
double beta_share(double a, double b, double x) {
  if (x <= 0.0 || x >= 1.0) {
    return x <= 0.0 ? 0.0 : 1.0;
  }
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                       : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

// Where the share is `wanted`, by bisection: the share grows with x.
double beta_quantile(double a, double b, double wanted) {
  double low = 0.0;
  double high = 1.0;
  for (int round = 0; round < 100; ++round) {
    const double middle = (low + high) / 2.0;
    (beta_share(a, b, middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

}  // namespace

BinomialBounds binomial_bounds(std::int64_t events, std::int64_t trials) {
  constexpr double kTail = 0.025;
  BinomialBounds bounds;
  if (trials <= 0) {
    return bounds;
  }
  const auto k = static_cast<double>(events);
  const auto n = static_cast<double>(trials);
  if (events > 0) {
    bounds.lower = beta_quantile(k, n - k + 1.0, kTail);
  }
  if (events < trials) {
    bounds.upper = beta_quantile(k + 1.0, n - k, 1.0 - kTail);
  }
  return bounds;
}

}  // namespace tubesight::board::campaign
