#include "core/rendering/guidetube.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/edge_spread.h"

namespace tubesight::core::rendering {
namespace {

/// Grey levels times mm^2 per unit of reflectance that falls on the guidetube's side, as if it came
/// from a ring kGrazingGap_mm around its base: fitted to the ray-traced recordings.
constexpr double kGrazingLight = 4.2e5;
constexpr double kGrazingGap_mm = 37.0;

}  // namespace

Guidetube::Side Guidetube::side_of(const Eigen::Vector3d& normal_tool, bool inside) const {
  // The ray (x, y, 1) turned into the tool frame and multiplied by the normal.
  std::array<double, 3> by{};
  for (Eigen::Index column = 0; column < 3; ++column) {
    for (Eigen::Index row = 0; row < 3; ++row) {
      by[static_cast<std::size_t>(column)] +=
          normal_tool(row) * static_cast<double>(to_tool_(row, column));
    }
  }
  const double sign = inside ? 1.0 : -1.0;
  return {static_cast<float>(sign * by[0]), static_cast<float>(sign * by[1]),
          static_cast<float>(sign * by[2])};
}

void Guidetube::place(const Scene& scene, const View& view, const Exposure& exposure) {
  const Transform<frames::Tool, frames::Camera> T_tool_camera = view.T_camera_tool().inverse();
  const Eigen::Vector3d& eye = T_tool_camera.translation_mm();
  const double radius = scene.guidetube.radius_mm;
  const double distance = std::hypot(eye.x(), eye.y());
  shown_ = radius > 0.0 && distance > 1.05 * radius;
  if (!shown_) {
    return;
  }
  for (Eigen::Index row = 0; row < 3; ++row) {
    eye_(row) = static_cast<float>(eye(row));
    for (Eigen::Index column = 0; column < 3; ++column) {
      to_tool_(row, column) = static_cast<float>(T_tool_camera.rotation()(row, column));
    }
  }
  radius_ = static_cast<float>(radius);
  length_ = static_cast<float>(std::max(scene.guidetube.length_mm, 1.0));
  unit_u_ = static_cast<float>(view.projection().unit_u());
  unit_v_ = static_cast<float>(view.projection().unit_v());
  per_bell_ =
      static_cast<float>(1.0 / (static_cast<double>(kBellHalfWidth) * scene.sensor.blur_px));
  // Tangents from the eye: turned by asin(radius / distance) from the way to the axis.
  const double sine = radius / distance;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double to_x = -eye.x() / distance;
  const double to_y = -eye.y() / distance;
  const double ax = to_x * cosine - to_y * sine;
  const double ay = to_y * cosine + to_x * sine;
  const double bx = to_x * cosine + to_y * sine;
  const double by = to_y * cosine - to_x * sine;
  left_ = side_of({ay, -ax, 0.0}, true);
  right_ = side_of({-by, bx, 0.0}, true);
  // Both tangent points at the tip's height span a plane with the eye.
  const double reach = distance * cosine;
  const Eigen::Vector3d first(reach * ax, reach * ay, -eye.z());
  const Eigen::Vector3d second(reach * bx, reach * by, -eye.z());
  const Eigen::Vector3d normal(first.y() * second.z() - first.z() * second.y(),
                               first.z() * second.x() - first.x() * second.z(),
                               first.x() * second.y() - first.y() * second.x());
  const double base = -normal.x() * eye.x() - normal.y() * eye.y() +
                      normal.z() * (-static_cast<double>(length_) - eye.z());
  below_ = side_of(normal, base > 0.0);
  find_lines(view, scene.camera.height_px);
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double z = -static_cast<double>(length_) * static_cast<double>(level) / (kLevels - 1);
    const double rise = z + static_cast<double>(length_);
    const double d = std::sqrt(kGrazingGap_mm * kGrazingGap_mm + rise * rise);
    levels_[level] =
        static_cast<float>(kGrazingLight * scene.guidetube.reflectance * scene.lamp.strength *
                           exposure.lamp * kGrazingGap_mm / (d * d * d));
  }
  const double d2 = eye.x() * eye.x() + eye.y() * eye.y() + eye.z() * eye.z();
  led_ = static_cast<float>(6.4e6 * scene.lamp.led_strength * exposure.ring *
                            scene.guidetube.reflectance * 0.7 / d2);
}

void Guidetube::find_lines(const View& view, std::int32_t height_px) {
  // Where the tip's rim is all in sight it bounds the lines on one side; the base is below the
  // lamps.
  double low = 1e6;
  double high = -1e6;
  for (int point = 0; point < 24; ++point) {
    const double angle = point * 0.26179938779914944;
    for (const float z : {0.0F, -length_ - 60.0F}) {
      const Eigen::Vector3d at(static_cast<double>(radius_) * std::cos(angle),
                               static_cast<double>(radius_) * std::sin(angle),
                               static_cast<double>(z));
      const auto pixel = view.projection().pixel(view.T_camera_tool() * at);
      if (pixel) {
        low = std::min(low, (*pixel)[1]);
        high = std::max(high, (*pixel)[1]);
      } else {
        // Beside or behind the camera: towards that side there is no bound.
        const Eigen::Vector3d camera = view.T_camera_tool() * at;
        low = camera.y() < 0.0 ? -1e6 : low;
        high = camera.y() >= 0.0 ? 1e6 : high;
      }
    }
  }
  const double margin = 4.0 + 0.02 * (std::min(high, 2e3) - std::max(low, -2e3));
  top_ = static_cast<std::int32_t>(std::clamp(low - margin, 0.0, 1e6));
  bottom_ =
      static_cast<std::int32_t>(std::clamp(high + margin, -1.0, static_cast<double>(height_px)));
}

