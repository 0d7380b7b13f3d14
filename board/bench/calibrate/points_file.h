#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/calibration/calibration_data.h"
#include "drivers/settings/target_settings.h"

namespace tubesight::board {

/// Appends the points of a file `x_mm,y_mm,u_px,v_px`, or `x_mm,y_mm,z_mm,u_px,v_px` where they are
/// not in one plane, to `dots`. Empty, or one line that says what is wrong and where.
[[nodiscard]] std::string read_points(
    const std::string& path,
    core::StaticVector<core::calibration::SeenDot, core::calibration::kMaxDots>& dots);

/// The files that write_points() writes into a folder: view-0.csv and so on, and target.toml.
[[nodiscard]] std::vector<std::string> points_files(const std::string& folder, std::size_t views);

/// Writes what the pictures of a calibration show, so that it can be calibrated without them: a
/// points file a view, and a target's file that reads them. False, with the reason on standard
/// error: nothing is changed.
[[nodiscard]] bool write_points(const std::string& folder, const drivers::TargetFile& file,
                                const core::calibration::CalibrationData& data);

}  // namespace tubesight::board
