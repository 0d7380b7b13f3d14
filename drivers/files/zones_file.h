#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// One correction by zones: the place on the sheet, what is seen there beyond the calibrated base,
/// and one standard deviation of it along each axis.
struct ZoneRow {
  std::array<double, 2> at_mm{};
  std::array<double, 3> off_mm{};
  double sigma_mm = 0.0;
};

/// Reads the text of a file of corrections (docs/file-formats.md), `most` rows at most; `name`
/// stands before every message. False, and a line in `messages` for each bad row.
[[nodiscard]] bool read_zone_rows(std::string_view text, const std::string& name, std::size_t most,
                                  std::vector<ZoneRow>& rows, Messages& messages);

}  // namespace tubesight::drivers
