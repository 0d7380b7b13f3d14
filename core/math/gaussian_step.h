#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace tubesight::core::math {

/// A step blurred by a Gaussian of unit sigma: its share of the rise, and the slope there.
struct GaussianStep {
  double share = 0.0;  ///< Phi(x), 0 to 1
  double slope = 0.0;  ///< its derivative
};

/// gaussian_step() by a table: libm's erfc() and exp() took two thirds of the time of an edge.
class GaussianTable {
 public:
  /// Beyond so many sigmas the step is over to 2e-9.
  static constexpr double kReach = 6.0;
  static constexpr double kNodesPerSigma = 32.0;
  static constexpr std::size_t kNodes = 2 * 6 * 32 + 1;

  constexpr GaussianTable() {
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double x = static_cast<double>(i) / kNodesPerSigma - kReach;
      const double size = x < 0.0 ? -x : x;
      const double slope = exp_of_minus(0.5 * x * x) / kRootTwoPi;
      // Phi(x) - 1/2 = phi(x) (x + x^3 / 3 + x^5 / 15 + ...): all terms of one sign.
      double sum = 0.0;
      double term = size;
      for (int odd = 3; term > 1e-18 * sum; odd += 2) {
        sum += term;
        term *= size * size / odd;
      }
      const double above = slope * sum;
      nodes_[i] = {x < 0.0 ? 0.5 - above : 0.5 + above, slope};
    }
  }

  /// Cubic through the shares and slopes of the nodes beside x: the share is right to 1e-8, the
  /// slope, which is that of the cubic, to 1e-6.
  [[nodiscard]] constexpr GaussianStep at(double x) const {
    if (!(x > -kReach)) {
      return {0.0, 0.0};
    }
    if (x >= kReach) {
      return {1.0, 0.0};
    }
    const double place = (x + kReach) * kNodesPerSigma;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    const double rise = nodes_[i + 1].share - nodes_[i].share;
    const double from = nodes_[i].slope / kNodesPerSigma;
    const double to = nodes_[i + 1].slope / kNodesPerSigma;
    const double square = 3.0 * rise - 2.0 * from - to;
    const double cube = from + to - 2.0 * rise;
    return {nodes_[i].share + t * (from + t * (square + t * cube)),
            (from + t * (2.0 * square + 3.0 * t * cube)) * kNodesPerSigma};
  }

 private:
  static constexpr double kRootTwoPi =
      std::numbers::sqrt2 / std::numbers::inv_sqrtpi;  // sqrt(2 pi)

  /// exp(-x) for 0 <= x <= 18 by its series at x / 64, squared six times.
  static constexpr double exp_of_minus(double x) {
    const double small = -x / 64.0;
    double sum = 1.0;
    double term = 1.0;
    for (int n = 1; n <= 16; ++n) {
      term *= small / n;
      sum += term;
    }
    for (int i = 0; i < 6; ++i) {
      sum *= sum;
    }
    return sum;
  }

  std::array<GaussianStep, kNodes> nodes_{};
};

/// Phi(x) and phi(x) of the normal distribution, by a table made at compile time.
[[nodiscard]] inline GaussianStep gaussian_step(double x) {
  static constexpr GaussianTable kTable;
  return kTable.at(x);
}

}  // namespace tubesight::core::math
