#include "drivers/simulated/video_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace tubesight::drivers {
namespace {

void copy_lines(const FieldPixels& field, std::vector<std::uint8_t>& to) {
  const auto width = static_cast<std::size_t>(field.width_px);
  for (std::int32_t line = 0; line < field.lines; ++line) {
    std::copy_n(field.line(line), width, to.data() + static_cast<std::size_t>(line) * width);
  }
}

// Nearly normal, of deviation 1: the sum of four even numbers of 16 bits.
double noise(Dice& dice) {
  std::uint64_t bits = dice.next();
  double sum = 0.0;
  for (int i = 0; i < 4; ++i, bits >>= 16U) {
    sum += static_cast<double>(bits & 0xFFFFU) / 65536.0;
  }
  return (sum - 2.0) * std::sqrt(3.0);
}

std::uint8_t grey(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
}

void hang(const FieldPixels& field, const std::vector<std::uint8_t>& store,
          const FieldFaults& faults, Dice& dice) {
  const auto width = static_cast<std::size_t>(field.width_px);
  const auto held = static_cast<std::int32_t>(std::lround(faults.held_share * field.width_px));
  for (std::int32_t line = 0; line < field.lines; ++line) {
    const std::uint8_t* const from = store.data() + static_cast<std::size_t>(line) * width;
    std::copy_n(from, held, field.line(line));
    for (std::int32_t u = 0; faults.held_noise > 0.0 && u < held; ++u) {
      field.line(line)[u] = grey(from[u] + faults.held_noise * noise(dice));
    }
  }
}

/// A square of a field's pixels, as compressors code them.
struct Square {
  std::int32_t u = 0;
  std::int32_t line = 0;
  std::int32_t width = 0;
  std::int32_t lines = 0;
};

// What differs by less than noise stays as it was; the rest is coded anew, around its mean in
// steps.
void code(const FieldPixels& field, const std::vector<std::uint8_t>& before, const Square& square,
          double step) {
  const auto old_line = [&](std::int32_t line) {
    return before.data() +
           static_cast<std::size_t>(line) * static_cast<std::size_t>(field.width_px);
  };
  std::int32_t sum = 0;
  std::int32_t changed = 0;
  for (std::int32_t line = square.line; line < square.line + square.lines; ++line) {
    for (std::int32_t u = square.u; u < square.u + square.width; ++u) {
      sum += field.line(line)[u];
      changed += std::abs(std::int32_t{field.line(line)[u]} - std::int32_t{old_line(line)[u]});
    }
  }
  const double pixels = square.width * square.lines;
  const double mean = sum / pixels;
  const bool skipped = changed < 0.5 * step * pixels;
  for (std::int32_t line = square.line; line < square.line + square.lines; ++line) {
    for (std::int32_t u = square.u; u < square.u + square.width; ++u) {
      std::uint8_t& pixel = field.line(line)[u];
      pixel = skipped ? old_line(line)[u] : grey(mean + std::round((pixel - mean) / step) * step);
    }
  }
}

}  // namespace

void VideoSource::begin(std::size_t pixels) {
  hangs_ = {};
  before_.assign(pixels, 0);
  for (std::vector<std::uint8_t>& store : stores_) {
    store.assign(pixels, 0);
  }
}

void VideoSource::remember(const FieldPixels& field, core::Parity parity,
                           const FieldFaults& faults) {
  bool& hangs = hangs_[static_cast<std::size_t>(parity)];
  if (faults.has(FaultKind::kHeld) && !hangs) {
    copy_lines(field, store(parity));
  }
  hangs = faults.has(FaultKind::kHeld);
  if (faults.has(FaultKind::kCompressed)) {
    copy_lines(field, before_);
  }
}

void VideoSource::pass(const FieldPixels& field, core::Parity parity, const FieldFaults& faults,
                       Dice& dice) {
  if (faults.has(FaultKind::kHeld)) {
    hang(field, store(parity), faults, dice);
  }
  constexpr std::int32_t kSide = 8;
  for (std::int32_t line = 0; faults.has(FaultKind::kCompressed) && line < field.lines;
       line += kSide) {
    for (std::int32_t u = 0; u < field.width_px; u += kSide) {
      code(field, before_,
           {u, line, std::min(kSide, field.width_px - u), std::min(kSide, field.lines - line)},
           faults.coarseness);
    }
  }
}

}  // namespace tubesight::drivers
