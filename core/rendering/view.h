#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "core/base/transform.h"
#include "core/rendering/exposure.h"
#include "core/rendering/projection.h"

namespace tubesight::core::rendering {

/// Where the camera is over one exposure.
class View {
 public:
  View() = default;
  View(const Projection& projection, const Transform<frames::Camera, frames::Tool>& T_camera_tool,
       const Exposure& exposure);

  /// The middle of the motion: what is drawn, before it is blurred.
  [[nodiscard]] const Transform<frames::Sheet, frames::Camera>& T_sheet_camera() const {
    return T_sheet_camera_;
  }
  [[nodiscard]] const Transform<frames::Tool, frames::Sheet>& T_tool_sheet() const {
    return T_tool_sheet_;
  }
  [[nodiscard]] const Transform<frames::Camera, frames::Tool>& T_camera_tool() const {
    return T_camera_tool_;
  }
  [[nodiscard]] const Projection& projection() const { return projection_; }
  /// Whether the tool moves at all.
  [[nodiscard]] bool moves() const { return moves_; }

  /// Pixel of a point of the sheet frame at the middle.
  [[nodiscard]] std::optional<std::array<double, 2>> pixel(const Eigen::Vector3d& sheet_mm) const {
    return projection_.pixel(T_camera_sheet_ * sheet_mm);
  }
  /// Way of a point's image from opening to closing, px, to first order; `pixel`: its image.
  [[nodiscard]] std::array<double, 2> motion(const std::array<double, 2>& pixel,
                                             const Eigen::Vector3d& sheet_mm) const;

 private:
  Projection projection_;
  Transform<frames::Camera, frames::Tool> T_camera_tool_;
  Transform<frames::Sheet, frames::Camera> T_sheet_camera_;
  Transform<frames::Camera, frames::Sheet> T_camera_sheet_;
  // From opening to closing, by a point of the sheet frame.
  Eigen::Matrix3d change_by_point_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d change_ = Eigen::Vector3d::Zero();
  Transform<frames::Tool, frames::Sheet> T_tool_sheet_;
  bool moves_ = false;
};

}  // namespace tubesight::core::rendering
