#include "drivers/simulated/pixel_faults.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tubesight::drivers {

void fill(const FieldPixels& field, std::uint8_t grey) {
  for (std::int32_t line = 0; line < field.lines; ++line) {
    std::fill_n(field.line(line), field.width_px, grey);
  }
}

void snow(const FieldPixels& field, Dice& dice) {
  for (std::int32_t line = 0; line < field.lines; ++line) {
    std::uint8_t* const pixels = field.line(line);
    for (std::int32_t u = 0; u < field.width_px; ++u) {
      pixels[u] = static_cast<std::uint8_t>(dice.next() >> 56);
    }
  }
}

void disturb_lines(const FieldPixels& field, double share, double amplitude, Dice& dice) {
  for (std::int32_t line = 0; line < field.lines; ++line) {
    if (dice.share() >= share) {
      continue;
    }
    std::uint8_t* const pixels = field.line(line);
    double lift = dice.between(-amplitude, amplitude);
    // Gone to a third after a quarter to all of the line.
    const double fading = std::pow(1.0 / 3.0, 1.0 / (dice.between(0.25, 1.0) * field.width_px));
    for (std::int32_t u = 0; u < field.width_px; ++u) {
      pixels[u] = static_cast<std::uint8_t>(std::clamp(std::round(pixels[u] + lift), 0.0, 255.0));
      lift *= fading;
    }
  }
}

void salt_and_pepper(const FieldPixels& field, double share, Dice& dice) {
  const double pixels = static_cast<double>(field.width_px) * field.lines;
  const auto hits = static_cast<std::int64_t>(std::round(share * pixels));
  for (std::int64_t hit = 0; hit < hits; ++hit) {
    const std::uint64_t bits = dice.next();
    const auto line =
        static_cast<std::int32_t>((bits & 0xFFFFFFFU) % static_cast<std::uint64_t>(field.lines));
    const auto u = static_cast<std::int32_t>(((bits >> 28) & 0xFFFFFFFU) %
                                             static_cast<std::uint64_t>(field.width_px));
    field.line(line)[u] = (bits >> 63) != 0 ? 255 : 0;
  }
}

}  // namespace tubesight::drivers
