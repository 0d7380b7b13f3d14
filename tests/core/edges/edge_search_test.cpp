#include "core/edges/edge_search.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/core/edges/picture.h"

namespace tubesight::core::edges {
namespace {

// Eq. 6.1, written out as the source has it.
std::int32_t equation_6_1(const Picture& p, std::int32_t u, std::int32_t v) {
  return p.I(u + 1, v + 2) + p.I(u + 2, v + 2) + p.I(u + 3, v + 2) + p.I(u + 4, v + 2) +
         p.I(u + 5, v + 2) + p.I(u + 6, v + 2) - p.I(u - 1, v + 2) - p.I(u - 2, v + 2) -
         p.I(u - 3, v + 2) - p.I(u - 4, v + 2) - p.I(u - 5, v + 2) - p.I(u - 6, v + 2) +
         p.I(u + 1, v - 2) + p.I(u + 2, v - 2) + p.I(u + 3, v - 2) + p.I(u + 4, v - 2) +
         p.I(u + 5, v - 2) + p.I(u + 6, v - 2) - p.I(u - 1, v - 2) - p.I(u - 2, v - 2) -
         p.I(u - 3, v - 2) - p.I(u - 4, v - 2) - p.I(u - 5, v - 2) - p.I(u - 6, v - 2);
}

// Eq. 6.2, written out as the source has it.
std::int32_t equation_6_2(const Picture& p, std::int32_t u, std::int32_t v) {
  return p.I(u + 2, v + 2) + p.I(u + 2, v + 4) + p.I(u + 2, v + 6) - p.I(u + 2, v - 2) -
         p.I(u + 2, v - 4) - p.I(u + 2, v - 6) + p.I(u - 2, v + 2) + p.I(u - 2, v + 4) +
         p.I(u - 2, v + 6) - p.I(u - 2, v - 2) - p.I(u - 2, v - 4) - p.I(u - 2, v - 6);
}

class GradientOnField : public ::testing::TestWithParam<Parity> {};

INSTANTIATE_TEST_SUITE_P(BothFields, GradientOnField,
                         ::testing::Values(Parity::kEven, Parity::kOdd), [](const auto& instance) {
                           return instance.param == Parity::kEven ? "Even" : "Odd";
                         });

TEST_P(GradientOnField, IsEquation61AlongALine) {
  Picture picture(48, 30);
  picture.fill_random(61);
  const FieldView field = picture.field(GetParam());

  for (std::int32_t line = 1; line < field.lines - 1; ++line) {
    const EdgePath path = horizontal_path(field, line);
    const std::int32_t v = field.first_line + 2 * line;
    for (std::int32_t u = 6; u < 42; ++u) {
      const std::int32_t expected = equation_6_1(picture, u, v);
      ASSERT_EQ(gradient(path, u, 1, kHorizontalTaps), expected) << u << ", " << v;
      ASSERT_EQ(gradient(path, u, -1, kHorizontalTaps), -expected) << u << ", " << v;
    }
  }
}

TEST_P(GradientOnField, IsEquation62DownAColumn) {
  Picture picture(48, 30);
  picture.fill_random(62);
  const FieldView field = picture.field(GetParam());

  for (std::int32_t u = 2; u < 46; ++u) {
    const EdgePath path = vertical_path(field, u);
    for (std::int32_t line = 3; line < field.lines - 3; ++line) {
      const std::int32_t expected = equation_6_2(picture, u, field.first_line + 2 * line);
      ASSERT_EQ(gradient(path, line, 1, kVerticalTaps), expected) << u << ", " << line;
      ASSERT_EQ(gradient(path, line, -1, kVerticalTaps), -expected) << u << ", " << line;
    }
  }
}

TEST(Gradient, ReachesItsStatedRangeAndNotMore) {
  Picture picture(32, 5);
  picture.draw([](double u, double) { return u > 16.0 ? 255.0 : 0.0; });

  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 2);

