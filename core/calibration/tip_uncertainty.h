#pragma once

#include <cstdint>

#include "core/calibration/imaging.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {

/// What is assumed where the guidetube's tip is reckoned from a camera calibration: a tubesheet of
/// square pitch, square to the guidetube, its tube-ends in the picture all seen to the same noise;
/// and a tool that was calibrated with this camera by docking, its tip at the tube's very centre.
struct TipSituation {
  double pitch_mm = 25.4;
  double tube_px = 0.05;                     ///< of a tube-end's place, a coordinate
  Eigen::Vector3d tip_mm{0.0, 30.0, 113.0};  ///< in the camera frame
  /// Of the tool: z is the guidetube's axis, and the sheet's normal.
  Eigen::Matrix3d R_camera_tool = Eigen::Matrix3d::Identity();
};

/// How well the tip's place on the sheet is known there, one standard deviation.
struct TipUncertainty {
  std::int32_t tubes = 0;      ///< in the picture; below 4 nothing is told
  double across_mm = 0.0;      ///< by the calibration: along the worse direction of the sheet
  double along_mm = 0.0;       ///< by the calibration: along the tubes
  double all_across_mm = 0.0;  ///< with the tube-ends' noise, docked and now
  double all_along_mm = 0.0;

  [[nodiscard]] bool told() const { return tubes >= 4; }
};

/// The guidetube's tip with the sheet `gap_mm` above it. What is wrong with the camera moves the
/// sheet's pose at the docking and now; the tip feels the difference of the two.
[[nodiscard]] TipUncertainty tip_uncertainty(const Sensor& sensor, const CameraValues& camera,
                                             const math::Matrix6d& covariance,
                                             const TipSituation& situation, double gap_mm);

}  // namespace tubesight::core::calibration
