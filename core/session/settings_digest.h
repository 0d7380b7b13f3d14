#pragma once

#include <cstdint>

#include "core/base/settings.h"

namespace tubesight::core::session {

/// A digest of all settings that a step depends on: of everything but the clicks of `[start]`.
/// The same on every machine for the same numbers.
[[nodiscard]] std::uint64_t settings_digest(const SessionSettings& settings);

}  // namespace tubesight::core::session
