#include "core/picture/sheet_view.h"

namespace tubesight::core::picture {
namespace {

// Nearer than this to the plane through the projection point nothing is imaged.
constexpr double kNearest_mm = 1.0;

}  // namespace

SheetView::SheetView(const camera::CameraModel<double>& camera,
                     const Transform<frames::Camera, frames::Sheet>& T_camera_sheet)
    : camera_(camera), T_camera_sheet_(T_camera_sheet) {}

std::optional<Eigen::Vector2d> SheetView::to_pixel(const Eigen::Vector3d& point_mm) const {
  const Eigen::Vector3d seen = T_camera_sheet_ * point_mm;
  if (seen.z() < kNearest_mm) {
    return std::nullopt;
  }
  const auto pixel = camera_.to_pixel({seen.x() / seen.z(), seen.y() / seen.z()});
  return pixel ? std::optional(Eigen::Vector2d(pixel->x, pixel->y)) : std::nullopt;
}

std::optional<Eigen::Vector2d> SheetView::to_sheet(const Eigen::Vector2d& pixel) const {
  const auto plane = camera_.to_plane({pixel.x(), pixel.y()});
  const Eigen::Matrix3d& R = T_camera_sheet_.rotation();
  const Eigen::Vector3d& t = T_camera_sheet_.translation_mm();
  // The plane's points p fulfil n . (p - t) = 0 with n the sheet's z axis seen by the camera.
  const Eigen::Vector3d normal = R.col(2);
  const Eigen::Vector3d ray(plane.x, plane.y, 1.0);
  const double depth = normal.dot(ray);
  const double distance = normal.dot(t);
  if (depth * distance <= 0.0 || depth * depth < 1e-6 * ray.squaredNorm()) {
    return std::nullopt;
  }
  const Eigen::Vector3d off = ray * (distance / depth) - t;
  return Eigen::Vector2d(R.col(0).dot(off), R.col(1).dot(off));
}

}  // namespace tubesight::core::picture
