#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"

namespace tubesight::core::camera {

/// The radial distortion of a camera at unit distance: R = r (1 + k r^2 + k2 r^4), r distorted.
struct RadialDistortion {
  double k = 0.0;
  double k2 = 0.0;
};

/// Coefficients of the start polynomial: degree 8 leaves nothing to do for Newton's method in fixed
/// point and one step in double, for the
/// source's camera.
inline constexpr std::int32_t kRadialCoefficients = 7;

/// How the distortion is undone: m = r / R as a polynomial over the picture, then Newton's method.
struct RadialInverse {
  double middle = 0.0;   ///< t = (R^2 - middle) * scale runs over -1..1; steps of 2^-20
  double scale = 1.0;    ///< 0.5..16000 in steps of 1/256
  double reach2 = 0.0;   ///< the polynomial holds up to this R^2
  double domain2 = 0.0;  ///< Newton's method with more steps holds up to this R^2
  std::array<double, kRadialCoefficients> coefficients{};  ///< of t^0, t^1, ...
  std::int32_t newton_steps = 0;
};

/// Fits the inverse for a picture whose farthest corner is `corner` from the axis (distorted, at
/// unit distance), with a quarter of that around it; the radius is right within `tolerance`.
///
/// kOutOfRange: the corner looks over 60 degrees off the axis, or the picture folds over before it,
/// or |k| R^2 + |k2| R^4 exceeds 2 there. `pixels` per unit of the plane limit the domain so that
/// 16,000 px are not exceeded. Arithmetic of + - x / and square root: the same on every machine.
[[nodiscard]] Result<RadialInverse> fit_radial_inverse(const RadialDistortion& distortion,
                                                       double corner, double pixels,
                                                       double tolerance);

}  // namespace tubesight::core::camera
