#pragma once

#include <array>
#include <cstdint>

#include "core/base/pose_result.h"
#include "core/base/settings.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// What can happen between two fields; the `kind` of an event file.
enum class EventKind : std::uint8_t {
  kClaim,        ///< the robot says under which tube it believes its guidetube to be
  kStart,        ///< the operator names tube-ends by clicks
  kLampCommand,  ///< a lamp level asked for
  kPoseRequest,  ///< the robot asks for its pose
  kPick,         ///< the operator points at a place of the picture
  kAcknowledge,  ///< the operator has seen a message
  kPoseResult,   ///< what became of a pose request, from whoever computed it
};

/// One event; only the members of its kind are valid.
struct Event {
  EventKind kind = EventKind::kClaim;
  TubeAddress claim{};                              ///< kClaim
  StaticVector<StartPoint, kMaxStartPoints> start;  ///< kStart
  std::array<double, 2> pick_px{};                  ///< kPick
  std::int32_t lamp_permille = 0;                   ///< kLampCommand, 0..1000
  PoseResult pose;                                  ///< kPoseResult
};

/// Events that one step takes: at 115,200 baud a link brings fewer than ten requests a field.
inline constexpr std::int32_t kMaxEventsPerField = 16;

/// The events since the last field, in time order.
using EventList = StaticVector<Event, kMaxEventsPerField>;

}  // namespace tubesight::core
