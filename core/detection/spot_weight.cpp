#include "core/detection/spot_weight.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tubesight::core::detection {
namespace {

/// The pixels that belong to a spot, and how they are weighed.
struct Window {
  std::int32_t left = 0;
  std::int32_t top = 0;
  std::int32_t right = 0;
  std::int32_t bottom = 0;
  Eigen::Vector2d center_px;
  Eigen::Matrix2d inverse;  ///< of the spot's shape
  double reach2 = 0.0;      ///< the pixels are within, in squared half axes

  /// Calls `use` with each pixel and its squared distance in half axes.
  template <typename Use>
  void walk(const picture::AveragedPicture& picture, Use use) const {
    for (std::int32_t v = top; v <= bottom; ++v) {
      for (std::int32_t u = left; u <= right; ++u) {
        const Eigen::Vector2d off = Eigen::Vector2d(u, v) - center_px;
        const double distance2 = off.dot(inverse * off);
        if (distance2 <= reach2) {
          use(off, picture.at(u, v), distance2);
        }
      }
    }
  }
};

// The inside whose mean is the spot's level, in half axes, where the spot is large enough to have
// one.
constexpr double kInner = 0.6;
constexpr double kLeastPlain_px = 5.0;

// What is nearer to the level around than this share is noise. Of a large spot what is as near to
// its own level is inside, however the light goes across it; a small one's pixels are all edge.
constexpr double kFloor = 0.1;

}  // namespace

double weigh_spot(const picture::AveragedPicture& picture, double room_px, Ellipse& ellipse) {
  const double half = half_axes(ellipse).y();
  // Half the way to the next spot, but no more than the blur takes.
  const double reach = 1.0 + std::min(0.5 * room_px, 3.0) / half;
  const double wide = reach * std::sqrt(ellipse.shape_px2(0, 0));
  const double high = reach * std::sqrt(ellipse.shape_px2(1, 1));
  Window window;
  window.left = static_cast<std::int32_t>(std::floor(ellipse.center_px.x() - wide));
  window.right = static_cast<std::int32_t>(std::ceil(ellipse.center_px.x() + wide));
  window.top = static_cast<std::int32_t>(std::floor(ellipse.center_px.y() - high));
  window.bottom = static_cast<std::int32_t>(std::ceil(ellipse.center_px.y() + high));
  if (window.left < 0 || window.top < 0 || window.right >= picture.width_px ||
      window.bottom >= picture.height_px) {
    return -1.0;
  }
  window.center_px = ellipse.center_px;
  window.inverse = ellipse.shape_px2.inverse();
  window.reach2 = reach * reach;
  double darkest = std::numeric_limits<double>::max();
  double inside = 0.0;
  double inner = 0.0;
  double bright = 0.0;
  double count = 0.0;
  const double outer = 0.5 * (1.0 + reach);
  window.walk(picture, [&](const Eigen::Vector2d&, std::int32_t grey, double distance2) {
    darkest = std::min<double>(darkest, grey);
    if (distance2 < kInner * kInner) {
      inside += grey;
      inner += 1.0;
    }
    if (distance2 > outer * outer) {
      bright += grey;
      count += 1.0;
    }
  });
  bright = count > 0.0 ? bright / count : 0.0;
  const double dark = half > kLeastPlain_px ? inside / inner : darkest;
  if (!(bright - dark > picture::kGreyScale)) {
    return 0.0;
  }
  const double top = half > kLeastPlain_px ? kFloor : 0.0;
  double sum = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  window.walk(picture, [&](const Eigen::Vector2d& off, std::int32_t grey, double) {
    const double share = (bright - grey) / (bright - dark);
    const double weight = std::clamp((share - kFloor) / (1.0 - kFloor - top), 0.0, 1.0);
    sum += weight;
    mean += weight * off;
    square += weight * off * off.transpose();
  });
  mean /= sum;
  const Eigen::Matrix2d shape = 4.0 * (square / sum - mean * mean.transpose());
  if (!(mean.norm() < half) || !(shape.determinant() > 0.0)) {
    return 0.0;
  }
  ellipse.center_px += mean;
  ellipse.shape_px2 = shape;
  return (bright - dark) / picture::kGreyScale;
}

}  // namespace tubesight::core::detection