  EXPECT_EQ(gradient(path, 16, 1, kHorizontalTaps), 510 * 6);
  EXPECT_EQ(gradient(path, 16, -1, kHorizontalTaps), -510 * 6);
}

// The search as its contract says it, with every gradient summed anew: the greatest gradient at or
// above the threshold, until two positions in a row bring none that is greater.
EdgePeak searched_by_hand(const EdgePath& path, const SearchRange& range) {
  EdgePeak peak;
  int without = 0;
  for (std::int32_t i = 0; i < range.steps; ++i) {
    const std::int32_t position = range.first + range.direction * i;
    const std::int32_t g = gradient(path, position, range.direction, range.taps);
    if (peak.found ? g > peak.gradient : g >= range.threshold) {
      peak = {true, position, g};
      without = 0;
    } else if (peak.found && ++without == 2) {
      break;
    }
  }
  return peak;
}

TEST(FindEdge, GivesWhatSumsMadeAnewGive) {
  Picture picture(192, 40);
  std::mt19937 random(7);
  int found = 0;
  int missed = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    picture.fill_random(seed);
    const FieldView field = picture.field(seed % 2 == 0 ? Parity::kEven : Parity::kOdd);
    for (int i = 0; i < 200; ++i) {
      const bool along = random() % 2 == 0;
      const std::int32_t taps = along ? 4 + static_cast<std::int32_t>(random() % 3) : kVerticalTaps;
      // Large pictures are read in steps of two and three pixels; four is nobody's.
      const std::int32_t step = along ? 1 + static_cast<std::int32_t>(random() % 4) : 1;
      const std::int32_t positions = (along ? 192 : field.lines) / step;
      const EdgePath path =
          along
              ? every(horizontal_path(field, 1 + static_cast<std::int32_t>(random() % 18)), step, 0)
              : vertical_path(field, 2 + static_cast<std::int32_t>(random() % 188));
      SearchRange range;
      range.direction = random() % 2 == 0 ? 1 : -1;
      range.taps = taps;
      range.threshold = static_cast<std::int32_t>(random() % 900);
      const std::int32_t room = positions - 2 * taps - 2;
      range.steps = 1 + static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(room - 1));
      range.first = range.direction > 0 ? taps + (room - range.steps)
                                        : positions - 1 - taps - (room - range.steps);

      const EdgePeak peak = find_edge(path, range);

      const EdgePeak expected = searched_by_hand(path, range);
      ASSERT_EQ(peak.found, expected.found) << "seed " << seed << ", search " << i;
      found += peak.found ? 1 : 0;
      missed += peak.found ? 0 : 1;
      if (peak.found) {
        ASSERT_EQ(peak.position, expected.position) << "seed " << seed << ", search " << i;
        ASSERT_EQ(peak.gradient, expected.gradient) << "seed " << seed << ", search " << i;
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(missed, 100);
}

TEST(FindEdge, StopsAtTheFirstRiseAndNotAtAGreaterOneBehindIt) {
  Picture picture(96, 5, 20);
  picture.draw([](double u, double) { return u < 40.0 ? 20.0 : (u < 70.0 ? 80.0 : 250.0); });

  const EdgePeak peak = find_edge(horizontal_path(picture.field(Parity::kProgressive), 2),
                                  {20, 1, 60, kHorizontalTaps, 200});

  ASSERT_TRUE(peak.found);
  // Both sums see six pixels of either level at 39 and at 40: 12 * 60 less the pixel between.
  EXPECT_TRUE(peak.position == 39 || peak.position == 40) << peak.position;
  EXPECT_GE(peak.gradient, 11 * 60);
}

TEST(FindEdge, DoesNotTakeAFallForARise) {
  Picture picture(96, 5);
  picture.draw([](double u, double) { return u < 40.0 ? 200.0 : 20.0; });
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 2);

  EXPECT_FALSE(find_edge(path, {20, 1, 60, kHorizontalTaps, 36}).found);
  EXPECT_TRUE(find_edge(path, {70, -1, 60, kHorizontalTaps, 36}).found);
}

TEST(FindEdge, LooksAtNoMoreStepsThanAsked) {
  Picture picture(96, 5);
  picture.draw([](double u, double) { return u < 60.0 ? 20.0 : 200.0; });
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 2);

  // At 53 the sixth pixel ahead is 59, still dark: gradients begin at 54.
  EXPECT_FALSE(find_edge(path, {30, 1, 24, kHorizontalTaps, 36}).found);
  EXPECT_TRUE(find_edge(path, {30, 1, 25, kHorizontalTaps, 36}).found);
}

TEST(FindEdge, IsNotLedAstrayBySaltNoise) {
  // 2 % of all pixels white: the greatest gradient stays at the step, give or take the few pixels
  // that one white pixel of twelve shifts it.
  std::mt19937 random(99);
  int near = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Picture picture(96, 9);
    picture.draw([](double u, double) { return u < 60.0 ? 20.0 : 200.0; });
    for (std::int32_t v = 0; v < 9; ++v) {
      for (std::int32_t u = 0; u < 96; ++u) {
        if (random() % 50 == 0) {
          picture.at(u, v) = 255;
        }
      }
    }
    const EdgePeak peak = find_edge(horizontal_path(picture.field(Parity::kProgressive), 4),
                                    {30, 1, 50, kHorizontalTaps, 750});
    near += peak.found && peak.position >= 57 && peak.position <= 62 ? 1 : 0;
  }
  // One white pixel alone gives 235; three among twelve before the edge are needed to reach 750.
  EXPECT_GE(near, 190);
}

TEST(FindEdge, ReadsUpToTheBordersAndNoFarther) {
  // Exactly the bytes that the contract allows: `taps` before the first position, `taps` + 1 behind
  // the last step. A read beside them ends the test under the address sanitizer.
  constexpr std::int32_t kSteps = 10;
  const std::int32_t width = kHorizontalTaps + kSteps + kHorizontalTaps + 1;
  Picture picture(width, 3, 7);
  const EdgePath path = horizontal_path(picture.field(Parity::kProgressive), 1);

  EXPECT_FALSE(find_edge(path, {kHorizontalTaps, 1, kSteps, kHorizontalTaps, 36}).found);
  EXPECT_FALSE(
      find_edge(path, {width - 1 - kHorizontalTaps, -1, kSteps, kHorizontalTaps, 36}).found);
  const std::int32_t lines = kVerticalTaps + kSteps + kVerticalTaps + 1;
  Picture tall(5, lines, 7);
  const EdgePath column = vertical_path(tall.field(Parity::kProgressive), 2);
  EXPECT_FALSE(find_edge(column, {kVerticalTaps, 1, kSteps, kVerticalTaps, 36}).found);
  EXPECT_FALSE(find_edge(column, {lines - 1 - kVerticalTaps, -1, kSteps, kVerticalTaps, 36}).found);
}

}  // namespace
}  // namespace tubesight::core::edges
