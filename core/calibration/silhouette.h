#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/camera/camera_model.h"
#include "core/picture/averaged_picture.h"
#include "core/picture/rim.h"

namespace tubesight::core::calibration {

/// The guidetube as a cylinder from its tip down along the tool's -z.
struct GuidetubeShape {
  double diameter_mm = 0.0;
  double length_mm = 0.0;  ///< as far as it is seen below the tip
};

/// The parts of its outline in the picture; left and right as seen with the tip upwards.
enum class SilhouettePart : std::uint8_t { kLeft, kTip, kRight };
inline constexpr std::size_t kSilhouetteParts = 3;

/// Points that a part holds.
inline constexpr std::int32_t kSilhouettePoints = 24;

/// One part of the outline.
struct SilhouetteEdge {
  /// Full-frame pixels: sides from the tip down, the tip's rim from left to right. Only what is in
  /// the picture; fewer than two: the part is not.
  StaticVector<Eigen::Vector2d, kSilhouettePoints> points_px;
  bool measured = false;  ///< moved to the edge that the picture shows
  double sigma_px = 0.0;  ///< across the edge; measured: the scatter of its points
  double shift_px = 0.0;  ///< measured: from where it was computed, outwards, in its middle
};

struct Silhouette {
  std::array<SilhouetteEdge, kSilhouetteParts> edges;
  [[nodiscard]] const SilhouetteEdge& edge(SilhouettePart part) const {
    return edges[static_cast<std::size_t>(part)];
  }
};

/// Where the guidetube's outline stands in the picture by the tool's pose: the two lines along
/// which rays touch the cylinder, and the half of the tip's rim between them that lies farther out.
/// Empty edges where the camera is inside the cylinder or the part is outside the picture.
[[nodiscard]] Silhouette computed_silhouette(
    const camera::CameraModel<double>& camera,
    const Transform<frames::Camera, frames::Tool>& T_camera_tool, const GuidetubeShape& shape,
    std::int32_t width_px, std::int32_t height_px);

/// Moves each part to the edge that the picture shows within `reach_px` of it: the steepest place
/// of the grey levels across it at each of its points, and a shift and turn that most of them agree
/// on. Points that leave the picture so are left out. What finds no such edge (too dark, too alike
/// what is behind) stays as computed.
void measure_silhouette(const picture::AveragedPicture& picture, double reach_px,
                        Silhouette& silhouette);

/// Points of a tube-end's rim that lie inside the outline by more than `margin_px`, where the
/// guidetube hides what is behind it.
[[nodiscard]] std::int32_t points_hidden(const Silhouette& silhouette, const picture::Rim& rim,
                                         double margin_px);

}  // namespace tubesight::core::calibration
