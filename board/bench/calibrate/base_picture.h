#pragma once

#include <span>
#include <string>

#include "board/bench/calibrate/base_text.h"

namespace tubesight::board {

/// Draws the generator from below its base frame as a plan, x to the right and y up: how well the
/// tool is known at each place (green: 0 to red: 1.25 mm and more), the pairs with their misses 200
/// times as long as they are, those left out, the base, and the next place. False, with one line
/// in `message`, when it cannot be written.
[[nodiscard]] bool write_base_picture(const std::string& path, const BaseReport& report,
                                      std::span<const Eigen::Vector2d> places,
                                      std::string& message);

}  // namespace tubesight::board
