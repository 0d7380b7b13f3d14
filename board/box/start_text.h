#pragma once

#include <string>

#include "core/base/reply.h"

namespace tubesight::board {

/// Why a start was refused, for a person: the words of the reason, and which click is to blame,
/// counted from 1 as they were given.
[[nodiscard]] std::string refusal_text(const core::StartReply& reply);

}  // namespace tubesight::board
