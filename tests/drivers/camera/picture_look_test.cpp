#include "drivers/camera/picture_look.h"

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kWidth = 320;
constexpr std::int32_t kLines = 240;
using Grey = std::function<double(std::int32_t u, std::int32_t v)>;

Look look_of(const Grey& grey) {
  std::vector<std::uint8_t> pixels;
  for (std::int32_t v = 0; v < kLines; ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      pixels.push_back(static_cast<std::uint8_t>(std::clamp(grey(u, v), 0.0, 255.0)));
    }
  }
  return look_at({pixels.data(), kWidth, kLines, kWidth, 0, 1});
}

TEST(PictureLook, SnowHasNoShape) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> even(0, 255);
  std::normal_distribution<double> bell(120.0, 40.0);
  std::bernoulli_distribution either(0.5);

  EXPECT_EQ(look_of([&](auto, auto) { return even(random); }), Look::kNoise);
  EXPECT_EQ(look_of([&](auto, auto) { return bell(random); }), Look::kNoise);
  EXPECT_EQ(look_of([&](auto, auto) { return either(random) ? 235 : 16; }), Look::kNoise);
}

TEST(PictureLook, ASensorsNoiseIsNoSnow) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 10.0);
  const auto disc = [](std::int32_t u, std::int32_t v) {
    const std::int32_t x = u % 80 - 40;
    const std::int32_t y = v % 80 - 40;
    return x * x + y * y < 900 ? 30.0 : 180.0;
  };

  EXPECT_EQ(look_of([&](auto, auto) { return 40.0 + noise(random); }), Look::kPicture) << "dark";
  EXPECT_EQ(look_of([&](auto u, auto v) { return disc(u, v) + noise(random); }), Look::kPicture);
  EXPECT_EQ(look_of(disc), Look::kPicture);
}

TEST(PictureLook, OneGreyAllOverIsMadeByNoCamera) {
  EXPECT_EQ(look_of([](auto, auto) { return 41; }), Look::kBlank) << "a grabber's blue";
  EXPECT_EQ(look_of([](auto u, auto) { return 128 + u % 3; }), Look::kBlank);
  EXPECT_EQ(look_of([](auto, auto) { return 16; }), Look::kBlack);
  EXPECT_EQ(look_of([](auto, auto) { return 0; }), Look::kBlack);
}

TEST(PictureLook, ABarePictureOfBarsIsLeftToTheTracking) {
  EXPECT_EQ(look_of([](auto u, auto) { return 30 * (u / 40); }), Look::kPicture);
}

TEST(PictureLook, AFieldTooSmallForItIsNotJudged) {
  const std::vector<std::uint8_t> pixels(16 * 16, 41);

  EXPECT_EQ(look_at({pixels.data(), 16, 16, 16, 0, 1}), Look::kPicture);
}

TEST(PictureLook, LooksInsideThePictureAlone) {
  // 17 x 16 pixels in lines of 40 bytes; what lies between the lines is another grey.
  std::vector<std::uint8_t> pixels(40 * 16, 255);
  for (int line = 0; line < 16; ++line) {
    std::fill_n(pixels.begin() + 40 * line, 17, std::uint8_t{41});
  }
  pixels.resize(40 * 15 + 17);

  EXPECT_EQ(look_at({pixels.data(), 17, 16, 40, 0, 1}), Look::kBlank);
}

}  // namespace
}  // namespace tubesight::drivers
