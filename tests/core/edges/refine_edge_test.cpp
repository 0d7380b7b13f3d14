#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/edges/edge_search.h"
#include "tests/core/edges/picture.h"

namespace tubesight::core::edges {
namespace {

double pixels(std::int32_t q16) { return static_cast<double>(q16) / 65536.0; }

// Finds and places the edge of a row of pixels from `first` on.
Edge edge_from(const Picture& picture, std::int32_t first, std::int32_t direction,
               std::int32_t taps = kHorizontalTaps) {
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);
  const EdgePeak peak = find_edge(path, {first, direction, 30, taps, 200});
  return peak.found ? refine_edge(path, peak, direction, EdgeReach{}, 8) : Edge{};
}

// Linear interpolation of a Gaussian step of sigma 0.8 is worst with the step 0.22 px behind a
// pixel: (0.5 - Phi(-0.275)) / (Phi(0.975) - Phi(-0.275)) = 0.1083 / 0.4435 = 0.244, 0.024 px off.
// Half a grey level of rounding in 62 a pixel adds 0.008 px.
constexpr double kWorst = 0.033;

TEST(RefineEdge, PlacesABlurredStepToAThirtiethOfAPixel) {
  double worst = 0.0;
  for (const double sigma : {0.8, 1.0, 1.3}) {
    for (int i = 0; i < 50; ++i) {
      const double truth = 50.0 + i * 0.02;
      Picture picture(100, 3);
      picture.draw([&](double u, double) { return 20.0 + 140.0 * blurred_step(u - truth, sigma); });

      const Edge edge = edge_from(picture, 35, 1);

      ASSERT_TRUE(edge.found) << truth;
      worst = std::max(worst, std::abs(pixels(edge.position_q16) - truth));
      EXPECT_NEAR(edge.contrast, 140, 2) << truth;
    }
  }
  EXPECT_LT(worst, kWorst);
}

TEST(RefineEdge, IsTheSameWalkingLeft) {
  for (int i = 0; i < 50; ++i) {
    const double truth = 50.0 + i * 0.02;
    Picture picture(100, 3);
    picture.draw([&](double u, double) { return 20.0 + 140.0 * blurred_step(truth - u, 0.9); });

    const Edge edge = edge_from(picture, 65, -1);

    ASSERT_TRUE(edge.found) << truth;
    EXPECT_NEAR(pixels(edge.position_q16), truth, kWorst);
  }
}

TEST(RefineEdge, InterpolatesBetweenTwoPixelsByHand) {
  // 10 10 ... 10 | 40 | 110 110 ...: the middle 60 lies (60 - 40) / (110 - 40) behind the 40.
  Picture picture(100, 3);
  picture.draw([](double u, double) { return u < 50.0 ? 10.0 : (u < 51.0 ? 40.0 : 110.0); });

  const Edge edge = edge_from(picture, 35, 1);

  ASSERT_TRUE(edge.found);
  EXPECT_NEAR(pixels(edge.position_q16), 50.0 + 20.0 / 70.0, 1.0 / 65536.0);
  EXPECT_EQ(edge.contrast, 100);
}

TEST(RefineEdge, TakesTheInnerRiseOfAFilletAndNotTheOneBehindItsShadow) {
  // Dark inside, four bright pixels of rim, six of shadow, then sheet.
  Picture picture(100, 3);
  const auto grey = [](double u) {
    return 15.0 + 195.0 * blurred_step(u - 50.3, 0.7) - 170.0 * blurred_step(u - 54.3, 0.7) +
           100.0 * blurred_step(u - 60.3, 0.7);
  };
  picture.draw([&](double u, double) { return grey(u); });

  const Edge edge = edge_from(picture, 40, 1, 4);

  ASSERT_TRUE(edge.found);
  EXPECT_NEAR(pixels(edge.position_q16), 50.3, 0.05);
  EXPECT_GT(edge.contrast, 150);
}

TEST(RefineEdge, RefusesLittleContrast) {
  Picture picture(100, 3);
  picture.draw([](double u, double) { return u < 50.0 ? 20.0 : 40.0; });
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);
  const EdgePeak peak = find_edge(path, {35, 1, 30, kHorizontalTaps, 100});
  ASSERT_TRUE(peak.found);

  EXPECT_TRUE(refine_edge(path, peak, 1, EdgeReach{}, 20).found);
  EXPECT_FALSE(refine_edge(path, peak, 1, EdgeReach{}, 21).found);
}

TEST(RefineEdge, RefusesARiseThatDoesNotComeFromTheDark) {
  // The peak is claimed where it is bright already: no crossing of the middle from below.
  Picture picture(100, 3);
  picture.draw([](double u, double) { return u < 46.0 ? 90.0 : (u < 52.0 ? 10.0 : 120.0); });
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);

  // Dark level read at 45 and 44 (90 each) for a peak at 49: the path goes down before it rises.
  const Edge edge = refine_edge(path, {true, 49, 600}, 1, EdgeReach{4, 4}, 8);

  // From 90 the middle between 90 and 120 is crossed upwards at 52 only.
  ASSERT_TRUE(edge.found);
  EXPECT_GT(pixels(edge.position_q16), 51.0);
  EXPECT_FALSE(refine_edge(path, {true, 49, 600}, -1, EdgeReach{4, 4}, 8).found);
}

