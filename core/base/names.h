#pragma once

#include <string_view>

#include "core/base/field.h"
#include "core/base/pose_result.h"
#include "core/base/sighting.h"

namespace tubesight::core {

/// The word of a parity in files: `even`, `odd`, `progressive`.
[[nodiscard]] constexpr std::string_view name_of(Parity parity) {
  switch (parity) {
    case Parity::kEven: return "even";
    case Parity::kOdd: return "odd";
    case Parity::kProgressive: return "progressive";
  }
  return "";
}

/// The word of a state in files: `waiting`, `tracking`, `degraded`, `lost`.
[[nodiscard]] constexpr std::string_view name_of(TrackState state) {
  switch (state) {
    case TrackState::kWaiting: return "waiting";
    case TrackState::kTracking: return "tracking";
    case TrackState::kDegraded: return "degraded";
    case TrackState::kLost: return "lost";
  }
  return "";
}

/// The one word of a reason in files; empty for kNone.
[[nodiscard]] constexpr std::string_view name_of(Reason reason) {
  switch (reason) {
    case Reason::kNone: return "";
    case Reason::kNoStart: return "no-start";
    case Reason::kStartRefused: return "start-refused";
    case Reason::kFewTubes: return "few-tubes";
    case Reason::kDark: return "dark";
    case Reason::kWashedOut: return "washed-out";
    case Reason::kNoTubes: return "no-tubes";
    case Reason::kDamagedField: return "damaged-field";
    case Reason::kUncertain: return "uncertain";
    case Reason::kCoasted: return "coasted";
    case Reason::kJump: return "jump";
    case Reason::kSpeed: return "speed";
    case Reason::kGap: return "gap";
    case Reason::kTime: return "time";
    case Reason::kArithmetic: return "arithmetic";
  }
  return "";
}

/// The one word of a pose request's refusal in files; empty for kNone.
[[nodiscard]] constexpr std::string_view name_of(PoseReason reason) {
  switch (reason) {
    case PoseReason::kNone: return "";
    case PoseReason::kNotTracking: return "not-tracking";
    case PoseReason::kMoving: return "moving";
    case PoseReason::kBusy: return "busy";
    case PoseReason::kPicture: return "picture";
    case PoseReason::kWeak: return "weak";
    case PoseReason::kEnded: return "ended";
  }
  return "";
}

}  // namespace tubesight::core
