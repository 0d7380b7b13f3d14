#pragma once

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

  void draw(std::uint32_t seed, std::int32_t level = 120, std::int32_t first_line = 0) {
    std::uint32_t state = seed * 2654435761U + 1U;
    for (std::size_t i = static_cast<std::size_t>(first_line * kWidth); i < pixels_.size(); ++i) {
      state = state * 1664525U + 1013904223U;
      pixels_[i] = static_cast<std::uint8_t>(level + static_cast<std::int32_t>(state >> 30U));
    }
  }
  [[nodiscard]] FieldView view(Parity parity) const {
    return field_of({pixels_.data(), kWidth, kHeight, kWidth}, parity);
  }

  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(kWidth * kHeight);
};

}  // namespace tubesight::core::tracking
