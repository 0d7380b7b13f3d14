#pragma once

#include <array>
#include <cstdint>

#include "core/calibration/calibration_data.h"
#include "core/calibration/dense_normal.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {

/// What of a camera a fit frees; the poses and the stage always are.
struct FitOptions {
  bool center_and_scale = true;  ///< c_u, c_v, h_sx; else they stay as they are
  bool distortion = true;        ///< k
  bool distortion2 = false;      ///< k2
  bool stage_axis = false;       ///< the stage's; else it moves along the template's normal
  bool tangential = false;       ///< p1, p2
  bool bow = false;              ///< of the template
};

/// How a fit ended.
struct FitOutcome {
  bool converged = false;
  bool determined = false;  ///< the views tell all unknowns apart
  double sum_px2 = 0.0;     ///< of the squared residuals of the dots used
  std::int32_t dots = 0;    ///< used
  std::int32_t unknowns = 0;
  /// Residuals' standard deviation of a coordinate, with the unknowns counted off.
  double sigma_px = 0.0;
  double rms_px = 0.0;                                        ///< of the residuals' lengths
  math::Matrix6d camera_covariance = math::Matrix6d::Zero();  ///< 0 where held
  /// Of the lean of the stage's axis in two directions across it, rad, and with the camera; 0 where
  /// it is held.
  Eigen::Matrix2d axis_covariance = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 6, 2> camera_axis_covariance = Eigen::Matrix<double, 6, 2>::Zero();
};

/// Scratch memory, 0.7 MB.
struct FitScratch {
  DenseNormal normal;
  std::array<double, kMaxUnknowns> step{};
  CalibrationState trial;
  CalibrationState more;    ///< of a caller that tries a fit
  CalibrationState before;  ///< of a caller that may go back
};

/// Fits camera, stage and poses together to all dots used, by Levenberg and Marquardt's method: the
/// maximum of likelihood for errors alike in both coordinates of every dot. Leaves the residuals
/// with the dots, and in `state` the fit. Some 30 ms for 15 views of 100 dots.
[[nodiscard]] FitOutcome fit_camera(const FitOptions& options, CalibrationData& data,
                                    CalibrationState& state, FitScratch& scratch);

/// By how much the sum of squares would fall with more freed than was fitted, to first order: what
/// a step of the fit promises at `state`, whose residuals stand with the dots. 0 where the views
/// don't tell all unknowns apart. A fraction of a fit's time.
[[nodiscard]] double promised_gain(const FitOptions& options, const CalibrationData& data,
                                   const CalibrationState& state, FitScratch& scratch);

}  // namespace tubesight::core::calibration
