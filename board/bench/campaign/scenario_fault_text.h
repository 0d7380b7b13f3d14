#pragma once

#include "board/bench/campaign/toml_writer.h"
#include "drivers/simulated/fault.h"

namespace tubesight::board::campaign {

/// Writes a fault as a `[[fault]]` of a scenario file.
void write_fault(TomlWriter& toml, const drivers::Fault& fault);

}  // namespace tubesight::board::campaign
