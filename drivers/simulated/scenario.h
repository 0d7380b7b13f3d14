#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/event.h"
#include "core/base/settings.h"
#include "core/kinematics/tool_path.h"
#include "core/rendering/scene.h"
#include "drivers/simulated/fault.h"
#include "drivers/simulated/robot_settings.h"

namespace tubesight::drivers {

/// How the camera delivers its pictures; the lines' order is that of the camera's `scan`.
struct SimulatedVideo {
  std::int64_t rate_numerator = 30;  ///< frames a second, as a fraction
  std::int64_t rate_denominator = 1;
  double exposure_s = 0.002;  ///< shutter open, centred on the field's instant; 0: no motion blur
  double length_s = 0.0;      ///< of the recording; 0: as long as the path
  /// Draw only the box's search window and this margin round it, px; the rest stays black. Below
  /// zero: the whole picture.
  std::int32_t window_margin_px = -1;
};

/// The light as it is commanded.
struct SimulatedLight {
  std::int32_t lamp_permille = 1000;  ///< lighthouse, at the start; lamp events change it
  double pwm_hz = 0.0;                ///< the lamp is dimmed by pulses of this rate; 0: smoothly
  double lag_s = 0.0;                 ///< the lamp follows its level with this time constant
  double ring = 0.0;                  ///< the camera's own LEDs, 0..1
};

/// An event and when it happens; the box is told of it with the first field from then on.
struct ScenarioEvent {
  double at_s = 0.0;
  core::Event event;
};

/// Everything that a run needs, as plain data: a scenario can be made, changed and cut in memory.
/// Some 600 KB: heap or static, never on a stack.
///
/// `scene` is what is true, `told` what the box believes; they differ where a scenario says so
/// (calibration errors, plugs and voids that nobody listed). The clicks of `told.start` become a
/// start event before the first field; an empty list gives none.
struct Scenario {
  core::rendering::Scene scene;
  core::SessionSettings told;                       ///< with the operator's clicks in `start`
  core::kinematics::ToolPlace from{};               ///< where the tool is at the start
  std::vector<core::kinematics::PathSegment> path;  ///< what it does then
  /// Who carries the path out: `from` and `path` are then where the robot believes its tool, and
  /// the truth differs by its errors (`home` is taken from `from`). Empty: the tool follows the
  /// path.
  std::optional<SimulatedRobotSettings> robot;
  SimulatedVideo video;
  SimulatedLight light;
  std::vector<ScenarioEvent> events;  ///< by growing time; claims, lamp commands, starts ...
  std::vector<Fault> faults;
  std::uint64_t seed = 1;  ///< of noise and pixel faults; the scene's texture has its own
};

}  // namespace tubesight::drivers
