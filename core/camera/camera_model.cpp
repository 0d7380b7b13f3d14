#include "core/camera/camera_model.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"

namespace tubesight::core::camera {

template <Scalar S>
Vector2<Ratio<S>> CameraModel<S>::to_plane(const Vector2<Px<S>>& pixel) const {
  using R = Ratio<S>;
  const R x = quotient<R>(pixel.x - parameters_.center_px.x, parameters_.scale_px.x);
  const R y = quotient<R>(pixel.y - parameters_.center_px.y, parameters_.scale_px.y);
  const R radius2 = narrow<R>(product(x, x) + product(y, y));
  const R inner = parameters_.distortion + times(parameters_.distortion2, radius2);
  const R factor = R(1) + times(inner, radius2);
  return {times(x, factor), times(y, factor)};
}

template <Scalar S>
std::optional<Ratio<S>> CameraModel<S>::radial_factor(Ratio<S> radius2) const {
  using R = Ratio<S>;
  const Inverse& inverse = parameters_.inverse;
  const bool far = inverse.reach2 < radius2;
  // From the polynomial's end, Newton's method runs to any farther point without overshooting.
  constexpr std::int32_t kFarSteps = 8;
  const std::int32_t steps = far ? kFarSteps : inverse.newton_steps;
  const R t = times((far ? inverse.reach2 : radius2) - inverse.middle, inverse.scale);
  R m = inverse.coefficients.back();
  for (std::size_t power = inverse.coefficients.size() - 1; power-- > 0;) {
    m = narrow<R>(product(m, t) + product(inverse.coefficients[power], R(1)));
  }
  const bool has_second = parameters_.distortion2 != R{};
  // R m = r and r (1 + k r^2 + k2 r^4) = R, divided by R.
  for (std::int32_t step = 0; step < steps; ++step) {
    const R distorted2 = times(radius2, times(m, m));
    const R k = times(parameters_.distortion, distorted2);
    const R k2 = has_second ? times(times(parameters_.distortion2, distorted2), distorted2) : R{};
    const R value = narrow<R>(product(m, R(1) + k + k2) - product(R(1), R(1)));
    // 1 + 3 k + 5 k2 may leave the range of a Ratio, and needs no more than 20 bits.
    const Mm<S> slope =
        narrow<Mm<S>>(product(Mm<S>(1), R(1)) + product(Mm<S>(3), k) + product(Mm<S>(5), k2));
    if (slope < constant<Mm<S>>(1.0 / 32.0) || slope + slope < convert<Mm<S>>(absolute(value))) {
      return std::nullopt;  // the picture folds over here
    }
    m = m - quotient<R>(value, slope);
    if (constant<R>(1.75) < m || m < R(0)) {
      return std::nullopt;
    }
  }
  return m;
}

template <Scalar S>
std::optional<Vector2<Px<S>>> CameraModel<S>::to_pixel(const Vector2<Ratio<S>>& point) const {
  using R = Ratio<S>;
  // Points far off are turned away before their square leaves the format of fixed point.
  if (absolute(point.x) > R(2) || absolute(point.y) > R(2)) {
    return std::nullopt;
  }
  const auto wide2 = product(point.x, point.x) + product(point.y, point.y);
  if (product(parameters_.inverse.domain2, R(1)) < wide2) {
    return std::nullopt;
  }
  const std::optional<R> m = radial_factor(narrow<R>(wide2));
  if (!m) {
    return std::nullopt;
  }
  const Px<S> u = times(parameters_.scale_px.x, times(point.x, *m));
  const Px<S> v = times(parameters_.scale_px.y, times(point.y, *m));
  return Vector2<Px<S>>{parameters_.center_px.x + u, parameters_.center_px.y + v};
}

template <Scalar S>
std::optional<typename CameraModel<S>::Patch> CameraModel<S>::patch_at(
    const Vector2<Ratio<S>>& point) const {
  using R = Ratio<S>;
  if (absolute(point.x) > R(2) || absolute(point.y) > R(2)) {
    return std::nullopt;
  }
  const auto wide2 = product(point.x, point.x) + product(point.y, point.y);
  if (product(parameters_.inverse.domain2, R(1)) < wide2) {
    return std::nullopt;
  }
  Patch patch;
  patch.radius2 = narrow<R>(wide2);
  const std::optional<R> exact = radial_factor(patch.radius2);
  if (!exact) {
    return std::nullopt;
  }
  const Inverse& inverse = parameters_.inverse;
  const R radius2 = inverse.reach2 < patch.radius2 ? inverse.reach2 : patch.radius2;
  const R t = times(radius2 - inverse.middle, inverse.scale);
  // Horner's scheme carried on: the polynomial's Taylor coefficients at t.
  std::array<R, kRadialCoefficients> taylor = inverse.coefficients;
  for (std::size_t order = 0; order < 4; ++order) {
    for (std::size_t power = taylor.size() - 1; power-- > order;) {
      taylor[power] = taylor[power] + times(taylor[power + 1], t);
    }
  }
  patch.exponent = inverse.patch_exponent;
  const Px<S> scale = times(inverse.scale, from_scaled<R>(1, inverse.patch_exponent));
  patch.coefficients[0] = *exact;
  for (std::size_t order = 1; order < 4; ++order) {
    R coefficient = taylor[order];
    for (std::size_t i = 0; i < order; ++i) {
      coefficient = times(coefficient, scale);
    }
    patch.coefficients[order] = coefficient;
  }
  return patch;
}

TUBESIGHT_INSTANTIATE_CLASS(CameraModel)

}  // namespace tubesight::core::camera
