#pragma once

#include <string>

#include "core/calibration/calibration_data.h"

namespace tubesight::board {

/// Writes a row for each dot of a calibration: where it is on the template, where it was seen, and
/// what it is off by, seen less computed; dots left out of the fit are there with `used` 0. False,
/// and why on standard error, when it does not get there.
[[nodiscard]] bool write_residuals(const std::string& path,
                                   const core::calibration::CalibrationData& data);

}  // namespace tubesight::board
