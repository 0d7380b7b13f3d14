#pragma once

#include <string_view>

#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"
#include "core/base/words.h"

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

/// The word of a liveness in files: `unknown`, `proved`, `failed`.
[[nodiscard]] constexpr std::string_view name_of(Liveness liveness) {
  switch (liveness) {
    case Liveness::kUnknown: return "unknown";
    case Liveness::kProved: return "proved";
    case Liveness::kFailed: return "failed";
  }
  return "";
}

/// The word of a verdict in files: `confirmed`, `contradicted`, `unknown`.
[[nodiscard]] constexpr std::string_view name_of(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kConfirmed: return "confirmed";
    case ClaimVerdict::kContradicted: return "contradicted";
    case ClaimVerdict::kUnknown: return "unknown";
  }
  return "";
}

/// The same of a pose's, which may also be `refused`.
[[nodiscard]] constexpr std::string_view name_of(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::kConfirmed: return "confirmed";
    case PoseVerdict::kContradicted: return "contradicted";
    case PoseVerdict::kUnknown: return "unknown";
    case PoseVerdict::kRefused: return "refused";
  }
  return "";
}

}  // namespace tubesight::core
