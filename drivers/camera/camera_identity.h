#pragma once

#include <string>

namespace tubesight::drivers {

/// What is wrong with the serial number of a camera, behind its name; empty: it is the one that was
/// calibrated, or the calibration names none. What a camera does not say is empty.
[[nodiscard]] std::string serial_mismatch(const std::string& calibrated, const std::string& found);

}  // namespace tubesight::drivers
