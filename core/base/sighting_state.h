#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/base/sighting.h"
#include "core/base/state_stream.h"

namespace tubesight::core {

/// Numbers of fields and of what is counted by them stay below this in a state, so that none that
/// was read can leave 64 bits later.
inline constexpr std::int64_t kMostCounted = std::int64_t{1} << 62;

template <typename Self, typename Stream>
requires std::same_as<std::remove_const_t<Self>, ImagePoint>
void transfer(Self& self, Stream& stream) {
  auto& [u, v] = self;
  stream(u, v);
}

template <typename Self, typename Stream>
requires std::same_as<std::remove_const_t<Self>, Sighting>
void transfer(Self& self, Stream& stream) {
  auto& [time, field, status, judged, judged_fields, age, state, reason, tracked, primary_known,
         primary, primary_px, axis_known, axis_px, height, tool_known, tool, tool_px, offset,
         displacement, aligned, velocity_known, velocity, velocity_span, margin_known, margin,
         residual, liveness] = self;
  stream(time);
  stream.number(field, -1, kMostCounted);
  stream.choice(status, FieldStatus::kMissing);
  stream(judged);
  stream.number(judged_fields, 0, kMostCounted);
  stream(age);
  stream.choice(state, TrackState::kLost);
  stream.choice(reason, kLastReason);
  stream(tracked, primary_known, primary, primary_px, axis_known, axis_px, height, tool_known, tool,
         tool_px, offset, displacement, aligned, velocity_known, velocity);
  stream.number(velocity_span, 0, std::numeric_limits<std::int32_t>::max());
  stream(margin_known, margin, residual);
  stream.choice(liveness, Liveness::kFailed);
}

}  // namespace tubesight::core
