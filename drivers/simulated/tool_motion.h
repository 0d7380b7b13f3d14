#pragma once

#include <cmath>

#include "core/base/field.h"
#include "core/base/frames.h"
#include "core/base/transform.h"

namespace tubesight::drivers {

/// The instant of a scenario's second, to the nanosecond.
[[nodiscard]] inline core::FieldTime instant_of(double seconds) {
  return core::FieldTime(std::llround(seconds * 1e9));
}

/// The scenario's second of an instant.
[[nodiscard]] inline double seconds_of(core::FieldTime time) {
  return static_cast<double>(time.count()) * 1e-9;
}

/// Moves the tool in place of a scenario's path: a simulated robot.
class ToolMotion {
 public:
  /// T_sheet_tool at an instant. Instants grow, but for a swapped field, which is up to a frame
  /// earlier than the one before.
  [[nodiscard]] virtual core::Transform<core::frames::Sheet, core::frames::Tool> pose_at(
      double time_s) = 0;

 protected:
  ~ToolMotion() = default;
};

}  // namespace tubesight::drivers
