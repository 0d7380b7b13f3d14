#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {

/// Dockings that one tool calibration takes.
inline constexpr std::int32_t kMaxDockings = 16;

/// The guidetube docked on a tube, and the camera's pose by the tube-ends around [Fallon 4.4.2].
struct Docking {
  Transform<frames::Sheet, frames::Camera> T_sheet_camera;
  /// Of T_sheet_camera: x, y, z in mm and a rotation vector in rad, both in the sheet frame.
  math::Matrix6d covariance = math::Matrix6d::Zero();
  Eigen::Vector2d tip_mm = Eigen::Vector2d::Zero();  ///< the tip on the sheet: tube, and offset
};

/// What docking is taken to mean.
struct DockingAssumption {
  double height_mm = 0.0;    ///< of the tube-ends' plane above the tip
  double heading_rad = 0.0;  ///< of the tool's x axis on the sheet, in the first docking: a choice
  /// One sigma, along each axis of the sheet, of the tip from where it is taken to be; 0: known.
  /// Half of its variance is one offset of all dockings, the other half each one's own.
  double clearance_mm = 0.15;
};

/// The tool in the camera frame.
struct ToolCalibration {
  Transform<frames::Camera, frames::Tool> T_camera_tool;
  /// x, y, z in mm and alpha, beta, gamma in degrees, as in `[tool]`, and their covariance.
  Eigen::Matrix<double, 6, 1> values = Eigen::Matrix<double, 6, 1>::Zero();
  math::Matrix6d covariance = math::Matrix6d::Zero();
  /// From where the tip was taken to be to where it was on the average, on the sheet, and one
  /// sigma: as far as the headings tell it.
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d offset_sigma_mm = Eigen::Vector2d::Zero();
  double tip_spread_mm = 0.0;    ///< farthest tip of a docking from what all of them say
  double axis_spread_rad = 0.0;  ///< and axis
};

using DockingList = StaticVector<Docking, kMaxDockings>;

/// The guidetube's tip and axis in the camera frame: docked, the tool stands square under the tip's
/// place on the sheet. Of several dockings the best of all; where their headings differ, they also
/// tell an offset that all of them have on the sheet. The tool's own headings are not known, so the
/// turn about the axis is the first one's. At least one docking. Some 10 us a docking.
[[nodiscard]] ToolCalibration calibrate_tool(const DockingList& dockings,
                                             const DockingAssumption& assumption);

}  // namespace tubesight::core::calibration