float Guidetube::share(const Side& side, float ray_x, float ray_y) const {
  const float value = side.x * ray_x + side.y * ray_y + side.one;
  const float by_u = side.x * unit_u_;
  const float by_v = side.y * unit_v_;
  const float distance = value / std::sqrt(by_u * by_u + by_v * by_v + 1e-12F);
  return RestingEdge(0.0F).share(distance * per_bell_);
}

float Guidetube::tip_share(const Eigen::Vector3f& way) const {
  if (way.z() * eye_.z() >= 0.0F) {
    return 0.0F;  // never comes to the tip's height
  }
  const float along = -eye_.z() / way.z();
  const float x = eye_.x() + along * way.x();
  const float y = eye_.y() + along * way.y();
  const float radius = std::sqrt(x * x + y * y + 1e-6F);
  // Slope of the radius by the ray's direction, in camera coordinates and then by pixel.
  float by_x = 0.0F;
  float by_y = 0.0F;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const float dx = along * (to_tool_(0, axis) - way.x() / way.z() * to_tool_(2, axis));
    const float dy = along * (to_tool_(1, axis) - way.y() / way.z() * to_tool_(2, axis));
    (axis == 0 ? by_x : by_y) = (x * dx + y * dy) / radius;
  }
  const float by_u = by_x * unit_u_;
  const float by_v = by_y * unit_v_;
  const float distance = (radius_ - radius) / std::sqrt(by_u * by_u + by_v * by_v + 1e-12F);
  return RestingEdge(0.0F).share(distance * per_bell_);
}

float Guidetube::level(const Eigen::Vector3f& way) const {
  const float a = way.x() * way.x() + way.y() * way.y() + 1e-9F;
  const float b = eye_.x() * way.x() + eye_.y() * way.y();
  const float c = eye_.x() * eye_.x() + eye_.y() * eye_.y() - radius_ * radius_;
  const float root2 = b * b - a * c;
  const float root = root2 > 0.0F ? std::sqrt(root2) : 0.0F;
  const float z = eye_.z() + (-b - root) / a * way.z();
  const float place = -z / length_ * static_cast<float>(kLevels - 1);
  if (place >= static_cast<float>(kLevels - 1)) {
    return 0.0F;  // below the lamps all is dark
  }
  const float bounded = place < 0.0F ? 0.0F : place;
  const auto lower = std::min(static_cast<std::size_t>(bounded), kLevels - 2);
  const float part = bounded - static_cast<float>(lower);
  const float lamps = levels_[lower] + (levels_[lower + 1] - levels_[lower]) * part;
  // Cosine of the surface towards the camera: brightest in the middle.
  const float facing = root / (radius_ * std::sqrt(a));
  return lamps * (0.8F + 0.25F * facing) + led_ * facing;
}

void Guidetube::draw(const LightGrid& light, std::int32_t v, std::int32_t first, std::int32_t last,
                     Row& row) const {
  if (!shown_ || v < top_ || v > bottom_) {
    return;
  }
  const auto vignette =
      static_cast<float>(light.vignette(0.5 * (static_cast<double>(first) + last), v));
  // Most of a line is beside it: planes are straight along a line, so whole cells can be left out.
  const auto beside = [&row](const Side& side, std::int32_t u) {
    const auto i = static_cast<std::size_t>(u);
    return side.x * row.ray_x[i] + side.y * row.ray_y[i] + side.one < -0.02F;
  };
  for (std::int32_t u = first; u <= last; ++u) {
    constexpr std::int32_t kCell = 15;
    if (u % (kCell + 1) == 0 && u + kCell <= last &&
        ((beside(left_, u) && beside(left_, u + kCell)) ||
         (beside(right_, u) && beside(right_, u + kCell)))) {
      u += kCell;
      continue;
    }
    const auto i = static_cast<std::size_t>(u);
    const float x = row.ray_x[i];
    const float y = row.ray_y[i];
    const float sides = share(left_, x, y) * share(right_, x, y);
    if (sides <= 0.0F) {
      continue;
    }
    Eigen::Vector3f way;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      way(axis) = to_tool_(axis, 0) * x + to_tool_(axis, 1) * y + to_tool_(axis, 2);
    }
    const float under = share(below_, x, y);
    const float end = under < 1.0F ? std::max(under, tip_share(way)) : 1.0F;
    const float inside = sides * end;
    if (inside > 0.0F) {
      row.signal[i] += (level(way) * vignette - row.signal[i]) * inside;
    }
  }
}

}  // namespace tubesight::core::rendering
