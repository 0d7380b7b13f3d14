#include "drivers/simulated/steps_like.h"

#include <cmath>

#include "core/tubesheet/sheet_places.h"

namespace tubesight::drivers {

std::array<std::int32_t, 2> steps_like(const core::TubesheetSettings& sheet,
                                       const core::MotionSettings& motion, double field_s,
                                       const std::array<double, 2>& way_mm) {
  constexpr double kMeasured_mm = 0.6;
  constexpr std::int32_t kFarthest = 30;
  double nearest_mm = 2.0 * motion.max_acceleration_mm_s2 * field_s * field_s + kMeasured_mm;
  std::array<std::int32_t, 2> steps{};
  for (std::int32_t row = -kFarthest; row <= kFarthest; ++row) {
    for (std::int32_t column = -kFarthest; column <= kFarthest; ++column) {
      if (core::tubesheet::check_move(sheet, {row, column}) != core::tubesheet::MoveFault::kNone) {
        continue;
      }
      const auto by_mm = core::tubesheet::move_mm(sheet, {row, column});
      const double off_mm = std::hypot(way_mm[0] - by_mm[0], way_mm[1] - by_mm[1]);
      if (off_mm < nearest_mm) {
        nearest_mm = off_mm;
        steps = {row, column};
      }
    }
  }
  return steps;
}

}  // namespace tubesight::drivers
