#include "core/rendering/truth.h"

#include <algorithm>
#include <cmath>

namespace tubesight::core::rendering {
namespace {

/// Points of a rim: extents from them and a parabola through the outermost three are right to
/// 1e-4 px.
constexpr int kRimPoints = 180;
using Coordinates = std::array<double, kRimPoints>;

/// Half of largest less smallest of a smooth function once around.
double half_extent(const Coordinates& values) {
  const auto top_of = [&values](double sign) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      best = sign * values[i] > sign * values[best] ? i : best;
    }
    const double before = sign * values[(best + values.size() - 1) % values.size()];
    const double at = sign * values[best];
    const double after = sign * values[(best + 1) % values.size()];
    const double curve = before - 2.0 * at + after;
    return curve < 0.0 ? at - (after - before) * (after - before) / (8.0 * curve) : at;
  };
  return 0.5 * (top_of(1.0) + top_of(-1.0));
}

/// Centre of the ellipse that a circle makes on the ideal image plane, as a point of the camera
/// frame: from the dual conic R^2 (A A' + B B') - C C', A and B the directions of the circle's
/// plane, C its centre.
Eigen::Vector3d ellipse_center(const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                               const Eigen::Vector3d& center_mm, double radius_mm) {
  const Eigen::Matrix3d& R = T_camera_sheet.rotation();
  const Eigen::Vector3d c = T_camera_sheet * center_mm;
  const auto dual = [&](Eigen::Index row, Eigen::Index column) {
    return radius_mm * radius_mm * (R(row, 0) * R(column, 0) + R(row, 1) * R(column, 1)) -
           c(row) * c(column);
  };
  return {dual(0, 2) / dual(2, 2), dual(1, 2) / dual(2, 2), 1.0};
}

/// Whether the guidetube, a cylinder from the tip down, stands between the camera and a point; both
/// in the tool frame.
bool behind_guidetube(const Eigen::Vector3d& camera_mm, const Eigen::Vector3d& point_mm,
                      const GuidetubeLook& tube) {
  if (!(tube.radius_mm > 0.0)) {
    return false;
  }
  const Eigen::Vector3d way = point_mm - camera_mm;
  const double a = way.x() * way.x() + way.y() * way.y();
  const double b = camera_mm.x() * way.x() + camera_mm.y() * way.y();
  const double c = camera_mm.x() * camera_mm.x() + camera_mm.y() * camera_mm.y() -
                   tube.radius_mm * tube.radius_mm;
  const double root2 = b * b - a * c;
  if (!(a > 0.0) || root2 <= 0.0) {
    return false;
  }
  const double root = std::sqrt(root2);
  const double enters = std::max((-b - root) / a, 0.0);
  const double leaves = std::min((-b + root) / a, 1.0);
  // Heights along the tool's axis between entering and leaving the endless cylinder.
  const double z1 = camera_mm.z() + enters * way.z();
  const double z2 = camera_mm.z() + leaves * way.z();
  return leaves > enters && std::min(z1, z2) < 0.0 && std::max(z1, z2) > -tube.length_mm;
}

}  // namespace

Result<void> Truth::configure(const Scene& scene) {
  const Result<Projection> made = Projection::make(scene.camera);
  if (!made.has_value()) {
    return Unexpected(made.error());
  }
  projection_ = *made;
  width_px_ = scene.camera.width_px;
  height_px_ = scene.camera.height_px;
  T_camera_tool_ = camera_tool_of(scene.tool);
  guidetube_ = scene.guidetube;
  return tube_ends_.configure(scene);
}

Transform<frames::Camera, frames::Sheet> Truth::T_camera_sheet(
    const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
    const Transform<frames::Camera, frames::Camera>& knock) const {
  return knock * T_camera_tool_ * T_sheet_tool.inverse();
}

std::optional<std::array<double, 2>> Truth::image_of(
    const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
    const std::array<double, 3>& point_mm,
    const Transform<frames::Camera, frames::Camera>& knock) const {
  const Eigen::Vector3d point(point_mm[0], point_mm[1], point_mm[2]);
  return projection_.pixel(T_camera_sheet(T_sheet_tool, knock) * point);
}

std::optional<TubeImage> Truth::tube_image(
    const Transform<frames::Sheet, frames::Tool>& T_sheet_tool, TubeAddress address,
    const Transform<frames::Camera, frames::Camera>& knock) const {
  const TubeEnd end = tube_ends_.at(address);
  const Transform<frames::Camera, frames::Sheet> T_camera_sheet_now =
      T_camera_sheet(T_sheet_tool, knock);
  const Transform<frames::Tool, frames::Sheet> T_tool_sheet = T_sheet_tool.inverse();
  const Eigen::Vector3d camera_tool =
      (knock * T_camera_tool_).inverse() * Eigen::Vector3d(0.0, 0.0, 0.0);
  const Eigen::Vector3d middle(end.center_mm[0], end.center_mm[1], end.center_mm[2]);
  const std::optional<std::array<double, 2>> center =
      projection_.pixel(T_camera_sheet_now * middle);
  if (!center) {
    return std::nullopt;
  }
  TubeImage image;
  image.center_px = *center;
  Coordinates across{};
  Coordinates down{};
  int inside = 0;
  int hidden = 0;
  for (int point = 0; point < kRimPoints; ++point) {
    const double angle = 2.0 * 3.14159265358979323846 * point / kRimPoints;
    const Eigen::Vector3d rim(end.center_mm[0] + end.radius_mm * std::cos(angle),
                              end.center_mm[1] + end.radius_mm * std::sin(angle), end.center_mm[2]);
    const std::optional<std::array<double, 2>> at = projection_.pixel(T_camera_sheet_now * rim);
    if (!at) {
      return std::nullopt;
    }
    across[static_cast<std::size_t>(point)] = (*at)[0];
    down[static_cast<std::size_t>(point)] = (*at)[1];
    const bool in_frame = (*at)[0] >= 0.0 && (*at)[0] <= width_px_ - 1 && (*at)[1] >= 0.0 &&
                          (*at)[1] <= height_px_ - 1;
    inside += in_frame ? 1 : 0;
    hidden += behind_guidetube(camera_tool, T_tool_sheet * rim, guidetube_) ? 1 : 0;
  }
  const std::optional<std::array<double, 2>> ellipse =
      projection_.pixel(ellipse_center(T_camera_sheet_now, middle, end.radius_mm));
  image.ellipse_px = ellipse.value_or(*center);
  image.half_px = {half_extent(across), half_extent(down)};
  image.rim_in_frame = static_cast<double>(inside) / kRimPoints;
  image.occluded = static_cast<double>(hidden) / kRimPoints;
  return image;
}

std::optional<AxisTruth> Truth::axis(
    const Transform<frames::Sheet, frames::Tool>& T_sheet_tool) const {
  const Eigen::Vector3d direction(T_sheet_tool.rotation()(0, 2), T_sheet_tool.rotation()(1, 2),
                                  T_sheet_tool.rotation()(2, 2));
  if (!(direction.z() > 0.05)) {
    return std::nullopt;
  }
  const Eigen::Vector3d& tip = T_sheet_tool.translation_mm();
  const double along = -tip.z() / direction.z();
  AxisTruth truth;
  truth.axis_mm = {tip.x() + along * direction.x(), tip.y() + along * direction.y()};
  truth.nearest = tube_ends_.nearest(truth.axis_mm);
  return truth;
}

}  // namespace tubesight::core::rendering
