#include "core/camera/camera_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "core/base/instantiate.h"

namespace tubesight::core::camera {
namespace {

// How far the picture's farthest corner is from the axis, at unit distance and distorted.
double farthest_corner(const CameraSettings& settings, double scale_u, double scale_v) {
  const auto reach = [](double center, std::int32_t size) {
    return std::max(std::abs(center), std::abs(static_cast<double>(size - 1) - center));
  };
  const double x = reach(settings.center_px[0], settings.width_px) / scale_u;
  const double y = reach(settings.center_px[1], settings.height_px) / scale_v;
  return std::sqrt(x * x + y * y);
}

// The smallest exponent whose unit makes a patch's coefficients fit a Ratio wherever it is taken,
// by the polynomial's derivatives at 33 places. At most the one that makes t the unit: it always
// fits.
std::int32_t patch_exponent(const RadialInverse& inverse) {
  constexpr int kOrders = 4;
  std::array<double, kOrders> largest{};
  constexpr int kPlaces = 16;
  for (int place = -kPlaces; place <= kPlaces; ++place) {
    auto taylor = inverse.coefficients;
    const double t = static_cast<double>(place) / kPlaces;
    for (std::size_t order = 0; order < kOrders; ++order) {
      for (std::size_t power = taylor.size() - 1; power-- > order;) {
        taylor[power] += taylor[power + 1] * t;
      }
      largest[order] = std::max(largest[order], std::abs(taylor[order]));
    }
  }
  constexpr double kMost = 3.9;  // under the 4 of a Ratio
  std::int32_t exponent = 0;
  for (double scale = inverse.scale; scale >= 2.0; scale /= 2.0, ++exponent) {
    if (largest[1] * scale < kMost && largest[2] * scale * scale < kMost &&
        largest[3] * scale * scale * scale < kMost) {
      break;
    }
  }
  return exponent;
}

template <Scalar S>
typename CameraModel<S>::Inverse in_format(const RadialInverse& inverse) {
  typename CameraModel<S>::Inverse result;
  result.middle = Ratio<S>(inverse.middle);
  result.scale = Px<S>(inverse.scale);
  result.reach2 = Ratio<S>(inverse.reach2);
  result.domain2 = Ratio<S>(inverse.domain2);
  for (std::size_t i = 0; i < inverse.coefficients.size(); ++i) {
    result.coefficients[i] = Ratio<S>(inverse.coefficients[i]);
  }
  result.newton_steps = inverse.newton_steps;
  result.patch_exponent = std::floating_point<S> ? 0 : patch_exponent(inverse);
  return result;
}

}  // namespace

template <Scalar S>
Result<CameraModel<S>> make_camera_model(const CameraSettings& settings) {
  // Comparisons written so that a NaN is refused too.
  if (!(settings.cell_width_mm > 0.0) || !(settings.cell_height_mm > 0.0) ||
      !(settings.horizontal_scale > 0.0) || settings.sensor_columns <= 0 ||
      settings.frame_columns <= 0) {
    return Unexpected(Error::kOutOfRange);
  }
  const double cell_mm = settings.cell_width_mm / settings.horizontal_scale *
                         static_cast<double>(settings.sensor_columns) /
                         static_cast<double>(settings.frame_columns);
  const double efl = settings.focal_length_mm;
  const double scale_u = efl / cell_mm;
  const double scale_v = efl / settings.cell_height_mm;
  const double k = settings.distortion_per_mm2 * efl * efl;
  const double k2 = settings.distortion2_per_mm4 * efl * efl * efl * efl;
  const bool scales_fit =
      scale_u >= 32.0 && scale_u <= 16000.0 && scale_v >= 32.0 && scale_v <= 16000.0;
  const bool center_fits =
      std::abs(settings.center_px[0]) <= 8192.0 && std::abs(settings.center_px[1]) <= 8192.0;
  const bool distortion_fits = k > -2.0 && k < 2.0 && k2 > -2.0 && k2 < 2.0;
  if (!scales_fit || !center_fits || !distortion_fits) {
    return Unexpected(Error::kOutOfRange);
  }
  const double pixels = std::max(scale_u, scale_v);
  // A tenth of the stated error is left to the method, the rest to the arithmetic's rounding.
  const double tolerance_px = std::same_as<S, double> ? 1e-10 : 2e-6;
  const Result<RadialInverse> inverse = fit_radial_inverse(
      {k, k2}, farthest_corner(settings, scale_u, scale_v), pixels, tolerance_px / pixels);
  if (!inverse) {
    return Unexpected(inverse.error());
  }
  typename CameraModel<S>::Parameters parameters;
  parameters.center_px = {Px<S>(settings.center_px[0]), Px<S>(settings.center_px[1])};
  parameters.scale_px = {Px<S>(scale_u), Px<S>(scale_v)};
  parameters.distortion = Ratio<S>(k);
  parameters.distortion2 = Ratio<S>(k2);
  parameters.inverse = in_format<S>(*inverse);
  return CameraModel<S>(parameters);
}

template <Scalar S>
VirtualPlane<S> make_virtual_plane(const Transform<frames::Camera, frames::Tool>& T_camera_tool) {
  const Eigen::Matrix3d& R = T_camera_tool.rotation();
  const auto axis = [&R](int column) {
    return Vector3<Unit<S>>{Unit<S>(R(0, column)), Unit<S>(R(1, column)), Unit<S>(R(2, column))};
  };
  return VirtualPlane<S>(axis(0), axis(1), axis(2));
}

#define TUBESIGHT_INSTANTIATE(S)                                               \
  template Result<CameraModel<S>> make_camera_model<S>(const CameraSettings&); \
  template VirtualPlane<S> make_virtual_plane<S>(const Transform<frames::Camera, frames::Tool>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::camera
