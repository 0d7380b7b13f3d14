#pragma once

#include "core/base/frames.h"
#include "core/base/transform.h"

namespace tubesight::drivers {

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
