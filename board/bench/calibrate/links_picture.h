#pragma once

#include <string>

#include "board/bench/calibrate/base_pairs_file.h"
#include "core/calibration/link_calibration.h"

namespace tubesight::board {

/// Draws what an arm's links are worth, as a PNG: over the sheet each pair's miss as the other half
/// of the pairs foretells it, by the base alone (white) and with the links (green), 200 times as
/// long; below it each number of each link as a bar over the band of what was expected. Links that
/// were refused as no better have the first alone; `misses` are of that calibration, one at least.
/// False, with one line in `message`, when it cannot be written.
[[nodiscard]] bool write_links_picture(const std::string& path, const NamedPairs& pairs,
                                       const core::calibration::LinkCalibration& links,
                                       const core::calibration::LinkMisses& misses,
                                       std::string& message);

}  // namespace tubesight::board
