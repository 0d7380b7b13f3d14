#include "core/tracking/rim_outline.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// cos(2 pi k / kRimPoints), k = 0 .. kRimPoints - 1, in 1/2^30; a sine is a cosine a quarter
// earlier.
constexpr auto kCosineQ30 = [] {
  std::array<std::int64_t, kRimPoints> table{};
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double angle =
        2.0 * 3.14159265358979323846 * static_cast<double>(k) / kRimPoints - 3.14159265358979323846;
    double sum = 1.0;  // cos(x) = 1 - x^2/2 (1 - x^2/12 (...)), |x| <= pi
    for (int n = 29; n >= 1; n -= 2) {
      sum = 1.0 - angle * angle / static_cast<double>(n * (n + 1)) * sum;
    }
    const double scaled = -sum * 1073741824.0;
    table[k] = static_cast<std::int64_t>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
  }
  return table;
}();
static_assert(kCosineQ30[0] == 1073741824 && kCosineQ30[kRimPoints / 4] == 0 &&
              kCosineQ30[kRimPoints / 2] == -1073741824);

// From a chord over two steps h = 2 pi / kRimPoints to the tangent: on an ellipse
// p(t) = c + a cos t + b sin t it is p(t + h) - p(t - h) = 2 sin(h) p'(t). 1 / (2 sin h) in 1/2^16.
constexpr std::int64_t kTangentQ16 = (std::int64_t{1} << 45) / kCosineQ30[kRimPoints / 4 - 1];

}  // namespace

// r (cos t x_axis + sin t y_axis) at t = 2 pi k / kRimPoints.
template <Scalar S>
RimSpokes<S> make_rim_spokes(const SheetPose<S>& pose, Mm<S> radius_mm) {
  RimSpokes<S> spokes;
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const std::size_t earlier = (k + kRimPoints - kRimPoints / 4) % kRimPoints;
    spokes[k] = pose.along({times(radius_mm, from_scaled<Unit<S>>(kCosineQ30[k], 30)),
                            times(radius_mm, from_scaled<Unit<S>>(kCosineQ30[earlier], 30))});
  }
  return spokes;
}

template <Scalar S>
Vector2<Px<S>> RimOutline<S>::tangent(int index) const {
  const auto before = static_cast<std::size_t>(index == 0 ? kRimPoints - 1 : index - 1);
  const auto after = static_cast<std::size_t>(index == kRimPoints - 1 ? 0 : index + 1);
  const Vector2<Px<S>> chord = points[after] - points[before];
  const Px<S> scale = from_scaled<Px<S>>(kTangentQ16, 16);
  return {times(chord.x, scale), times(chord.y, scale)};
}

template <Scalar S>
std::optional<RimOutline<S>> project_rim(const TrackingModel<S>& model,
                                         const Vector3<Mm<S>>& center, const RimSpokes<S>& spokes) {
  using P = Px<S>;
  const auto middle = to_plane<S>(center);
  if (!middle) {
    return std::nullopt;
  }
  const auto patch = model.camera.patch_at(*middle);
  if (!patch) {
    return std::nullopt;
  }
  RimOutline<S> rim;
  rim.center = model.camera.to_pixel(*middle, *patch);
  Vector2<P> least{};
  Vector2<P> most{};
  Vector2<P> sum{};
  const auto border = [](std::int32_t px) { return from_scaled<P>(px, 0); };
  constexpr std::int32_t kSlackPx = 2;
  const Vector2<P> low{border(model.window.left - kSlackPx), border(model.window.top - kSlackPx)};
  const Vector2<P> high{border(model.window.right + kSlackPx),
                        border(model.window.bottom + kSlackPx)};
  // Far apart points first: a rim that leaves the window is given up early.
  for (std::size_t i = 0, k = 0; i < spokes.size(); ++i, k = (k + 5) % kRimPoints) {
    const auto plane = to_plane<S>(center + spokes[k]);
    if (!plane) {
      return std::nullopt;
    }
    const Vector2<P> pixel = model.camera.to_pixel(*plane, *patch);
    if (pixel.x < low.x || pixel.y < low.y || pixel.x > high.x || pixel.y > high.y) {
      return std::nullopt;
    }
    rim.points[k] = pixel;
    least = k == 0 ? pixel : Vector2<P>{std::min(least.x, pixel.x), std::min(least.y, pixel.y)};
    most = k == 0 ? pixel : Vector2<P>{std::max(most.x, pixel.x), std::max(most.y, pixel.y)};
    sum = sum + pixel;
  }
  const Unit<S> share =
      from_scaled<Unit<S>>(((std::int64_t{1} << 30) + kRimPoints / 2) / kRimPoints, 30);
  rim.middle = {times(sum.x, share), times(sum.y, share)};
  const P half = constant<P>(0.5);
  rim.half_extent = {times(most.x - least.x, half), times(most.y - least.y, half)};
  return rim;
}

#define TUBESIGHT_INSTANTIATE(S)                                        \
  template struct RimOutline<S>;                                        \
  template RimSpokes<S> make_rim_spokes<S>(const SheetPose<S>&, Mm<S>); \
  template std::optional<RimOutline<S>> project_rim<S>(                 \
      const TrackingModel<S>&, const Vector3<Mm<S>>&, const RimSpokes<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
