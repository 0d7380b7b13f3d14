#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/base/transform.h"
#include "core/camera/camera_model.h"

namespace tubesight::core::picture {

/// The sheet as the camera sees it from one pose: points of its plane to pixels and back.
class SheetView {
 public:
  /// `camera` outlives the view.
  SheetView(const camera::CameraModel<double>& camera,
            const Transform<frames::Camera, frames::Sheet>& T_camera_sheet);

  /// Image of a point of the sheet's plane (mm, sheet frame), full-frame pixels; empty behind the
  /// camera or where the lens has no image.
  [[nodiscard]] std::optional<Eigen::Vector2d> to_pixel(const Eigen::Vector2d& point_mm) const {
    return to_pixel(Eigen::Vector3d(point_mm.x(), point_mm.y(), 0.0));
  }
  /// The same for any point of the sheet frame.
  [[nodiscard]] std::optional<Eigen::Vector2d> to_pixel(const Eigen::Vector3d& point_mm) const;

  /// Where a pixel's ray meets the sheet's plane; empty when it runs along it or away.
  [[nodiscard]] std::optional<Eigen::Vector2d> to_sheet(const Eigen::Vector2d& pixel) const;

 private:
  const camera::CameraModel<double>& camera_;
  Transform<frames::Camera, frames::Sheet> T_camera_sheet_;
};

}  // namespace tubesight::core::picture
