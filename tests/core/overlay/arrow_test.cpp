#include "core/overlay/arrow.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;
using tests::point_milli;

constexpr Rgb kInk{10, 200, 30};

TEST(Way, GivesPlacesAlongAndBesideItself) {
  // 3, 4, 5.
  const Way way(point_milli(10'000, 20'000), point_milli(40'000, 60'000));

  EXPECT_NEAR(static_cast<double>(way.length), 50.0 * 65'536, 16.0);
  EXPECT_EQ(nearest_pixel(way.at(2, 5)), (PixelPoint{22, 36}));
  EXPECT_EQ(nearest_pixel(way.beside(25 * 65'536, 0)), (PixelPoint{25, 40}));
  // To the right of (3, 4) as one looks along it, with v downwards, is (-4, 3).
  EXPECT_EQ(nearest_pixel(way.beside(0, 10 * 65'536)), (PixelPoint{2, 26}));
  EXPECT_EQ(nearest_pixel(way.beside(0, -10 * 65'536)), (PixelPoint{18, 14}));
}

TEST(Way, OfTheLargestNumbersStaysWithinThem) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  const Way way({kLow, kLow}, {kHigh, kHigh});

  EXPECT_EQ(way.at(1, 1).u_q16, kHigh);
  EXPECT_EQ(way.at((1 << 29), 1).u_q16, kHigh);
  EXPECT_NEAR(way.at(1, 2).v_q16, 0, 1);
}

TEST(DrawArrow, HasItsHeadAtTheEndOfTheWay) {
  Canvas canvas(40, 21);
  Painter painter(canvas.view());

  draw_arrow(painter, MarkScale(640), Way(point_milli(5'000, 10'000), point_milli(35'000, 10'000)),
             1, kInk);

  EXPECT_EQ(canvas.at(5, 10), kInk);
  EXPECT_EQ(canvas.at(35, 10), kInk);
  // Eleven back and five aside.
  EXPECT_EQ(canvas.at(24, 5), kInk);
  EXPECT_EQ(canvas.at(24, 15), kInk);
  EXPECT_EQ(canvas.at(36, 10), Rgb{});
  EXPECT_EQ(canvas.at(5, 9), Rgb{});
}

TEST(DrawArrow, ShorterThanAHeadHasNone) {
  Canvas canvas(40, 21);
  Painter painter(canvas.view());

  draw_arrow(painter, MarkScale(640), Way(point_milli(5'000, 10'000), point_milli(14'000, 10'000)),
             1, kInk);

  EXPECT_EQ(canvas.pixels_of(kInk, 21).size(), 10U);
}

}  // namespace
}  // namespace tubesight::core::overlay
