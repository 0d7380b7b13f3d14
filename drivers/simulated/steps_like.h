#pragma once

#include <array>
#include <cstdint>

#include "core/base/settings.h"

namespace tubesight::drivers {

/// The lattice steps (rows, columns) that a way of the tool over the sheet, mm, looks like to a box
/// that sees nothing of it: those that it misses by no more than [motion] lets the tool go from
/// field to field, `field_s`, twice (place and speed), and 0.6 mm for measuring. None: {0, 0}.
[[nodiscard]] std::array<std::int32_t, 2> steps_like(const core::TubesheetSettings& sheet,
                                                     const core::MotionSettings& motion,
                                                     double field_s,
                                                     const std::array<double, 2>& way_mm);

}  // namespace tubesight::drivers
