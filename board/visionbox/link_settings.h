#pragma once

#include <cstdint>

#include "drivers/modbus/modbus_server.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The robot's link; the order of the words of `kind`.
enum class LinkKind : std::uint8_t { kNone, kModbus };

/// The table `[link]`.
struct LinkSettings {
  LinkKind kind = LinkKind::kNone;
  drivers::ModbusSettings modbus;  ///< of that kind alone
};

/// Reads the table; no device is looked for.
void read_link(drivers::TableReader& table, LinkSettings& link);

}  // namespace tubesight::board
