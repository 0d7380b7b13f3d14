#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tubesight::core::overlay {

/// Dots of a glyph: 5 wide; 7 above the baseline and 2 below it, for the tails of g, j, p, q, y.
inline constexpr std::int32_t kGlyphWidth = 5;
inline constexpr std::int32_t kGlyphHeight = 9;
/// Height of capitals and digits.
inline constexpr std::int32_t kCapitalHeight = 7;
/// From one character to the next.
inline constexpr std::int32_t kCellWidth = 6;
/// Larger letters would be as high as the picture of a camera.
inline constexpr std::int32_t kLargestTextScale = 64;

/// One character's dots, top row first, the leftmost dot in bit 4.
struct Glyph {
  std::array<std::uint8_t, kGlyphHeight> rows{};

  /// Says whether a dot is set; `column` 0..4, `row` 0..8.
  [[nodiscard]] constexpr bool dot(std::int32_t column, std::int32_t row) const {
    const std::uint32_t bits = rows[static_cast<std::size_t>(row)];
    return ((bits >> static_cast<std::uint32_t>(kGlyphWidth - 1 - column)) & 1U) != 0;
  }
};

/// The glyph of a character: digits, letters, space and - + . , : / ( ) % ' _ [ ] =; a hollow box
/// for others.
[[nodiscard]] const Glyph& glyph_of(char character);

/// Says whether the font draws this character as itself rather than as the hollow box.
[[nodiscard]] bool has_glyph(char character);

/// Width of a line of text: from its first dot column to its last, without the last cell's gap.
[[nodiscard]] constexpr std::int32_t text_width_px(std::string_view words, std::int32_t scale) {
  const auto characters = static_cast<std::int32_t>(words.size());
  return characters == 0 ? 0 : (characters * kCellWidth - 1) * scale;
}

}  // namespace tubesight::core::overlay
