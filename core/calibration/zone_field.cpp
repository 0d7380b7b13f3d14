#include "core/calibration/zone_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/assert.h"

namespace tubesight::core::calibration {
namespace {

constexpr std::array kShapes = {ZoneShape::kMatern, ZoneShape::kExponential, ZoneShape::kGaussian};
constexpr std::array kLengths_mm = {75.0, 150.0, 300.0, 600.0, 1200.0, 2400.0};
constexpr std::array kSizes_mm = {0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2};
// What is expected before any point: half a millimetre over a third of a generator, either known
// to a factor of three. Two or three points alone choose nothing else.
constexpr double kExpectedLength_mm = 500.0;
constexpr double kExpectedSize_mm = 0.5;
constexpr double kFactor = 3.0;

double log_prior(double value, double expected) {
  const double off = std::log(value / expected) / std::log(kFactor);
  return -0.5 * off * off;
}

}  // namespace

double ZoneField::correlation(double distance_mm) const {
  switch (shape_) {
    case ZoneShape::kExponential: return std::exp(-distance_mm / length_mm_);
    case ZoneShape::kMatern: {
      const double d = std::sqrt(3.0) * distance_mm / length_mm_;
      return (1.0 + d) * std::exp(-d);
    }
    case ZoneShape::kGaussian: {
      const double d = distance_mm / length_mm_;
      return std::exp(-0.5 * d * d);
    }
  }
  return 0.0;
}

/// Factors K = size^2 correlation + sigma^2 of one kind.
bool ZoneField::factor(std::size_t axis) {
  const std::int32_t count = points_.size();
  const double variance = size_mm_[axis] * size_mm_[axis];
  for (std::int32_t i = 0; i < count; ++i) {
    double* const row = &factor_[static_cast<std::size_t>(i) * kMost];
    for (std::int32_t k = 0; k <= i; ++k) {
      const double* const other = &factor_[static_cast<std::size_t>(k) * kMost];
      double sum = variance * correlation((points_[i].at_mm - points_[k].at_mm).norm());
      if (i == k) {
        sum += points_[i].sigma_mm * points_[i].sigma_mm;
      }
      for (std::int32_t m = 0; m < k; ++m) {
        sum -= row[m] * other[m];
      }
      if (i != k) {
        row[k] = sum / other[k];
      } else if (!(sum > 0.0)) {
        return false;
      } else {
        row[k] = std::sqrt(sum);
      }
    }
  }
  return true;
}

void ZoneField::forward(double* values) const {
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    const double* const row = &factor_[static_cast<std::size_t>(i) * kMost];
    for (std::int32_t k = 0; k < i; ++k) {
      values[i] -= row[k] * values[k];
    }
    values[i] /= row[i];
  }
}

void ZoneField::substitute(double* values) const {
  forward(values);
  for (std::int32_t i = points_.size() - 1; i >= 0; --i) {
    for (std::int32_t k = i + 1; k < points_.size(); ++k) {
      values[i] -=
          factor_[static_cast<std::size_t>(k) * kMost + static_cast<std::size_t>(i)] * values[k];
    }
    values[i] /= factor_[static_cast<std::size_t>(i) * kMost + static_cast<std::size_t>(i)];
  }
}

/// log p(seen | shape, length, size) of x and y, or of z, but for a constant.
double ZoneField::likelihood(std::size_t axis) {
  if (!factor(axis)) {
    return -std::numeric_limits<double>::infinity();
  }
  double half_log_determinant = 0.0;
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    half_log_determinant +=
        std::log(factor_[static_cast<std::size_t>(i) * kMost + static_cast<std::size_t>(i)]);
  }
  double sum = 0.0;
  const int first = axis == 0 ? 0 : 2;
  const int last = axis == 0 ? 1 : 2;
  for (int component = first; component <= last; ++component) {
    std::array<double, kMost>& seen = weights_[static_cast<std::size_t>(component)];
    for (std::int32_t i = 0; i < points_.size(); ++i) {
      seen[static_cast<std::size_t>(i)] = points_[i].off_mm(component);
    }
    forward(seen.data());
    for (std::int32_t i = 0; i < points_.size(); ++i) {
      sum -= 0.5 * seen[static_cast<std::size_t>(i)] * seen[static_cast<std::size_t>(i)];
    }
    sum -= half_log_determinant;
  }
  return sum + log_prior(size_mm_[axis], kExpectedSize_mm);
}

