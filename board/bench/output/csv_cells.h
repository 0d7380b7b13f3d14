#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// Appends a comma and a number with fixed decimals, half away from zero; the cell stays empty for
/// what is no number.
void append_cell(std::string& out, double value, std::int32_t digits);

/// Appends a text, in double quotes where it has a comma or such quotes.
void append_text(std::string& out, const std::string& text);

}  // namespace tubesight::board
