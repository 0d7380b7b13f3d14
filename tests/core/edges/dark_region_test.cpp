#include "core/edges/dark_region.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/core/edges/picture.h"

namespace tubesight::core::edges {
namespace {

double pixels(std::int32_t q16) { return static_cast<double>(q16) / 65536.0; }

DarkRegion region_at(const Picture& picture, Parity parity, std::int32_t u, std::int32_t v,
                     std::int32_t reach = 60) {
  DynamicThreshold threshold(200);
  return find_dark_region(picture.field(parity), u, v, reach, threshold);
}

class DarkRegionOnField : public ::testing::TestWithParam<Parity> {};

INSTANTIATE_TEST_SUITE_P(AllFields, DarkRegionOnField,
                         ::testing::Values(Parity::kEven, Parity::kOdd, Parity::kProgressive),
                         [](const auto& instance) {
                           return instance.param == Parity::kEven  ? "Even"
                                  : instance.param == Parity::kOdd ? "Odd"
                                                                   : "Progressive";
                         });

TEST_P(DarkRegionOnField, IsBisectedToTheCentreOfADisc) {
  for (int i = 0; i < 20; ++i) {
    Ellipse disc;
    disc.u = 70.0 + 0.13 * i;
    disc.v = 60.0 + 0.21 * i;
    disc.half_u = 25.0;
    disc.half_v = 25.0;
    Picture picture(160, 128);
    picture.draw(disc);

    // Anywhere in the dark up to 60 % of the radius off.
    const auto u = static_cast<std::int32_t>(disc.u + 14.0 * std::cos(i));
    const auto v = static_cast<std::int32_t>(disc.v + 14.0 * std::sin(i));
    const DarkRegion region = region_at(picture, GetParam(), u, v);

    ASSERT_TRUE(region.found) << "disc " << i;
    // Both ends of a chord are off alike; a line of a field is two pixels high.
    EXPECT_NEAR(pixels(region.center_u_q16()), disc.u, 0.15) << "disc " << i;
    EXPECT_NEAR(pixels(region.center_v_q16()), disc.v, 0.25) << "disc " << i;
    // Second vertical chord: through the centre. Horizontal one: through the first chord's middle.
    EXPECT_NEAR(pixels(region.height_q16()), 50.0, 0.6) << "disc " << i;
    EXPECT_NEAR(pixels(region.width_q16()), 50.0, 0.6) << "disc " << i;
  }
}

TEST_P(DarkRegionOnField, HasTheSidesOfAnEllipse) {
  Ellipse ellipse;
  ellipse.u = 80.3;
  ellipse.v = 63.6;
  ellipse.half_u = 30.0;
  ellipse.half_v = 18.0;
  Picture picture(160, 128);
  picture.draw(ellipse);

  const DarkRegion region = region_at(picture, GetParam(), 70, 70);

  ASSERT_TRUE(region.found);
  EXPECT_NEAR(pixels(region.left_q16), 50.3, 0.4);
  EXPECT_NEAR(pixels(region.right_q16), 110.3, 0.4);
  EXPECT_NEAR(pixels(region.top_q16), 45.6, 0.4);
  EXPECT_NEAR(pixels(region.bottom_q16), 81.6, 0.4);
}

TEST_P(DarkRegionOnField, IsTheSameInAPictureThreeTimesLargerReadAtEveryThirdPixel) {
  for (int i = 0; i < 12; ++i) {
    Ellipse disc;
    disc.u = 210.0 + 0.37 * i;
    disc.v = 180.0 + 0.61 * i;
    disc.half_u = 75.0;
    disc.half_v = 75.0;
    Picture picture(480, 384);
    picture.draw(disc);
    DynamicThreshold threshold(200);

    const DarkRegion region =
        find_dark_region(picture.field(GetParam()), static_cast<std::int32_t>(disc.u) + 40 - i,
                         static_cast<std::int32_t>(disc.v) - 30 + i, 180, threshold, 3);

    ASSERT_TRUE(region.found) << "disc " << i;
    EXPECT_NEAR(pixels(region.center_u_q16()), disc.u, 0.6) << "disc " << i;
    EXPECT_NEAR(pixels(region.center_v_q16()), disc.v, 0.75) << "disc " << i;
    EXPECT_NEAR(pixels(region.height_q16()), 150.0, 1.8) << "disc " << i;
    EXPECT_NEAR(pixels(region.width_q16()), 150.0, 1.8) << "disc " << i;
  }
}

TEST(FindDarkRegion, FindsADimEdgeAfterHalvingTheThreshold) {
  Ellipse disc;
  disc.u = 80.0;
  disc.v = 64.0;
  disc.half_u = 24.0;
  disc.half_v = 24.0;
  disc.bright = 34.0;  // 14 grey levels: 168 under Eq. 6.1, below the first threshold of 800
  Picture picture(160, 128);
  picture.draw(disc);
  DynamicThreshold threshold(800);

  const DarkRegion region =
      find_dark_region(picture.field(Parity::kProgressive), 75, 60, 60, threshold);

  ASSERT_TRUE(region.found);
  EXPECT_NEAR(pixels(region.center_u_q16()), 80.0, 0.8);
  EXPECT_NEAR(pixels(region.center_v_q16()), 64.0, 0.8);
  // 75 % of what such an edge gives at most.
  EXPECT_LE(threshold.for_taps(6), 168 * 3 / 4);
}

TEST(FindDarkRegion, SurvivesSaltNoise) {
  std::mt19937 random(12);
  int right = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Ellipse disc;
    disc.u = 80.0;
    disc.v = 64.0;
    disc.half_u = 25.0;
    disc.half_v = 25.0;
    Picture picture(160, 128);
    picture.draw(disc);
    for (std::int32_t i = 0; i < 160 * 128 / 500; ++i) {
      picture.at(static_cast<std::int32_t>(random() % 160),
                 static_cast<std::int32_t>(random() % 128)) = 255;
    }
    const DarkRegion region = region_at(picture, Parity::kProgressive, 78, 66);
    right += region.found && std::abs(pixels(region.center_u_q16()) - 80.0) < 1.0 &&
                     std::abs(pixels(region.center_v_q16()) - 64.0) < 1.0
                 ? 1
                 : 0;
  }
  // A white pixel on one of the six paths inside the disc is taken for an edge: about one in five.
  EXPECT_GE(right, 60);
}

TEST(FindDarkRegion, FailsWhereAnEdgeIsMissing) {
  const auto missing_side = [](double left, double top, double right, double bottom) {
    Picture picture(160, 128);
    picture.draw([=](double u, double v) {
      return u > left && u < right && v > top && v < bottom ? 20.0 : 160.0;
    });
    return region_at(picture, Parity::kProgressive, 80, 64, 200);
  };
  EXPECT_TRUE(missing_side(50, 40, 110, 90).found);
  EXPECT_FALSE(missing_side(-1, 40, 110, 90).found) << "open to the left";
  EXPECT_FALSE(missing_side(50, -1, 110, 90).found) << "open to the top";
  EXPECT_FALSE(missing_side(50, 40, 161, 90).found) << "open to the right";
  EXPECT_FALSE(missing_side(50, 40, 110, 129).found) << "open to the bottom";
}

TEST(FindDarkRegion, DoesNotGoBeyondItsReach) {
  Picture picture(160, 128);
  picture.draw([](double u, double v) {
    return std::abs(u - 80.0) < 50.0 && std::abs(v - 64.0) < 20.0 ? 20.0 : 160.0;
  });

  EXPECT_FALSE(region_at(picture, Parity::kProgressive, 80, 64, 40).found);
  EXPECT_TRUE(region_at(picture, Parity::kProgressive, 80, 64, 55).found);
}

TEST(FindDarkRegion, SaysNoOnAnEvenSurface) {
  const Picture picture(160, 128, 100);
  EXPECT_FALSE(region_at(picture, Parity::kEven, 80, 64).found);
}

TEST(FindDarkRegion, RefusesPointsOutsideAndPicturesTooSmall) {
  const Picture picture(160, 128, 100);
  for (const auto& [u, v] : {std::pair{-1, 50}, {160, 50}, {50, -3}, {50, 128}}) {
    EXPECT_FALSE(region_at(picture, Parity::kProgressive, u, v).found) << u << ", " << v;
    EXPECT_FALSE(region_at(picture, Parity::kOdd, u, v).found) << u << ", " << v;
  }
  const Picture narrow(31, 128, 100);
  EXPECT_FALSE(region_at(narrow, Parity::kEven, 10, 50).found);
  const Picture flat(160, 15, 100);
  EXPECT_FALSE(region_at(flat, Parity::kProgressive, 80, 7).found);
}

TEST(FindDarkRegion, StaysInThePictureFromEveryPixelOfIt) {
  // Discs that the borders cut, from every start, on every field: nothing is read beside the
  // picture (the address sanitizer's part), and what is found lies in it.
  Picture picture(64, 48);
  picture.draw([](double u, double v) {
    const double du = std::fmod(u + 12.0, 24.0) - 12.0;
    const double dv = std::fmod(v + 12.0, 24.0) - 12.0;
    return du * du + dv * dv < 64.0 ? 20.0 : 160.0;
  });
  int found = 0;
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    for (std::int32_t v = 0; v < 48; ++v) {
      for (std::int32_t u = 0; u < 64; ++u) {
        const DarkRegion region = region_at(picture, parity, u, v, 100);
        if (region.found) {
          ++found;
          EXPECT_GE(region.left_q16, 0);
          EXPECT_LE(pixels(region.right_q16), 63.0);
          EXPECT_GE(region.top_q16, 0);
          EXPECT_LE(pixels(region.bottom_q16), 47.0);
        }
      }
    }
  }
  EXPECT_GT(found, 100);
}

