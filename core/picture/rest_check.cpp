#include "core/picture/rest_check.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace tubesight::core::picture {
namespace {

constexpr int kUnknowns = 8;  // du, dv and their four derivatives; gain and offset of the light
constexpr std::int32_t kColumnStep = 2;
constexpr std::int32_t kMargin_px = 2;

using Row = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// The least squares over the pixels of a picture: difference = -gradient . shift + light.
class ShiftFit {
 public:
  ShiftFit(std::int32_t width_px, std::int32_t height_px)
      : half_width_(width_px / 2.0), half_height_(height_px / 2.0) {}

  struct Sample {
    double reference = 0.0;  ///< grey level where nothing had moved
    double seen = 0.0;
    double slope_u = 0.0;  ///< of the reference, grey levels a pixel
    double slope_v = 0.0;
  };

  void add(std::int32_t u, std::int32_t v, const Sample& sample) {
    const double x = u / half_width_ - 1.0;
    const double y = v / half_height_ - 1.0;
    const double gu = -sample.slope_u;
    const double gv = -sample.slope_v;
    Row row;
    row << gu, gv, gu * x, gu * y, gv * x, gv * y, sample.reference, 1.0;
    normal_.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right_ += row * (sample.seen - sample.reference);
    structure_ += gu * gu + gv * gv;
    ++samples_;
  }

  [[nodiscard]] PictureShift solve() const {
    // A picture without edges (mean square slope below a level in 4 px) tells no shift.
    if (samples_ == 0 || structure_ / samples_ < 0.06) {
      return {};
    }
    const Normal full = normal_.selfadjointView<Eigen::Lower>();
    const Eigen::LDLT<Normal> solver(full);
    if (solver.info() != Eigen::Success || !solver.isPositive()) {
      return {};
    }
    const Row shift = solver.solve(right_);
    PictureShift result{true, shift(0), shift(1), 0.0};
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const double du = shift(0) + shift(2) * x + shift(3) * y;
        const double dv = shift(1) + shift(4) * x + shift(5) * y;
        result.largest_px = std::max(result.largest_px, std::hypot(du, dv));
      }
    }
    return result;
  }

 private:
  double half_width_;
  double half_height_;
  Normal normal_ = Normal::Zero();
  Row right_ = Row::Zero();
  double structure_ = 0.0;
  double samples_ = 0.0;
};

}  // namespace

PictureShift shift_between_frames(const PictureAverage& average, const FieldView& field) {
  ShiftFit fit(average.width_px(), average.height_px());
  const double scale = 1.0 / average.count(field.first_line);
  for (std::int32_t l = 1; l + 1 < field.lines; ++l) {
    const std::int32_t v = field.first_line + l * field.line_step;
    const std::uint16_t* const above = average.sum_line(v - field.line_step);
    const std::uint16_t* const here = average.sum_line(v);
    const std::uint16_t* const below = average.sum_line(v + field.line_step);
    const std::uint8_t* const seen =
        field.pixels + static_cast<std::ptrdiff_t>(l) * field.stride_px;
    for (std::int32_t u = kMargin_px; u + kMargin_px < field.width_px; u += kColumnStep) {
      fit.add(
          u, v,
          {scale * here[u], static_cast<double>(seen[u]), scale * (here[u + 1] - here[u - 1]) / 2.0,
           scale * (below[u] - above[u]) / (2.0 * field.line_step)});
    }
  }
  return fit.solve();
}

PictureShift shift_between_fields(const PictureAverage& average) {
  ShiftFit fit(average.width_px(), average.height_px());
  const double even = 1.0 / average.count(0);
  const double odd = 1.0 / average.count(1);
  for (std::int32_t v = 1; v + 1 < average.height_px(); v += 2) {
    const std::uint16_t* const above = average.sum_line(v - 1);
    const std::uint16_t* const seen = average.sum_line(v);
    const std::uint16_t* const below = average.sum_line(v + 1);
    for (std::int32_t u = kMargin_px; u + kMargin_px < average.width_px(); u += kColumnStep) {
      const auto between = [&](std::int32_t column) {
        return (above[column] + below[column]) / 2.0;
      };
      fit.add(u, v,
              {even * between(u), odd * seen[u], even * (between(u + 1) - between(u - 1)) / 2.0,
               even * (below[u] - above[u]) / 2.0});
    }
  }
  return fit.solve();
}

}  // namespace tubesight::core::picture
