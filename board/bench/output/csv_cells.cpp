#include "board/bench/output/csv_cells.h"

#include <cmath>

#include "drivers/files/decimal.h"

namespace tubesight::board {

void append_cell(std::string& out, double value, std::int32_t digits) {
  out += ',';
  if (std::isfinite(value) && std::abs(value) < 1e9) {
    const double scale = std::pow(10.0, digits);
    drivers::append_decimal(out, std::llround(value * scale), std::llround(scale), digits);
  }
}

void append_text(std::string& out, const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char character : text) {
    out += character;
    if (character == '"') {
      out += character;
    }
  }
  out += '"';
}

}  // namespace tubesight::board
