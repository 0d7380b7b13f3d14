#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/pose/conic.h"
#include "core/pose/plane_points.h"

namespace tubesight::core::pose {

/// How a conic is fitted to points of the ideal plane.
enum class EllipseMethod : std::uint8_t {
  kLinear,   ///< polynomial regression with f = -1 [Fallon eq. 5.14-5.15]
  kDirect,   ///< ellipses only, 4ac - b^2 = 1 [Halir1998]; makes too small ones of arcs
  kTaubin,   ///< algebraic distance over the mean gradient [Taubin1991]
  kSampson,  ///< sum of f^2 / |grad f|^2 at its minimum, from Taubin's start [Sampson1982]
};

/// An ellipse with what it is worth.
struct EllipseFit {
  Conic conic = Conic::Zero();  ///< with positive a
  double rms_px = 0.0;          ///< of the points' distances in the picture, robust weights applied
  double withheld_rms_px = 0.0;  ///< of points that a fit without them predicts [Fallon 5.1.2]
  std::int32_t points = 0;       ///< with at least half their weight
};

/// How fit_ellipse() works.
struct EllipseOptions {
  EllipseMethod method = EllipseMethod::kSampson;
  std::int32_t robust_rounds = 3;  ///< re-weightings by Tukey's function; 0: all points count alike
  double outlier_sigmas = 4.685;   ///< where Tukey's function leaves nothing
  double least_point_px = 0.05;    ///< below this the scale of outlier rejection does not go
  bool withhold = false;           ///< fit once more without every fourth point and predict those
};

/// Fits an ellipse to the points of one rim, in coordinates shifted to their mean and scaled to
/// unit spread. Weights are those of the points times `robust`, which the fit sets.
///
/// kBufferTooSmall: fewer than 6 points; kIllConditioned: the points don't determine a conic, or
/// it is no ellipse. Cost: some 25 operations a point and round, and 60 more for kSampson.
[[nodiscard]] Result<EllipseFit> fit_ellipse(std::span<PlanePoint> points,
                                             const EllipseOptions& options);

/// One regression, all points alike, or a direct fit where that gives no ellipse: the start of a
/// pose.
[[nodiscard]] Result<Conic> fit_ellipse_quickly(std::span<const PlanePoint> points);

}  // namespace tubesight::core::pose
