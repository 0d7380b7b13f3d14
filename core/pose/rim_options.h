#pragma once

#include <cstdint>

namespace tubesight::core::pose {

/// What is known of tube-ends and edges before the fit, and how outliers are told.
struct RimBundleOptions {
  double radius_sigma_mm = 0.1;     ///< of a tube-end's radius about the nominal one
  double offset_sigma_px = 1.0;     ///< of the edge offset common to all rims (blooming)
  double center_sigma_mm = 0.01;    ///< of a tube-end's centre from the lattice, each of x and y
  bool center_sigma_fixed = false;  ///< false: a first guess, set by the picture with more tubes
  bool point_sigma_fixed = false;   ///< false: the points' sigma_px are scaled by the residuals
  double outlier_sigmas = 3.5;      ///< Tukey's limit is this times 1.34
  double least_point_px = 0.05;     ///< below this the scale of outlier rejection does not go
  double normal_cosine = 0.7;       ///< points whose measured normal is farther off are rejected
  std::int32_t min_points = 8;      ///< of a rim
  std::int32_t max_passes = 8;
};

}  // namespace tubesight::core::pose
