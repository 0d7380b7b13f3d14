#pragma once

#include <string_view>

#include "core/base/pose_result.h"
#include "core/base/sighting.h"
#include "core/tracking/start.h"

namespace tubesight::board {

/// What a reason means, in a few words for a person; docs/messages.md tells more.
[[nodiscard]] std::string_view explain(core::Reason reason);

/// Why a pose request got no pose, in a few words for a person.
[[nodiscard]] std::string_view explain(core::PoseReason reason);

/// The one word of a start's refusal, as docs/messages.md lists it; empty for kNone.
[[nodiscard]] std::string_view name_of(core::tracking::StartRefusal refusal);

/// What it means, in a few words for a person.
[[nodiscard]] std::string_view explain(core::tracking::StartRefusal refusal);

}  // namespace tubesight::board
