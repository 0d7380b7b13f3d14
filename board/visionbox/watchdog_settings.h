#pragma once

#include <cstdint>
#include <string>

#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The table `[watchdog]`: hardware that resets the machine when the box is stuck.
struct WatchdogSettings {
  std::string device;           ///< empty: there is none
  std::int32_t timeout_s = 15;  ///< longer than a service manager takes to start the box again

  [[nodiscard]] bool wanted() const { return !device.empty(); }
};

/// Reads the table. The device need not be there.
void read_watchdog(drivers::TableReader& table, WatchdogSettings& watchdog);

}  // namespace tubesight::board
