#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/calibration/tool_calibration.h"
#include "core/camera/camera_model.h"

namespace tubesight::core::calibration {

/// A point of a target on the guidetube, and where the picture shows it.
struct ToolPoint {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();  ///< tool frame
  Eigen::Vector2d seen_px = Eigen::Vector2d::Zero();   ///< full-frame pixels
};

/// Points that one calibration takes, and the least: a wrong one is told by the others.
inline constexpr std::int32_t kMaxToolPoints = 64;
inline constexpr std::int32_t kLeastToolPoints = 6;

/// Why points give no tool.
enum class ToolPointsRefusal : std::uint8_t {
  kNone,
  kTooFew,
  kOneLine,       ///< all on one line, or at one place: the turn about it stays open
  kNoPose,        ///< no pose puts half of them where they are seen
  kMirrored,      ///< they fit mirrored, or seen from inside the guidetube, or it points away
  kAmbiguous,     ///< two poses fit them: points of a plane, seen too small or from too far
  kManyOutliers,  ///< more than a third of them lie off
  kUncertain,     ///< they leave the tip open by more than a millimetre
};

/// What became of a point.
struct ToolPointVerdict {
  bool used = false;
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();  ///< from where the pose puts it to the seen
};

struct ToolPointsOutcome {
  ToolPointsRefusal refusal = ToolPointsRefusal::kNone;
  ToolCalibration tool;    ///< its spreads and offset stay 0
  bool coplanar = false;   ///< within a hundredth of their extent
  std::int32_t used = 0;   ///< points that the pose is made of
  double rms_px = 0.0;     ///< of those, of both coordinates together
  double sigma_px = 0.0;   ///< of a coordinate, as the uncertainties take it
  double second_px = 0.0;  ///< RMS of the other pose of a plane; 0: there is none
  StaticVector<ToolPointVerdict, kMaxToolPoints> points;
};

using ToolPointList = StaticVector<ToolPoint, kMaxToolPoints>;

/// The tool in the camera frame from known points on the guidetube in one picture, of any shape.
///
/// All poses of three points each [Fallon eq. 5.22-5.28] are tried and that taken which puts most
/// points where they are seen; then least squares over those [Fallon eq. 5.39]. A point more than
/// five standard deviations (0.5 px at least) off is left out. The deviation of a coordinate is
/// that of the residuals, with four misses of 0.1 px counted beside them.
///
/// A mirrored order of points in a plane fits as well as the right one, seen from behind. What
/// tells them apart: the guidetube points away from the camera, and a plane beside the tip is seen
/// from outside. Points of a plane through the tip and along the axis show neither. Some 100 ms.
[[nodiscard]] ToolPointsOutcome tool_from_points(const camera::CameraModel<double>& camera,
                                                 const ToolPointList& points);

}  // namespace tubesight::core::calibration
