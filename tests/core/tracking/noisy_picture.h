#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/field.h"

namespace tubesight::core::tracking {

/// Draws pictures of one grey level with a noise of its own for each seed.
class NoisyPicture : public testing::Test {
 protected:
  static constexpr std::int32_t kWidth = 320;
  static constexpr std::int32_t kHeight = 240;
  static constexpr PixelBox kWindow{20, 20, 300, 200};

  void draw(std::uint32_t seed, std::int32_t level = 120, std::int32_t first_line = 0) {
    std::uint32_t state = seed * 2654435761U + 1U;
    for (std::size_t i = static_cast<std::size_t>(first_line * kWidth); i < pixels_.size(); ++i) {
      state = state * 1664525U + 1013904223U;
      pixels_[i] = static_cast<std::uint8_t>(level + static_cast<std::int32_t>(state >> 30U));
    }
  }
  /// Adds nearly normal noise of a deviation, as a line behind a frame store does.
  void add_noise(std::uint32_t seed, double deviation) {
    std::uint32_t state = seed * 2246822519U + 7U;
    for (std::uint8_t& pixel : pixels_) {
      double sum = -6.0;
      for (int i = 0; i < 12; ++i) {
        state = state * 1664525U + 1013904223U;
        sum += static_cast<double>(state >> 8U) / 16777216.0;
      }
      const double noisy = std::round(pixel + deviation * sum);
      pixel = static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 255.0));
    }
  }
  /// Puts `from` in the place of the columns left of `column`.
  void keep_left(const std::vector<std::uint8_t>& from, std::int32_t column) {
    for (std::int32_t line = 0; line < kHeight; ++line) {
      std::copy_n(from.begin() + line * kWidth, column, pixels_.begin() + line * kWidth);
    }
  }
  /// Draws stripes, `width` px each, `by` px from the left: edges in each line.
  void draw_stripes(std::int32_t by, std::int32_t width = 4, std::int32_t dark = 60,
                    std::int32_t bright = 160) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const auto column = static_cast<std::int32_t>(i % kWidth);
      pixels_[i] = static_cast<std::uint8_t>((column + by) / width % 2 == 0 ? dark : bright);
    }
  }
  [[nodiscard]] FieldView view(Parity parity) const {
    return field_of({pixels_.data(), kWidth, kHeight, kWidth}, parity);
  }

  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(kWidth * kHeight);
};

}  // namespace tubesight::core::tracking
