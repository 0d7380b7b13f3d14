#pragma once

#include <string>
#include <string_view>

#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// Keys that nothing would obey: somebody believes that they mean something.
template <typename Keys>
void refuse_keys(drivers::TableReader& table, const Keys& keys, const std::string& why) {
  for (const std::string_view key : keys) {
    if (table.has(key)) {
      table.complain(key, why + ", expected it left out");
    }
    table.ignore(key);
  }
}

/// Whether they are mistakes hangs on something that is one itself.
template <typename Keys>
void ignore_keys(drivers::TableReader& table, const Keys& keys) {
  for (const std::string_view key : keys) {
    table.ignore(key);
  }
}

}  // namespace tubesight::board
