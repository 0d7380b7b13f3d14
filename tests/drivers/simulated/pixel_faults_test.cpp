#include "drivers/simulated/pixel_faults.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kWidth = 40;
constexpr std::int32_t kHeight = 60;

/// A grey frame, of which every other line is the field at hand.
struct Frame {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(kWidth * kHeight, 100);

  FieldPixels odd() { return {pixels.data() + kWidth, kWidth, kHeight / 2, 2 * kWidth}; }
  /// Pixels of the lines of a parity that are no longer grey 100.
  [[nodiscard]] int changed(int parity) const {
    int count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      count += (static_cast<int>(i) / kWidth) % 2 == parity && pixels[i] != 100 ? 1 : 0;
    }
    return count;
  }
  [[nodiscard]] std::vector<std::uint8_t> line(int index) const {
    return {pixels.begin() + index * kWidth, pixels.begin() + (index + 1) * kWidth};
  }
};

TEST(Fill, ChangesItsFieldAlone) {
  Frame frame;

  fill(frame.odd(), 7);

  EXPECT_EQ(frame.line(1), std::vector<std::uint8_t>(kWidth, 7));
  EXPECT_EQ(frame.line(59), std::vector<std::uint8_t>(kWidth, 7));
  EXPECT_EQ(frame.changed(0), 0);
}

TEST(Snow, IsEvenNoiseThatFollowsFromItsDice) {
  Frame frame;
  Frame again;
  Dice dice(5);
  Dice same(5);

  snow(frame.odd(), dice);
  snow(again.odd(), same);

  EXPECT_EQ(frame.pixels, again.pixels);
  EXPECT_EQ(frame.changed(0), 0);
  double sum = 0.0;
  double squares = 0.0;
  for (int line = 1; line < kHeight; line += 2) {
    for (const std::uint8_t grey : frame.line(line)) {
      sum += grey;
      squares += grey * grey;
    }
  }
  constexpr double kPixels = kWidth * kHeight / 2.0;
  const double mean = sum / kPixels;
  // Even over 0..255: mean 127.5, sigma 73.9; of 1200 pixels sigma of the mean is 2.1.
  EXPECT_NEAR(mean, 127.5, 8.0);
  EXPECT_NEAR(squares / kPixels - mean * mean, 73.9 * 73.9, 600.0);
}

TEST(DisturbLines, HitsTheShareOfTheLinesWithinTheAmplitude) {
  Frame frame;
  Dice dice(5);

  disturb_lines(frame.odd(), 0.4, 50.0, dice);

  EXPECT_EQ(frame.changed(0), 0);
  int hit = 0;
  for (int line = 1; line < kHeight; line += 2) {
    const auto pixels = frame.line(line);
    const auto [least, most] = std::minmax_element(pixels.begin(), pixels.end());
    hit += *least != 100 || *most != 100 ? 1 : 0;
    EXPECT_GE(*least, 50);
    EXPECT_LE(*most, 150);
    EXPECT_TRUE(*least == 100 || *most == 100 || (*least < 100) == (*most < 100))
        << "a line goes one way";
  }
  EXPECT_GE(hit, 5);  // 12 of 30 expected, sigma 2.7
  EXPECT_LE(hit, 20);
}

TEST(DisturbLines, StaysInTheRangeOfGrey) {
  Frame frame;
  Dice dice(5);

  disturb_lines(frame.odd(), 1.0, 255.0, dice);

  int black = 0;
  int white = 0;
  for (int line = 1; line < kHeight; line += 2) {
    black += frame.line(line).front() == 0 ? 1 : 0;
    white += frame.line(line).front() == 255 ? 1 : 0;
  }
  EXPECT_GT(black, 0);
  EXPECT_GT(white, 0);
}

TEST(SaltAndPepper, HitsTheShareOfThePixelsHalfWhiteHalfBlack) {
  Frame frame;
  Dice dice(5);

  salt_and_pepper(frame.odd(), 0.1, dice);

  EXPECT_EQ(frame.changed(0), 0);
  int white = 0;
  int black = 0;
  for (const std::uint8_t grey : frame.pixels) {
    white += grey == 255 ? 1 : 0;
    black += grey == 0 ? 1 : 0;
    EXPECT_TRUE(grey == 0 || grey == 100 || grey == 255);
  }
  // 120 throws, of which a few hit the same pixel.
  EXPECT_GE(white + black, 100);
  EXPECT_LE(white + black, 120);
  EXPECT_GT(white, 35);
  EXPECT_GT(black, 35);
}

}  // namespace
}  // namespace tubesight::drivers