TEST(CrossHairMean, AveragesSixteenPixelsByHand) {
  // Arms of 8 columns and 8 frame lines: columns ±2, ±4, ±6, ±8; lines of the field ±1 to ±4.
  Picture picture(60, 60, 10);
  for (const std::int32_t u : {22, 24, 26, 28, 32, 34, 36, 38}) {
    picture.at(u, 30) = 50;
  }
  for (const std::int32_t v : {22, 24, 26, 28, 32, 34, 36, 38}) {
    picture.at(30, v) = 90;
  }
  // (8 * 50 + 8 * 90) / 16.
  EXPECT_EQ(cross_hair_mean(picture.field(Parity::kEven), 30, 30, 8, 8), 70);
}

TEST(CrossHairMean, ReadsTheFieldsOwnLines) {
  Picture picture(60, 60);
  picture.draw([](double, double v) { return static_cast<int>(v) % 2 == 0 ? 200.0 : 40.0; });

  EXPECT_EQ(cross_hair_mean(picture.field(Parity::kEven), 30, 30, 8, 8), 200);
  EXPECT_EQ(cross_hair_mean(picture.field(Parity::kOdd), 30, 31, 8, 8), 40);
}

TEST(CrossHairMean, CutsArmsOffAtTheBorder) {
  // At the corner the arms to the left and up read column 0 and line 0 again and again.
  Picture picture(40, 40, 16);
  picture.at(0, 0) = 216;

  // 8 of 16 pixels read 216, the others 16.
  EXPECT_EQ(cross_hair_mean(picture.field(Parity::kProgressive), 0, 0, 8, 8), 116);
  for (std::int32_t v = -50; v < 90; v += 7) {
    for (std::int32_t u = -50; u < 90; u += 7) {
      const std::int32_t mean = cross_hair_mean(picture.field(Parity::kOdd), u, v, 20, 20);
      EXPECT_GE(mean, 16);
      EXPECT_LE(mean, 216);
    }
  }
}

TEST(CrossHair, IsBlankWhereItIsOneGreyValueAloneButWhite) {
  Picture picture(60, 60, 150);
  const auto look = [&] {
    return look_at_cross_hair(picture.field(Parity::kEven), 30, 30, 8, 8, 149);
  };
  EXPECT_TRUE(look().blank);
  EXPECT_EQ(look().mean, 150);
  EXPECT_EQ(look().dark, 0);
  picture.at(30, 22) = 149;
  EXPECT_FALSE(look().blank);
  EXPECT_EQ(look().dark, 1);
  EXPECT_FALSE(look_at_cross_hair(Picture(60, 60, 255).field(Parity::kEven), 30, 30, 8, 8).blank);
}

}  // namespace
}  // namespace tubesight::core::edges