TEST(RefineEdge, StaysWithinATenthOfAPixelUnderReadNoise) {
  // Standard deviation 3 of 140 grey levels: about 3 / slope of 70 a pixel = 0.04 px an edge.
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 3.0);
  double squares = 0.0;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    const double truth = 50.0 + (i % 50) * 0.02;
    Picture picture(100, 3);
    picture.draw([&](double u, double) {
      return 20.0 + 140.0 * blurred_step(u - truth, 0.9) + noise(random);
    });
    const Edge edge = edge_from(picture, 35, 1);
    ASSERT_TRUE(edge.found);
    const double off = pixels(edge.position_q16) - truth;
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / kTrials), 0.1);
}

TEST(RefineEdge, ReadsNoFartherThanItsReach) {
  // Peak at 5: dark pixels 0 and 1, bright ones up to 10. Eleven pixels in all.
  Picture picture(11, 3);
  picture.draw([](double u, double) { return u < 6.0 ? 10.0 : 110.0; });
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);

  EXPECT_TRUE(refine_edge(path, {true, 5, 600}, 1, EdgeReach{4, 4}, 8).found);
  picture.draw([](double u, double) { return u > 4.0 ? 10.0 : 110.0; });
  EXPECT_TRUE(refine_edge(path, {true, 5, 600}, -1, EdgeReach{4, 4}, 8).found);
  picture.draw([](double, double) { return 10.0; });
  EXPECT_FALSE(refine_edge(path, {true, 5, 600}, 1, EdgeReach{4, 4}, 8).found);
}

// At every third pixel, as in a picture three times larger.
Edge coarse_edge_from(const Picture& picture, std::int32_t first, std::int32_t direction) {
  constexpr std::int32_t kStep = 3;
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);
  const EdgePath readings = every(path, kStep, first % kStep);
  const EdgePeak peak = find_edge(readings, {first / kStep, direction, 30, kHorizontalTaps, 200});
  const EdgePeak there{true, peak.position * kStep + first % kStep, peak.gradient};
  return peak.found ? refine_edge_coarsely(path, there, direction, EdgeReach{12, 12}, kStep, 8)
                    : Edge{};
}

TEST(RefineEdgeCoarsely, PlacesASharpStepAsWellAsAFineLook) {
  for (const std::int32_t direction : {1, -1}) {
    for (int i = 0; i < 50; ++i) {
      const double truth = 150.0 + i * 0.07;
      Picture picture(300, 3);
      picture.draw([&](double u, double) {
        return 20.0 + 140.0 * blurred_step(direction * (u - truth), 0.9);
      });

      const Edge edge = coarse_edge_from(picture, 150 - direction * 45 + i % 3, direction);

      ASSERT_TRUE(edge.found) << truth;
      EXPECT_NEAR(pixels(edge.position_q16), truth, kWorst);
      EXPECT_NEAR(edge.contrast, 140, 2) << truth;
    }
  }
}

TEST(RefineEdgeCoarsely, PlacesASmearThatAFineLookTakesForNoise) {
  // From dark to bright in 40 px: 2.5 grey levels a pixel, 20 of 100 within a fine look's reach.
  const auto smear = [](double u) { return 20.0 + std::clamp(2.5 * (u - 130.0), 0.0, 100.0); };
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 2.0);
  double fine2 = 0.0;
  double coarse2 = 0.0;
  for (int i = 0; i < 100; ++i) {
    Picture picture(300, 3);
    picture.draw([&](double u, double) { return smear(u) + noise(random); });
    const Edge fine = edge_from(picture, 115, 1);
    const Edge coarse = coarse_edge_from(picture, 105, 1);
    ASSERT_TRUE(coarse.found);
    coarse2 += std::pow(pixels(coarse.position_q16) - 150.0, 2);
    fine2 += fine.found ? std::pow(pixels(fine.position_q16) - 150.0, 2) : 400.0;
  }
  EXPECT_LT(coarse2, fine2 / 2.0);
}

TEST(RefineEdgeCoarsely, ReadsNoFartherThanItsReach) {
  // Peak at 13: dark pixels 0 and 1, bright ones up to 29. Thirty pixels in all.
  Picture picture(30, 3);
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);

  picture.draw([](double u, double) { return u < 14.0 ? 10.0 : 110.0; });
  EXPECT_TRUE(refine_edge_coarsely(path, {true, 13, 600}, 1, EdgeReach{12, 12}, 3, 8).found);
  picture.draw([](double, double) { return 10.0; });
  EXPECT_FALSE(refine_edge_coarsely(path, {true, 13, 600}, 1, EdgeReach{12, 12}, 3, 8).found);
}

}  // namespace
}  // namespace tubesight::core::edges