void ZoneField::choose(const ZonePoints& points) {
  TUBESIGHT_ASSERT(!points.empty());
  points_ = points;
  double best = -std::numeric_limits<double>::infinity();
  ZoneShape best_shape = ZoneShape::kMatern;
  double best_length = kExpectedLength_mm;
  std::array<double, 2> best_sizes = {kExpectedSize_mm, kExpectedSize_mm};
  for (const ZoneShape shape : kShapes) {
    shape_ = shape;
    for (const double length : kLengths_mm) {
      length_mm_ = length;
      double sum = log_prior(length, kExpectedLength_mm);
      std::array<double, 2> sizes{};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        double most = -std::numeric_limits<double>::infinity();
        for (const double size : kSizes_mm) {
          size_mm_[axis] = size;
          if (const double here = likelihood(axis); here > most) {
            most = here;
            sizes[axis] = size;
          }
        }
        sum += most;
      }
      if (sum > best) {
        best = sum;
        best_shape = shape;
        best_length = length;
        best_sizes = sizes;
      }
    }
  }
  shape_ = best_shape;
  length_mm_ = best_length;
  size_mm_ = best_sizes;
  solve_for(1);
  solve_for(0);  // last, so that its factor stays for at()
}

void ZoneField::solve_for(std::size_t axis) {
  const bool factored = factor(axis);
  TUBESIGHT_ASSERT(factored);  // it was, when its likelihood was computed
  for (int component = axis == 0 ? 0 : 2; component <= (axis == 0 ? 1 : 2); ++component) {
    std::array<double, kMost>& weights = weights_[static_cast<std::size_t>(component)];
    for (std::int32_t i = 0; i < points_.size(); ++i) {
      weights[static_cast<std::size_t>(i)] = points_[i].off_mm(component);
    }
    substitute(weights.data());
  }
  std::array<double, kMost> column{};
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    column.fill(0.0);
    column[static_cast<std::size_t>(i)] = 1.0;
    forward(column.data());
    double sum = 0.0;
    for (std::int32_t k = i; k < points_.size(); ++k) {
      sum += column[static_cast<std::size_t>(k)] * column[static_cast<std::size_t>(k)];
    }
    precision_[axis][static_cast<std::size_t>(i)] = sum;
  }
}

ZoneCorrection ZoneField::at(const Eigen::Vector2d& place_mm) const {
  ZoneCorrection result;
  std::array<double, kMost> towards{};
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    towards[at] = correlation((points_[i].at_mm - place_mm).norm());
    for (int component = 0; component < 3; ++component) {
      const double size = size_mm_[component < 2 ? 0 : 1];
      result.off_mm(component) +=
          size * size * towards[at] * weights_[static_cast<std::size_t>(component)][at];
    }
  }
  const double variance = size_mm_[0] * size_mm_[0];
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    towards[static_cast<std::size_t>(i)] *= variance;
  }
  forward(towards.data());
  double known = 0.0;
  for (std::int32_t i = 0; i < points_.size(); ++i) {
    known += towards[static_cast<std::size_t>(i)] * towards[static_cast<std::size_t>(i)];
  }
  // Along the tube the same share of its size stays open: the points' sigmas are small beside it.
  const double open = std::max(0.0, 1.0 - known / variance);
  result.across_mm = size_mm_[0] * std::sqrt(open);
  result.along_mm = size_mm_[1] * std::sqrt(open);
  return result;
}

double ZoneField::contradiction(std::int32_t i) const {
  // Left out, point i is predicted K^-1 y / K^-1_ii beside itself, with variance 1 / K^-1_ii
  // [Rasmussen2006 eq. 5.12].
  const auto at = static_cast<std::size_t>(i);
  double sum = 0.0;
  for (std::size_t component = 0; component < 3; ++component) {
    const double weight = weights_[component][at];
    sum += weight * weight / precision_[component < 2 ? 0 : 1][at];
  }
  return sum;
}

double ZoneField::contradiction(const ZonePoint& point) const {
  const ZoneCorrection here = at(point.at_mm);
  const double own = point.sigma_mm * point.sigma_mm;
  const Eigen::Vector3d miss = point.off_mm - here.off_mm;
  return miss.head<2>().squaredNorm() / (here.across_mm * here.across_mm + own) +
         miss.z() * miss.z() / (here.along_mm * here.along_mm + own);
}

}  // namespace tubesight::core::calibration
