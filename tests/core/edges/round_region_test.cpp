#include "core/edges/round_region.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/core/edges/picture.h"

namespace tubesight::core::edges {
namespace {

double pixels(std::int32_t q16) { return static_cast<double>(q16) / 65536.0; }

// A tube-end of 32 by 24 pixels, and how circles look beside it.
Ellipse tube_end() {
  Ellipse ellipse;
  ellipse.u = 101.0;
  ellipse.v = 90.0;
  ellipse.half_u = 32.0;
  ellipse.half_v = 24.0;
  return ellipse;
}
constexpr CircleShape kShape{65536, 0, 0, 65536 * 3 / 4};

RoundRegion region_at(const Picture& picture, std::int32_t u, std::int32_t v,
                      Parity parity = Parity::kEven) {
  return find_round_region(picture.field(parity), u, v, kShape, 80);
}

void expect_tube_end(const RoundRegion& region, double within_px) {
  const Ellipse truth = tube_end();
  ASSERT_TRUE(region.found);
  EXPECT_NEAR(pixels(region.center_u_q16), truth.u, within_px);
  EXPECT_NEAR(pixels(region.center_v_q16), truth.v, within_px);
  EXPECT_NEAR(pixels(region.width_q16), 2 * truth.half_u, 2 * within_px);
  EXPECT_NEAR(pixels(region.height_q16), 2 * truth.half_v, 2 * within_px);
}

void fill(Picture& picture, double u, double v, double radius, int grey) {
  for (std::int32_t y = 0; y < picture.height_px(); ++y) {
    for (std::int32_t x = 0; x < picture.width_px(); ++x) {
      if (std::hypot(x - u, y - v) < radius) {
        picture.at(x, y) = static_cast<std::uint8_t>(grey);
      }
    }
  }
}

TEST(FindRoundRegion, FindsTheCircleFromAPlaceUpTo60PercentOff) {
  Picture picture(200, 180);
  picture.draw(tube_end());
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    for (int i = 0; i < 8; ++i) {
      const auto u = static_cast<std::int32_t>(101.0 + 19.0 * std::cos(i));
      const auto v = static_cast<std::int32_t>(90.0 + 14.0 * std::sin(i));
      const RoundRegion region = region_at(picture, u, v, parity);
      expect_tube_end(region, 1.0);
      EXPECT_NEAR(region.inside, 20, 8);
      EXPECT_NEAR(region.outside, 160, 8);
    }
  }
}

TEST(FindRoundRegion, FindsItInATurnedShape) {
  Ellipse disc = tube_end();
  disc.half_v = disc.half_u;
  Picture picture(200, 180);
  picture.draw(disc);
  const CircleShape turned{46341, 46341, -46341, 46341};
  const RoundRegion region =
      find_round_region(picture.field(Parity::kProgressive), 110, 80, turned, 80);
  ASSERT_TRUE(region.found);
  EXPECT_NEAR(pixels(region.center_u_q16), disc.u, 0.7);
  EXPECT_NEAR(pixels(region.center_v_q16), disc.v, 0.7);
  EXPECT_NEAR(pixels(region.width_q16), 64.0, 1.0);
  EXPECT_NEAR(pixels(region.height_q16), 64.0, 1.0);
}

TEST(FindRoundRegion, IsNotMisledBySaltAndPepper) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    Picture picture(200, 180);
    picture.draw(tube_end());
    std::mt19937 random(seed);
    for (std::int32_t i = 0; i < 200 * 180 / 20; ++i) {
      picture.at(static_cast<std::int32_t>(random() % 200),
                 static_cast<std::int32_t>(random() % 180)) = (random() & 1U) != 0U ? 255 : 0;
    }
    expect_tube_end(region_at(picture, 95, 95), 1.5);
  }
}

TEST(FindRoundRegion, IsNotMisledByABlotOrASpotOverAThirdOfTheRim) {
  for (const int grey : {12, 255}) {
    for (int i = 0; i < 12; ++i) {
      Picture picture(200, 180);
      picture.draw(tube_end());
      const double angle = i * 0.5236;
      fill(picture, 101.0 + 32.0 * std::cos(angle), 90.0 + 24.0 * std::sin(angle), 16.0, grey);
      expect_tube_end(region_at(picture, 101, 90), 2.0);
    }
  }
}

TEST(FindRoundRegion, IsNotMisledByAGhost) {
  Picture picture(200, 180);
  Ellipse ghost = tube_end();
  ghost.u += 30.0;
  picture.draw([&](double u, double v) { return 0.7 * tube_end()(u, v) + 0.3 * ghost(u, v); });
  expect_tube_end(region_at(picture, 95, 95), 1.0);
}

TEST(FindRoundRegion, FindsNothingOnPlateOrOnWhatIsNotRound) {
  Picture picture(200, 180, 150);
  EXPECT_FALSE(region_at(picture, 100, 90).found);
  // Beside a tube-end, and in the middle of four.
  picture.draw(tube_end());
  EXPECT_FALSE(region_at(picture, 145, 90).found);
  picture.draw([](double u, double v) {
    double grey = 160.0;
    for (const auto& [x, y] :
         {std::pair{50.0, 40.0}, {150.0, 40.0}, {50.0, 140.0}, {150.0, 140.0}}) {
      grey = std::hypot(u - x, v - y) < 36.0 ? 20.0 : grey;
    }
    return grey;
  });
  EXPECT_FALSE(region_at(picture, 100, 90).found);
  // A dark stripe, and a wedge.
  picture.draw([](double, double v) { return v > 70.0 && v < 110.0 ? 20.0 : 160.0; });
  EXPECT_FALSE(region_at(picture, 100, 90).found);
  picture.draw([](double u, double v) { return u > 60.0 && v > 60.0 ? 20.0 : 160.0; });
  EXPECT_FALSE(region_at(picture, 100, 90).found);
}

TEST(FindRoundRegion, StaysInThePictureFromEveryPixelOfIt) {
  Picture picture(40, 32);
  picture.fill_random(3);
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    for (std::int32_t v = -1; v <= 32; v += 3) {
      for (std::int32_t u = -1; u <= 40; u += 3) {
        static_cast<void>(find_round_region(picture.field(parity), u, v, kShape, 1000));
      }
    }
  }
}

}  // namespace
}  // namespace tubesight::core::edges
