#include "core/math/polynomial.h"

#include <cmath>

namespace tubesight::core::math {
namespace {

using Roots = StaticVector<double, 8>;

double value_at(const Quartic& k, std::size_t degree, double x) {
  double value = k[degree];
  for (std::size_t i = degree; i-- > 0;) {
    value = value * x + k[i];
  }
  return value;
}

double size_at(const Quartic& k, std::size_t degree, double x) {
  double size = 0.0;
  double power = 1.0;
  for (std::size_t i = 0; i <= degree; ++i) {
    size += std::abs(k[i]) * power;
    power *= std::abs(x);
  }
  return size;
}

// The root of a rising or falling polynomial with a change of sign between the ends.
double bisect(const Quartic& k, std::size_t degree, double low, double high) {
  const bool rising = value_at(k, degree, low) < 0.0;
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    if ((value_at(k, degree, middle) < 0.0) == rising) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return 0.5 * (low + high);
}

bool touches_zero(const Quartic& k, std::size_t degree, double x) {
  return std::abs(value_at(k, degree, x)) <= 1e-9 * size_at(k, degree, x);
}

// Roots of the polynomial between the turning points given.
Roots roots_between(const Quartic& k, std::size_t degree, const Roots& turns, double least,
                    double most) {
  Roots roots;
  double low = least;
  bool touched = touches_zero(k, degree, low);
  if (touched) {
    static_cast<void>(roots.try_push_back(low));
  }
  for (std::int32_t i = 0; i <= turns.size(); ++i) {
    const double high = i < turns.size() ? turns[i] : most;
    const bool touches = touches_zero(k, degree, high);
    const bool changes = (value_at(k, degree, low) < 0.0) != (value_at(k, degree, high) < 0.0);
    if (touches) {
      static_cast<void>(roots.try_push_back(high));
    } else if (changes && !touched) {
      static_cast<void>(roots.try_push_back(bisect(k, degree, low, high)));
    }
    low = high;
    touched = touches;
  }
  return roots;
}

}  // namespace

Roots real_roots(const Quartic& coefficients, double least, double most) {
  // The derivatives, the last of them linear.
  std::array<Quartic, 4> derivatives{};
  derivatives[0] = coefficients;
  for (std::size_t order = 1; order < 4; ++order) {
    for (std::size_t i = 0; i + order < 5; ++i) {
      derivatives[order][i] = derivatives[order - 1][i + 1] * static_cast<double>(i + 1);
    }
  }
  Roots roots;
  for (std::size_t order = 4; order-- > 0;) {
    roots = roots_between(derivatives[order], 4 - order, roots, least, most);
  }
  return roots;
}

}  // namespace tubesight::core::math
