#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/settings.h"
#include "drivers/modbus/link_state.h"

namespace tubesight::board {

/// "1.12.3" as 10000 * major + 100 * minor + patch; what is left out counts 0.
[[nodiscard]] std::int32_t version_number(std::string_view version);

/// A number of this start of the box that the one before did not have; never 0.
[[nodiscard]] std::int32_t draw_boot_number();

/// What the box says of itself to the robot. Calibrations have no identities yet.
[[nodiscard]] drivers::LinkIdentity link_identity(const core::SessionSettings& session);

}  // namespace tubesight::board
