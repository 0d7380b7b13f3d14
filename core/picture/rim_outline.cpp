#include "core/picture/rim_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/assert.h"

namespace tubesight::core::picture {
namespace {

constexpr std::int32_t kFewestArcs = 16;

Eigen::Vector2d on_circle(double angle_rad, double radius_mm) {
  return {radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad)};
}

/// Length of the rim's image by an octagon of its points, 3 % short at worst; below 0: no image.
double rough_length(const SheetView& view, const Eigen::Vector2d& center_mm, double radius_mm) {
  constexpr std::int32_t kCorners = 8;
  double length = 0.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (std::int32_t i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
    const auto pixel = view.to_pixel(Eigen::Vector2d(center_mm + on_circle(angle, radius_mm)));
    if (!pixel) {
      return -1.0;
    }
    length += i > 0 ? (*pixel - before).norm() : 0.0;
    before = *pixel;
  }
  return length;
}

OutlineArc make_arc(const Eigen::Vector2d& before, const Eigen::Vector2d& here,
                    const Eigen::Vector2d& after, const Eigen::Vector2d& center) {
  const Eigen::Vector2d along = (after - before).normalized();
  Eigen::Vector2d normal(along.y(), -along.x());
  if (normal.dot(here - center) < 0.0) {
    normal = -normal;
  }
  OutlineArc arc{here.x(), here.y(), normal.x(), normal.y(), (after - before).norm() / 4.0};
  // The parabola through the neighbours.
  const Eigen::Vector2d tangent(-normal.y(), normal.x());
  const auto place = [&](const Eigen::Vector2d& point) {
    return Eigen::Vector2d(tangent.dot(point - here), normal.dot(point - here));
  };
  const Eigen::Vector2d a = place(before);
  const Eigen::Vector2d b = place(after);
  const double determinant = a.x() * b.x() * (b.x() - a.x());
  if (std::abs(determinant) > 1e-12) {
    arc.slope = (a.y() * b.x() * b.x() - b.y() * a.x() * a.x()) / determinant;
    arc.bend = (b.y() * a.x() - a.y() * b.x()) / determinant;
  }
  return arc;
}

}  // namespace

bool project_rim(const SheetView& view, const Eigen::Vector2d& center_mm, double radius_mm,
                 double arc_px, RimOutline& outline) {
  outline.arcs.clear();
  const auto center = view.to_pixel(center_mm);
  const double length = rough_length(view, center_mm, radius_mm);
  if (!center || length <= 0.0) {
    return false;
  }
  const auto arcs =
      static_cast<std::int32_t>(std::clamp<double>(length / arc_px, kFewestArcs, kMaxRimPoints));
  std::array<Eigen::Vector2d, kMaxRimPoints> points;
  for (std::int32_t i = 0; i < arcs; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / arcs;
    const auto pixel = view.to_pixel(Eigen::Vector2d(center_mm + on_circle(angle, radius_mm)));
    if (!pixel) {
      return false;
    }
    points[static_cast<std::size_t>(i)] = *pixel;
  }
  outline_through(std::span<const Eigen::Vector2d>(points).first(static_cast<std::size_t>(arcs)),
                  *center, outline);
  return true;
}

void outline_through(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& center,
                     RimOutline& outline) {
  TUBESIGHT_ASSERT(points.size() >= 3 && points.size() <= kMaxRimPoints);
  outline.arcs.clear();
  outline.center_u_px = center.x();
  outline.center_v_px = center.y();
  Eigen::Vector2d least = center;
  Eigen::Vector2d most = center;
  for (const Eigen::Vector2d& point : points) {
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  outline.half_width_px = (most.x() - least.x()) / 2.0;
  outline.half_height_px = (most.y() - least.y()) / 2.0;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    static_cast<void>(outline.arcs.try_push_back(
        make_arc(points[(i + count - 1) % count], points[i], points[(i + 1) % count], center)));
  }
}

}  // namespace tubesight::core::picture
