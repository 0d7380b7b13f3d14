#pragma once

#include <array>
#include <cstdint>

#include "core/base/tube_address.h"

namespace tubesight::core {

/// Why a pose request got no pose. docs/messages.md explains each.
enum class PoseReason : std::uint8_t {
  kNone,
  kNotTracking,  ///< the box does not know which tubes it sees
  kMoving,       ///< the tool moves, or moved while the pictures were taken
  kBusy,         ///< the request before is not answered yet
  kPicture,      ///< too few tube-ends could be measured, or they contradict each other
  kWeak,         ///< the tube-ends measured don't determine the pose
  kEnded,        ///< the pictures ended before there were enough
};

/// What became of a pose request, as it crosses ports: integers of stated scale.
///
/// Computed beside the path at lower priority, so that it comes back as an event.
struct PoseResult {
  PoseReason reason = PoseReason::kNotTracking;     ///< kNone: the members below are valid
  std::array<std::int64_t, 3> position_nm{};        ///< T_sheet_tool: x, y, z
  std::array<std::int64_t, 3> angles_ndeg{};        ///< alpha, beta, gamma in 1e-9 degrees
  std::array<std::int64_t, 3> position_sigma_nm{};  ///< one standard deviation each
  std::array<std::int64_t, 3> angle_sigma_ndeg{};
  std::int32_t tubes = 0;  ///< tube-ends used
  TubeAddress nearest{};   ///< to the guidetube's axis
  std::int64_t offset_nm = 0;
};

}  // namespace tubesight::core
