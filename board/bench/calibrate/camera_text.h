#pragma once

#include <string>
#include <string_view>

#include "core/base/settings.h"
#include "core/calibration/camera_calibration.h"
#include "drivers/settings/session_tables.h"

namespace tubesight::board {

/// The calibrated camera as settings have it.
[[nodiscard]] core::CameraSettings calibrated(const core::CameraSettings& known,
                                              const core::calibration::CameraValues& values);

/// The reverse: what a calibration finds, as settings have it.
[[nodiscard]] core::calibration::CameraValues values_of(const core::CameraSettings& camera);

/// What a calibration is good for, in words.
[[nodiscard]] std::string_view use_of(core::calibration::Verdict verdict);

/// Why there is no calibration, and what to do about it, in one line without a name.
[[nodiscard]] std::string_view explain(core::calibration::CalibrationRefusal refusal);

/// Parameters with their standard deviations, what the residuals are, what the map is worth, the
/// verdict: lines for a person. `more` stands before the verdict, `next`, which view to take,
/// behind. `type`: of all cameras of the type.
[[nodiscard]] std::string camera_text(const core::calibration::CalibrationData& data,
                                      const core::calibration::CalibrationState& state,
                                      const core::calibration::CalibrationOutcome& outcome,
                                      std::string_view more, std::string_view next,
                                      bool type = false);

/// `[camera]` and `[camera_quality]` as a settings file; `device` says which camera it is, where
/// that is known.
[[nodiscard]] std::string camera_settings_text(const core::CameraSettings& camera,
                                               const core::calibration::CalibrationOutcome& outcome,
                                               const drivers::CalibrationQuality& device,
                                               bool type = false);

}  // namespace tubesight::board
