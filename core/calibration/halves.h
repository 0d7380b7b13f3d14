#pragma once

#include <cstdint>

#include "core/calibration/calibration_data.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/camera_fit.h"

namespace tubesight::core::calibration {

/// How data are divided in two.
enum class HalvesSplit : std::uint8_t {
  kDots,    ///< every second dot: what noise alone does
  kPlaces,  ///< one side of the template against the other: shows a bow, a lens of another model
  kViews,   ///< every second view, or the stage's against free poses: shows a loose lens, heights
            ///< in another unit, views that contradict each other
};

/// How well calibrations of two halves of the data agree, in the division where they agree least.
struct HalvesOutcome {
  bool told = false;  ///< false: no division leaves two halves that each tell the camera
  HalvesSplit split = HalvesSplit::kDots;
  double off_px = 0.0;       ///< between the two maps, RMS over the picture
  double promised_px = 0.0;  ///< what their covariances let expect, one standard deviation

  [[nodiscard]] double sigmas() const { return off_px / promised_px; }
};

/// Above so many standard deviations halves contradict each other: by chance in three of 100
/// calibrations at most, as the worst of three divisions is told.
inline constexpr double kMostHalvesSigmas = 2.5;

/// Scratch memory, 1.3 MB.
struct HalvesScratch {
  CalibrationData data;
  CalibrationState state;
  FitScratch fit;
};

/// Calibrates each half alone and compares the two maps from pixels to rays. What a covariance
/// promises stands on the model being right; halves that see other errors of it don't agree.
///
/// `state` is the calibration of all `data`, with `freed`. Halves that don't determine the camera
/// tell nothing and are passed over. Some six fits.
[[nodiscard]] HalvesOutcome compare_halves(const CalibrationData& data,
                                           const CalibrationState& state, const FitOptions& freed,
                                           HalvesScratch& scratch);

/// What may still be vouched for when halves contradict each other: the promised uncertainty of the
/// map grows by as much as they exceed theirs, and the verdict falls by one step at least.
[[nodiscard]] Verdict lowered_by(const HalvesOutcome& halves, Verdict verdict, double map_rms_px);

}  // namespace tubesight::core::calibration
