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

/// Identity of a calibration: the digest of its parameters in their canonical form (FNV-1a of 32
/// bits, the uppermost left out). Never negative, for who prints it.
[[nodiscard]] std::int32_t calibration_id(std::string_view canonical);

/// What the box says of itself to the robot. Camera and tool are those that the session is told, by
/// what stands in the settings; the base is in no setting, so it has no identity.
[[nodiscard]] drivers::LinkIdentity link_identity(const core::SessionSettings& session);

}  // namespace tubesight::board
