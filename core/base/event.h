#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "core/base/field.h"
#include "core/base/pose_result.h"
#include "core/base/settings.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// The robot says under which tube it believes its guidetube to be, at the event's instant.
struct Claim {
  TubeAddress tube{};
};

/// Somebody names tube-ends by clicks.
struct Start {
  StaticVector<StartPoint, kMaxStartPoints> tubes;
  /// Number of the field in whose picture the clicks were made; empty: the one that follows.
  std::optional<std::int64_t> seen_field;
  bool confirmed = false;  ///< a person insists on it against a warning
};

/// A lamp level asked for, 0..1000, or the box's own again.
struct LampCommand {
  std::int32_t permille = 0;  ///< without meaning where it is automatic
  bool automatic = false;     ///< what was commanded is over: the level follows the picture
};

/// Joints whose angles a robot may tell: those of the longest arm that can be calibrated.
inline constexpr std::int32_t kMaxToldJoints = 8;

/// Where a robot has its tool by its own kinematics, T_base_tool: integers of stated scale.
struct RobotPose {
  std::array<std::int64_t, 3> position_nm{};  ///< x, y, z
  bool turned = false;                        ///< the angles are told
  std::array<std::int64_t, 3> angles_ndeg{};  ///< alpha, beta, gamma in 1e-9 degrees
  std::int32_t joints = 0;                    ///< joints whose angles are told
  std::array<std::int64_t, kMaxToldJoints> joints_ndeg{};
};

/// The robot asks for its pose.
struct PoseRequest {
  /// Where it is by its own account, to be kept beside what the box measures; nothing else is done
  /// with it. Empty: not told.
  std::optional<RobotPose> robot;
};

/// The operator points at a place of the picture.
struct Pick {
  std::array<double, 2> at_px{};           ///< full-frame pixels
  std::optional<std::int64_t> seen_field;  ///< as in Start
};

/// The operator has seen a message.
struct Acknowledge {};

/// Who sent an event and gets the reply.
enum class EventOrigin : std::uint8_t {
  kRobot,     ///< over the robot's link
  kOperator,  ///< from the operator's station
};

/// One event: what happened, when, and how the answer will be named.
struct Event {
  std::int64_t id = 0;  ///< chosen by the sender and sent back with the reply
  EventOrigin origin = EventOrigin::kRobot;
  /// When it happened, on the clock that stamps the fields; empty: in the field that follows.
  std::optional<FieldTime> at;
  /// What happened; a PoseResult is what became of a pose request, from whoever computed it, under
  /// the request's id.
  std::variant<Claim, Start, LampCommand, PoseRequest, Pick, Acknowledge, PoseResult> content;
};

/// Events that one step takes: at 115,200 baud a link brings fewer than ten requests a field.
inline constexpr std::int32_t kMaxEventsPerField = 16;

/// The events since the last field, in time order.
using EventList = StaticVector<Event, kMaxEventsPerField>;

/// The content of an event or reply if it is of kind T, and else null.
template <typename T, typename Told>
[[nodiscard]] constexpr auto* content_if(Told& told) {
  return std::get_if<T>(&told.content);
}

/// Several callables as one, for std::visit: each takes the kinds that it names.
template <typename... Callables>
struct Overloaded : Callables... {
  using Callables::operator()...;
};
template <typename... Callables>
Overloaded(Callables...) -> Overloaded<Callables...>;

}  // namespace tubesight::core
