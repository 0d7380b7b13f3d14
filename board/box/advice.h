#pragma once

#include <string_view>

#include "core/base/reply.h"
#include "core/base/sighting.h"

namespace tubesight::board {

/// What a person does about it, in one sentence; docs/messages.md tells more. Empty for kNone.
[[nodiscard]] std::string_view advice_of(core::Reason reason);
[[nodiscard]] std::string_view advice_of(core::StartRefusal refusal);

}  // namespace tubesight::board
