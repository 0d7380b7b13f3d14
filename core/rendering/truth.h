#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/rendering/projection.h"
#include "core/rendering/scene.h"
#include "core/rendering/tube_ends.h"

namespace tubesight::core::rendering {

/// Where a tube-end is in the picture; the columns of `centers.csv`. Pixels of the full frame.
struct TubeImage {
  std::array<double, 2> center_px{};   ///< image of the centre: x_f, y_f
  std::array<double, 2> ellipse_px{};  ///< of the rim's ellipse on the ideal plane: ell_x, ell_y
  std::array<double, 2> half_px{};     ///< half the extent of the rim's image: half_w, half_h
  double rim_in_frame = 0.0;           ///< share of the rim inside the picture, 0..1
  double occluded = 0.0;               ///< share of the rim behind the guidetube, 0..1
};

/// Where the guidetube points; the columns of `truth.csv` from axis_x on.
struct AxisTruth {
  std::array<double, 2> axis_mm{};  ///< where the guidetube's axis meets the sheet plane z = 0
  NearestTube nearest;
};

/// The exact truth of a scene. About 700 KB: static or heap.
class Truth {
 public:
  /// As Renderer::configure().
  [[nodiscard]] Result<void> configure(const Scene& scene);

  [[nodiscard]] const TubeEnds& tube_ends() const { return tube_ends_; }

  /// Pixel of a point of the sheet frame; empty behind or beside the camera. `knock` as in
  /// Exposure.
  [[nodiscard]] std::optional<std::array<double, 2>> image_of(
      const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
      const std::array<double, 3>& point_mm,
      const Transform<frames::Camera, frames::Camera>& knock = {}) const;

  /// Where a tube-end appears; empty when its rim is not wholly before the camera.
  [[nodiscard]] std::optional<TubeImage> tube_image(
      const Transform<frames::Sheet, frames::Tool>& T_sheet_tool, TubeAddress address,
      const Transform<frames::Camera, frames::Camera>& knock = {}) const;

  /// The guidetube's axis on the sheet; empty when it runs along the sheet.
  [[nodiscard]] std::optional<AxisTruth> axis(
      const Transform<frames::Sheet, frames::Tool>& T_sheet_tool) const;

  /// T_camera_sheet with the camera frame's origin at the projection point (a truth file's cs_z is
  /// larger by the focal length).
  [[nodiscard]] Transform<frames::Camera, frames::Sheet> T_camera_sheet(
      const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
      const Transform<frames::Camera, frames::Camera>& knock = {}) const;

 private:
  Projection projection_;
  std::int32_t width_px_ = 0;
  std::int32_t height_px_ = 0;
  Transform<frames::Camera, frames::Tool> T_camera_tool_;
  GuidetubeLook guidetube_;
  TubeEnds tube_ends_;
};

}  // namespace tubesight::core::rendering
