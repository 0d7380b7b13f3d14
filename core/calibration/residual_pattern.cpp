#include "core/calibration/residual_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

constexpr int kTerms = 10;
constexpr std::int32_t kLeastDots = 4 * kTerms;
using Terms = Eigen::Matrix<double, kTerms, 1>;

Terms cubic(const Eigen::Vector2d& at) {
  const double x = at.x();
  const double y = at.y();
  Terms terms;
  terms << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return terms;
}

/// Squares of the residuals, and what of them is smooth.
struct Squares {
  double all = 0.0;
  double smooth = 0.0;
  std::int32_t dots = 0;
  std::int32_t views = 0;
};

void add_view(const CalibrationData& data, const CalibrationView& view, Squares& squares) {
  const auto used = [&](std::int32_t i) { return data.dots[i].used; };
  Eigen::Array2d least = Eigen::Array2d::Constant(HUGE_VAL);
  Eigen::Array2d most = -least;
  std::int32_t dots = 0;
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    if (used(i)) {
      least = least.min(data.dots[i].place_mm.head<2>().array());
      most = most.max(data.dots[i].place_mm.head<2>().array());
      ++dots;
    }
  }
  if (dots < kLeastDots) {
    return;
  }
  const Eigen::Array2d middle = 0.5 * (least + most);
  const Eigen::Array2d half = (0.5 * (most - least)).max(1e-9);
  Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, 2> right = Eigen::Matrix<double, kTerms, 2>::Zero();
  double all = 0.0;
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    if (used(i)) {
      const Terms terms = cubic((data.dots[i].place_mm.head<2>().array() - middle) / half);
      normal += terms * terms.transpose();
      right += terms * data.dots[i].residual_px.transpose();
      all += data.dots[i].residual_px.squaredNorm();
    }
  }
  math::Cholesky<kTerms> factor;
  if (!factor.factor(normal, 1e-10)) {
    return;  // dots in fewer than four lines
  }
  for (int i = 0; i < 2; ++i) {
    const Terms column = right.col(i);
    squares.smooth += column.dot(factor.solve(column));
  }
  squares.all += all;
  squares.dots += dots;
  ++squares.views;
}

}  // namespace

ResidualPattern residual_pattern(const CalibrationData& data) {
  Squares squares;
  for (const CalibrationView& view : data.views) {
    add_view(data, view, squares);
  }
  ResidualPattern pattern;
  if (squares.views == 0) {
    return pattern;
  }
  const double smooth = 2.0 * kTerms * squares.views;
  const double rest = 2.0 * squares.dots - smooth;
  const double noise = std::max(1e-300, (squares.all - squares.smooth) / rest);
  pattern.mean_px2 = squares.smooth / smooth;
  pattern.rms_px = std::sqrt(squares.smooth / squares.dots);
  pattern.ratio = pattern.mean_px2 / noise;
  pattern.spread = std::sqrt(2.0 / smooth + 2.0 / rest);
  return pattern;
}

}  // namespace tubesight::core::calibration
