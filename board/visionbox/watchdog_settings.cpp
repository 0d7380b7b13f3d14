#include "board/visionbox/watchdog_settings.h"

#include <cstddef>

namespace tubesight::board {
namespace {

/// Less than the shortest would reset a machine whose box is only busy.
constexpr drivers::WholeRange kTimeout{10, 3600};
constexpr std::size_t kLongestDevice = 255;

}  // namespace

void read_watchdog(drivers::TableReader& table, WatchdogSettings& watchdog) {
  if (table.text("device", watchdog.device) &&
      (watchdog.device.empty() || watchdog.device.size() > kLongestDevice ||
       watchdog.device[0] != '/')) {
    table.complain("device",
                   "'" + watchdog.device + "', expected a path from the root: \"/dev/watchdog\"");
  }
  table.optional_whole("timeout_s", kTimeout, watchdog.timeout_s);
}

}  // namespace tubesight::board
