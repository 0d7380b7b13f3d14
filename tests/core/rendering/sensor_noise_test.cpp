#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/drawn_sheet.h"

namespace tubesight::core::rendering {
namespace {

using tests::DrawnSheet;
using Picture = std::vector<std::uint8_t>;

/// A dark picture of level 100 and nothing else, with the noise asked for.
class Noise : public ::testing::Test {
 protected:
  Noise() {
    tests::make_plain(sheet_.scene());
    sheet_.scene().sensor.offset = 100.0;
  }
  Picture draw(std::uint64_t seed = 0) {
    EXPECT_TRUE(sheet_.configure());
    Exposure exposure = sheet_.exposure();
    exposure.lamp = 0.0;
    exposure.noise_seed = seed;
    return sheet_.draw(exposure);
  }
  DrawnSheet sheet_;
};

struct Moments {
  double mean = 0.0;
  double sigma = 0.0;
};

Moments moments(const Picture& picture) {
  double sum = 0.0;
  double sum2 = 0.0;
  for (const std::uint8_t level : picture) {
    sum += level;
    sum2 += static_cast<double>(level) * level;
  }
  const auto count = static_cast<double>(picture.size());
  return {sum / count, std::sqrt(sum2 / count - sum * sum / (count * count))};
}

TEST_F(Noise, OfReadingHasItsSigma) {
  sheet_.scene().sensor.read_noise = 3.0;

  const Moments found = moments(draw());

  // Rounding to whole levels adds a variance of 1 / 12.
  EXPECT_NEAR(found.mean, 100.0, 0.05);
  EXPECT_NEAR(found.sigma, std::sqrt(9.0 + 1.0 / 12.0), 0.03);
}

TEST_F(Noise, OfNeighboursAndOfLinesIsIndependent) {
  sheet_.scene().sensor.read_noise = 4.0;
  const Picture picture = draw();
  const Picture later = draw(1);

  const auto correlation = [&](const Picture& other, std::size_t shift) {
    double sum = 0.0;
    for (std::size_t i = 0; i + shift < picture.size(); ++i) {
      sum += (picture[i] - 100.0) * (other[i + shift] - 100.0);
    }
    return sum / static_cast<double>(picture.size()) / 16.0;
  };

  EXPECT_NEAR(correlation(picture, 1), 0.0, 0.02);
  EXPECT_NEAR(correlation(picture, 635), 0.0, 0.02);
  EXPECT_NEAR(correlation(picture, 636), 0.0, 0.02);
  EXPECT_NEAR(correlation(later, 0), 0.0, 0.02);
}

TEST_F(Noise, OfLightGrowsWithItsRoot) {
  sheet_.scene().sensor.shot_noise = 0.5;
  sheet_.scene().lamp.ring_radius_mm = 1.0;
  sheet_.scene().guidetube.radius_mm = 0.0;
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  exposure.lamp = 0.3;
  // A square of plate between four tubes, many times; 8 pixels a side.
  const auto pixel =
      sheet_.truth().image_of(exposure.opened, {60 * 25.4 + 12.7, 39 * 25.4 + 12.7, 0.0});
  ASSERT_TRUE(pixel.has_value());
  double variance = 0.0;
  double level = 0.0;
  std::vector<Picture> pictures;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    exposure.noise_seed = seed;
    pictures.push_back(sheet_.draw(exposure));
  }
  int count = 0;
  for (int v = -3; v <= 3; ++v) {
    for (int u = -3; u <= 3; ++u, ++count) {
      const int line = static_cast<int>((*pixel)[1]) + v;
      const int column = static_cast<int>((*pixel)[0]) + u;
      double sum = 0.0;
      double sum2 = 0.0;
      for (const Picture& picture : pictures) {
        const double value = picture[static_cast<std::size_t>(line * 635 + column)];
        sum += value;
        sum2 += value * value;
      }
      level += sum / 60.0 - 100.0;
      variance += (sum2 - sum * sum / 60.0) / 59.0;
    }
  }
  level /= count;
  variance /= count;

  ASSERT_GT(level, 30.0);
  // 49 squares times 59 degrees of freedom: the variance is known to 3 %.
  EXPECT_NEAR(variance, 0.25 * level + 1.0 / 12.0, 0.12 * 0.25 * level);
}

TEST_F(Noise, SaltAndPepperHasItsShare) {
  sheet_.scene().sensor.salt_and_pepper = 0.01;

  const Picture picture = draw();

  const auto white = std::count(picture.begin(), picture.end(), 255);
  const auto black = std::count(picture.begin(), picture.end(), 0);
  const double expected = 0.005 * static_cast<double>(picture.size());
  EXPECT_NEAR(static_cast<double>(white), expected, 0.1 * expected);
  EXPECT_NEAR(static_cast<double>(black), expected, 0.1 * expected);
}

TEST_F(Noise, InterferenceTakesWholeLines) {
  sheet_.scene().sensor.emi_share = 0.25;
  sheet_.scene().sensor.emi_amplitude = 30.0;

  const Picture picture = draw();

  int lines = 0;
  for (int v = 0; v < 480; ++v) {
    const auto* line = picture.data() + v * 635;
    const auto [least, most] = std::minmax_element(line, line + 635);
    const bool struck = *least != 100 || *most != 100;
    lines += struck ? 1 : 0;
    if (struck) {
      EXPECT_NEAR(*most, 130, 1);
      EXPECT_NEAR(*least, 70, 1);
    }
  }
  EXPECT_NEAR(lines, 120, 40);
}

TEST_F(Noise, NothingExceedsSaturation) {
  sheet_.scene().sensor.read_noise = 20.0;
  sheet_.scene().sensor.saturation = 120.0;

  const Picture picture = draw();

  EXPECT_EQ(*std::max_element(picture.begin(), picture.end()), 120);
}

TEST_F(Noise, FaultsTakeTheSignalAway) {
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  exposure.gain = 0.0;
  exposure.offset = 4.0;
  const Picture black = sheet_.draw(exposure);
  EXPECT_EQ(*std::max_element(black.begin(), black.end()), 4);
  exposure.offset = 255.0;
  const Picture white = sheet_.draw(exposure);
  EXPECT_EQ(*std::min_element(white.begin(), white.end()), 255);
  exposure.offset = 128.0;
  exposure.extra_noise = 10.0;
  EXPECT_NEAR(moments(sheet_.draw(exposure)).sigma, 10.0, 0.1);
}

}  // namespace
}  // namespace tubesight::core::rendering
