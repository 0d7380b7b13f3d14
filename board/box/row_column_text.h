#pragma once

#include <string>

#include "core/base/tube_address.h"

namespace tubesight::board {

/// An address as it stands in messages and files: "40,60".
[[nodiscard]] inline std::string row_column_text(core::TubeAddress tube) {
  return std::to_string(tube.row) + "," + std::to_string(tube.column);
}

}  // namespace tubesight::board
