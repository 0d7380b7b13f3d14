#include "drivers/simulated/spoilt_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tubesight::drivers {
namespace {

constexpr std::uint8_t kDrop = 12;  // grey level
constexpr double kSpot = 400.0;     // saturates more than a third of the disc on black

std::uint8_t rounded_grey(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
}

// Calls `change` with each pixel of random discs and its squared distance from the middle, as a
// share of the radius. A field has every second line of a frame.
template <typename Change>
void for_discs(const FieldPixels& field, double share, double least_px, double most_px, Dice& dice,
               Change change) {
  constexpr double kPi = 3.14159265358979;
  double left = share * field.width_px * field.lines;
  while (left > 0.0) {
    const double u = dice.between(0.0, field.width_px);
    const double line = dice.between(0.0, field.lines);
    const double radius = dice.between(least_px, most_px);
    left -= kPi * radius * radius / 2.0;
    const auto first = static_cast<std::int32_t>(std::max(0.0, line - radius / 2.0));
    const auto end = static_cast<std::int32_t>(std::min<double>(field.lines, line + radius / 2.0));
    const auto from = static_cast<std::int32_t>(std::max(0.0, u - radius));
    const auto to = static_cast<std::int32_t>(std::min<double>(field.width_px, u + radius));
    for (std::int32_t y = first; y < end; ++y) {
      for (std::int32_t x = from; x < to; ++x) {
        const double across = (x - u) / radius;
        const double down = 2.0 * (y - line) / radius;
        const double off2 = across * across + down * down;
        if (off2 < 1.0) {
          change(field.line(y)[x], off2);
        }
      }
    }
  }
}

}  // namespace

void blot(const FieldPixels& field, double share, Dice& dice) {
  for_discs(field, share, 14.0, 26.0, dice,
            [](std::uint8_t& pixel, double) { pixel = std::min(pixel, kDrop); });
}

void reflect(const FieldPixels& field, double share, Dice& dice) {
  for_discs(field, share, 10.0, 26.0, dice, [](std::uint8_t& pixel, double off2) {
    pixel = rounded_grey(pixel + kSpot * (1.0 - off2));
  });
}

void add_ghost(const FieldPixels& field, double share) {
  const std::int32_t shift = field.width_px / 20;
  std::vector<std::uint8_t> line(static_cast<std::size_t>(field.width_px));
  for (std::int32_t y = 0; y < field.lines; ++y) {
    std::copy_n(field.line(y), line.size(), line.begin());
    for (std::int32_t x = 0; x < field.width_px; ++x) {
      const auto from = static_cast<std::size_t>((x - shift + field.width_px) % field.width_px);
      field.line(y)[x] =
          rounded_grey((1.0 - share) * line[static_cast<std::size_t>(x)] + share * line[from]);
    }
  }
}

void raise_black(const FieldPixels& field, double black, double share) {
  std::array<std::uint8_t, 256> raised{};
  for (std::size_t level = 0; level < raised.size(); ++level) {
    raised[level] =
        rounded_grey(black + (1.0 - black / 255.0) * share * static_cast<double>(level));
  }
  for (std::int32_t y = 0; y < field.lines; ++y) {
    std::uint8_t* const line = field.line(y);
    std::transform(line, line + field.width_px, line,
                   [&raised](std::uint8_t pixel) { return raised[pixel]; });
  }
}

void cover(const FieldPixels& field, double share, double level, bool left) {
  const auto lines = static_cast<std::int32_t>(std::lround(share * field.lines));
  const auto columns = static_cast<std::int32_t>(std::lround(share * field.width_px));
  for (std::int32_t y = left ? 0 : field.lines - lines; y < field.lines; ++y) {
    std::fill_n(field.line(y), left ? columns : field.width_px, rounded_grey(level));
  }
}

void spoil(const FieldPixels& field, const FieldFaults& faults, std::uint64_t seed) {
  Dice dice(seed);
  if (faults.covered) {
    cover(field, (*faults.covered)[1], (*faults.covered)[0], faults.covered_left);
  }
  if (faults.blots_share > 0.0) {
    blot(field, faults.blots_share, dice);
  }
  if (faults.reflections_share > 0.0) {
    reflect(field, faults.reflections_share, dice);
  }
  if (faults.ghost_share > 0.0) {
    add_ghost(field, faults.ghost_share);
  }
  if (faults.black_level) {
    raise_black(field, (*faults.black_level)[0], (*faults.black_level)[1]);
  }
}

}  // namespace tubesight::drivers
