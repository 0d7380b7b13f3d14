#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/frames.h"
#include "core/base/transform.h"
#include "drivers/simulated/fault.h"

namespace tubesight::drivers {

/// When a field is exposed, by the camera's own clock.
struct FieldSlot {
  double time_s = 0.0;               ///< nominal mid-exposure
  double frame_time_s = 0.0;         ///< that of the frame's first field: whole frames go by it
  double period_s = 0.0;             ///< from field to field
  double time_before_s = 0.0;        ///< nominal mid-exposure of the field before
  double frame_time_before_s = 0.0;  ///< that of the first field of the frame before
};

/// All that the faults do to one field.
struct FieldFaults {
  std::uint32_t kinds = 0;  ///< bit n: FaultKind n is at work
  bool lost = false;        ///< dropped or cut: the field is not delivered
  bool unnumbered = false;  ///< lost, and the sequence does not show it
  bool damaged = false;     ///< the driver says so
  bool repeated = false;
  bool swapped = false;
  bool snow = false;
  bool frozen = false;
  bool other_camera = false;
  std::array<std::int32_t, 2> elsewhere{};  ///< other-camera: lattice steps, rows and columns
  std::optional<double> torn_after;         ///< share of the lines that are new
  std::optional<std::uint8_t> filled;       ///< grey value
  double lamp = 1.0;                        ///< share of the light commanded
  std::uint16_t dead_lamps = 0;
  core::Transform<core::frames::Camera, core::frames::Camera>
      knock{};  ///< rotation of what is seen
  bool knocked = false;
  std::array<std::int32_t, 2> jump{};  ///< lattice steps, rows and columns
  double skipped_s = 0.0;              ///< of the path
  core::Transform<core::frames::Tool, core::frames::Tool> off{};  ///< pose-step
  double emi_share = 0.0;
  double emi_amplitude = 0.0;
  double salt_pepper_share = 0.0;
  double held_share = 0.0;  ///< held: of the columns, from the left
  double held_noise = 0.0;  ///< held: sigma behind the store, grey levels
  double coarseness = 0.0;  ///< compressed: grey levels of a step
  double waver_s = 0.0;     ///< jitter: of the stamp, at most
  double blots_share = 0.0;
  double reflections_share = 0.0;
  double ghost_share = 0.0;
  std::optional<std::array<double, 2>> black_level;  ///< grey value, share of the contrast left
  std::optional<std::array<double, 2>> covered;      ///< grey value, share of the lines or columns
  bool covered_left = false;                         ///< of the columns, from the left

  [[nodiscard]] constexpr bool has(FaultKind kind) const {
    return ((kinds >> static_cast<unsigned>(kind)) & 1U) != 0;
  }
};

/// What `faults` do to the field of a slot. Of several of a kind lamps multiply, dead lamps,
/// knocks, jumps and shakes add up, fills and tears are the last one's, emi, salt-pepper and jitter
/// the largest's, held and compressed the last one's; blots, reflections and ghosts are the
/// largest's, black levels and covers the last one's.
[[nodiscard]] FieldFaults faults_of(std::span<const Fault> faults, const FieldSlot& slot);

/// How the faults shake the tool at an instant: T_tool_shaken, the identity without vibration.
[[nodiscard]] core::Transform<core::frames::Tool, core::frames::Tool> shake_at(
    std::span<const Fault> faults, double time_s);

}  // namespace tubesight::drivers
