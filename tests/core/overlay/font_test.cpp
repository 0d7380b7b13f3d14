#include "core/overlay/font.h"

#include <bit>
#include <string_view>

#include <gtest/gtest.h>

namespace tubesight::core::overlay {
namespace {

constexpr std::string_view kPromised =
    "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-+.,:/()%'_[]= ";

int dots_that_differ(const Glyph& a, const Glyph& b) {
  int count = 0;
  for (std::size_t row = 0; row < a.rows.size(); ++row) {
    count += std::popcount(static_cast<unsigned>(a.rows[row] ^ b.rows[row]));
  }
  return count;
}

TEST(Font, HasEveryPromisedCharacter) {
  for (const char character : kPromised) {
    EXPECT_TRUE(has_glyph(character)) << "'" << character << "'";
  }
}

TEST(Font, DrawsAHollowBoxForEverythingElse) {
  int unknown = 0;
  for (int code = -128; code < 256; ++code) {
    const char character = static_cast<char>(code);
    if (kPromised.find(character) != std::string_view::npos) {
      continue;
    }
    ++unknown;
    EXPECT_FALSE(has_glyph(character)) << code;
    const Glyph& glyph = glyph_of(character);
    EXPECT_EQ(glyph.rows[0], 0b11111) << code;
    EXPECT_EQ(glyph.rows[3], 0b10001) << code;
    EXPECT_EQ(glyph.rows[6], 0b11111) << code;
  }
  // 77 characters are promised; codes 128..255 were tried under both signs.
  EXPECT_EQ(unknown, 384 - 77);
}

TEST(Font, NoTwoCharactersLookAlike) {
  for (std::size_t i = 0; i < kPromised.size(); ++i) {
    for (std::size_t j = i + 1; j < kPromised.size(); ++j) {
      EXPECT_GE(dots_that_differ(glyph_of(kPromised[i]), glyph_of(kPromised[j])), 2)
          << kPromised[i] << " and " << kPromised[j];
    }
  }
}

// A digit misread is a tube misread: dirt of a few dots must not turn one into another.
TEST(Font, DigitsDifferByAtLeastSixDots) {
  for (char a = '0'; a <= '9'; ++a) {
    for (char b = static_cast<char>(a + 1); b <= '9'; ++b) {
      EXPECT_GE(dots_that_differ(glyph_of(a), glyph_of(b)), 6) << a << " and " << b;
    }
  }
}

TEST(Font, CapitalsAndDigitsFillTheirHeightAndStandOnTheBaseline) {
  for (const char character : kPromised.substr(0, 36)) {
    const Glyph& glyph = glyph_of(character);
    EXPECT_NE(glyph.rows[0], 0) << character;
    EXPECT_NE(glyph.rows[6], 0) << character;
    EXPECT_EQ(glyph.rows[7], 0) << character;
    EXPECT_EQ(glyph.rows[8], 0) << character;
  }
}

TEST(Font, FourLooksLikeAFour) {
  const Glyph& four = glyph_of('4');

  const Glyph expected{{0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010, 0, 0}};
  EXPECT_EQ(four.rows, expected.rows);
  EXPECT_TRUE(four.dot(3, 0));
  EXPECT_FALSE(four.dot(0, 0));
  EXPECT_TRUE(four.dot(0, 4));
}

TEST(Font, MeasuresTextWithoutTheLastGap) {
  EXPECT_EQ(text_width_px("", 3), 0);
  EXPECT_EQ(text_width_px("8", 1), 5);
  EXPECT_EQ(text_width_px("ROW", 2), 34);  // 3 cells of 12, less one dot of 2
}

}  // namespace
}  // namespace tubesight::core::overlay
