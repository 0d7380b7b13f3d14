#pragma once

#include "drivers/settings/toml_writer.h"
#include "drivers/simulated/fault.h"

namespace tubesight::board {

/// Writes a fault as a `[[fault]]` of a scenario file.
void write_fault(drivers::TomlWriter& toml, const drivers::Fault& fault);

}  // namespace tubesight::board
