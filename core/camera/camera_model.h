#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/camera/radial_inverse_setup.h"

namespace tubesight::core::camera {

/// The camera between full-frame pixels and the ideal image plane, both ways [Fallon eq. 4.5-4.9].
///
/// Image-plane points are given at unit distance, (x_c / EFL, y_c / EFL): times EFL they are the
/// source's x_c, y_c in millimetres. The mapping goes distorted -> ideal; its inverse is solved.
///
/// Domain: pixels within the frame and a quarter of its radius around it; image-plane points up to
/// 1.8 from the axis (60 degrees), less where make_camera_model() says so.
///
/// Worst errors against exact arithmetic, to_pixel and to_plane (times the scale) alike, over a 635
/// by 480 and a 4096 by 3000 picture with |k EFL^2| < 0.5 (pin-cushion: until the slope of the
/// mapping is down to 1/4): double 1e-9 px; float 2e-4 px and 1e-3 px; fixed point 3e-5 px, twice
/// the step of its pixels. to_pixel costs some 370 instructions in fixed point.
template <Scalar S>
class CameraModel {
 public:
  CameraModel() = default;

  /// Where Newton's method starts and ends; see radial_inverse_setup.h.
  struct Inverse {
    Ratio<S> middle{};
    Px<S> scale{};
    Ratio<S> reach2{};
    Ratio<S> domain2{};
    std::array<Ratio<S>, kRadialCoefficients> coefficients{};
    std::int32_t newton_steps = 0;
    std::int32_t patch_exponent = 0;  ///< see Patch; 0 but for narrow views of strong distortion
  };

  /// Parameters as the tracking path uses them; see make_camera_model() in camera_setup.h.
  struct Parameters {
    Vector2<Px<S>> center_px;  ///< (c_u, c_v)
    Vector2<Px<S>> scale_px;   ///< pixels per unit of the plane at unit distance
    Ratio<S> distortion{};     ///< k EFL^2
    Ratio<S> distortion2{};    ///< k2 EFL^4
    Inverse inverse;
  };
  explicit CameraModel(const Parameters& parameters) : parameters_(parameters) {}

  /// Full-frame pixel to image plane: closed form [Fallon eq. 4.5-4.9].
  [[nodiscard]] Vector2<Ratio<S>> to_plane(const Vector2<Px<S>>& pixel) const;

  /// Image plane to full-frame pixel: a polynomial start, then a fixed number of Newton's steps
  /// (one within the picture for the source's camera). Empty outside the domain.
  [[nodiscard]] std::optional<Vector2<Px<S>>> to_pixel(const Vector2<Ratio<S>>& point) const;

  /// The inverse around one point: the radial factor as a cubic of the squared radius, in units of
  /// 2^-exponent. The radii of a narrow view are small, and how the factor changes by them is
  /// large: in that unit both fit a Ratio.
  struct Patch {
    Ratio<S> radius2{};
    std::int32_t exponent = 0;
    std::array<Ratio<S>, 4> coefficients{};
  };

  /// The patch around an image-plane point; empty outside the domain. For points up to 0.15 from it
  /// the patch is right to 0.01 px with the source's distortion; at the point it is to_pixel()'s.
  [[nodiscard]] std::optional<Patch> patch_at(const Vector2<Ratio<S>>& point) const;

  /// Image plane to full-frame pixel by the patch: a third of to_pixel()'s cost.
  [[nodiscard]] Vector2<Px<S>> to_pixel(const Vector2<Ratio<S>>& point, const Patch& patch) const {
    Ratio<S> off =
        narrow<Ratio<S>>(product(point.x, point.x) + product(point.y, point.y)) - patch.radius2;
    if (patch.exponent != 0) {
      off = in_units(off, patch.exponent);
    }
    Ratio<S> m = patch.coefficients[3];
    for (std::size_t power = 3; power-- > 0;) {
      m = times(m, off) + patch.coefficients[power];
    }
    return {parameters_.center_px.x + times(parameters_.scale_px.x, times(point.x, m)),
            parameters_.center_px.y + times(parameters_.scale_px.y, times(point.y, m))};
  }

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

 private:
  /// value * 2^exponent, held at 2, which is as far as a picture reaches.
  [[nodiscard]] static Ratio<S> in_units(Ratio<S> value, std::int32_t exponent) {
    const Ratio<S> most = from_scaled<Ratio<S>>(2, exponent);
    const Ratio<S> held = value > most ? most : (value < -most ? -most : value);
    return narrow<Ratio<S>>(product(from_scaled<Mm<S>>(std::int64_t{1} << exponent, 0), held));
  }

  /// Distorted over ideal radius, by the square of the ideal one.
  [[nodiscard]] std::optional<Ratio<S>> radial_factor(Ratio<S> radius2) const;

  Parameters parameters_{};
};

}  // namespace tubesight::core::camera
