#include "core/overlay/painter.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;

constexpr Rgb kInk{200, 100, 50};
constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();

TEST(NearestPixel, RoundsHalvesRightAndDownOnBothSidesOfZero) {
  EXPECT_EQ(nearest_pixel({0, 0}), (PixelPoint{0, 0}));
  EXPECT_EQ(nearest_pixel({32767, 32768}), (PixelPoint{0, 1}));     // 0.49998, 0.5
  EXPECT_EQ(nearest_pixel({-32768, -32769}), (PixelPoint{0, -1}));  // -0.5, -0.50002
  EXPECT_EQ(nearest_pixel({163840, -98304}), (PixelPoint{3, -1}));  // 2.5, -1.5
  EXPECT_EQ(nearest_pixel({kHigh, kLow}), (PixelPoint{32768, -32768}));
}

TEST(PainterPixel, SetsThreeChannelsInOrder) {
  Canvas canvas(3, 2);

  Painter(canvas.view()).pixel({1, 1}, kInk);

  const RgbImageView view = canvas.view();
  const std::uint8_t* pixel = view.pixels + view.stride_bytes + 3;
  EXPECT_EQ(pixel[0], 200);
  EXPECT_EQ(pixel[1], 100);
  EXPECT_EQ(pixel[2], 50);
  EXPECT_EQ(canvas.drawn(kInk), "...\n.#.\n");
}

TEST(PainterPixel, OutsideThePictureDrawsNothing) {
  Canvas canvas(3, 2);
  Painter painter(canvas.view());

  for (const PixelPoint at : {PixelPoint{-1, 0}, PixelPoint{3, 0}, PixelPoint{0, -1},
                              PixelPoint{0, 2}, PixelPoint{kLow, kHigh}, PixelPoint{kHigh, kLow}}) {
    painter.pixel(at, kInk);
  }

  EXPECT_EQ(canvas.drawn(kInk), "...\n...\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterFill, TakesItsEdgesAndClips) {
  Canvas canvas(5, 4);
  Painter painter(canvas.view());

  painter.fill({1, 1, 2, 2}, kInk);
  painter.fill({4, 3, kHigh, kHigh}, kInk);
  painter.fill({3, 1, 2, 3}, kInk);  // empty

  EXPECT_EQ(canvas.drawn(kInk),
            ".....\n"
            ".##..\n"
            ".##..\n"
            "....#\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterOutline, GrowsInwards) {
  Canvas canvas(8, 7);

  Painter(canvas.view()).outline({1, 1, 6, 5}, 2, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "........\n"
            ".######.\n"
            ".######.\n"
            ".##..##.\n"
            ".######.\n"
            ".######.\n"
            "........\n");
}

TEST(PainterOutline, ThickerThanTheBoxFillsNothingBeyondIt) {
  Canvas canvas(5, 4);

  Painter(canvas.view()).outline({1, 1, 3, 2}, 9, kInk);

  EXPECT_EQ(canvas.drawn(kInk), ".....\n.###.\n.###.\n.....\n");
}

TEST(PainterOutline, PartlyOutsideKeepsItsPlace) {
  Canvas canvas(4, 4);
  Painter painter(canvas.view());

  painter.outline({-2, 1, 2, 9}, 1, kInk);
  painter.outline({kLow, kLow, kHigh, kHigh}, 1, kInk);
  painter.outline({3, 3, 1, 1}, 1, kInk);  // empty

  EXPECT_EQ(canvas.drawn(kInk), "....\n###.\n..#.\n..#.\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterLine, StaysOnThePixelsNearestToTheIdealLine) {
  Canvas canvas(8, 4);

  // v = u / 2: halves go down, at u = 1, 3, 5.
  Painter(canvas.view()).line({0, 0}, {6, 3}, 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "#.......\n"
            ".##.....\n"
            "...##...\n"
            ".....##.\n");
}

TEST(PainterLine, RunsSteepAndBackwards) {
  Canvas canvas(4, 7);

  // From (2, 6) up to (0, 0): u = 2 - step / 3, the nearest at step 2 is 2 - 0.67 = 1.
  Painter(canvas.view()).line({2, 6}, {0, 0}, 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "#...\n"
            "#...\n"
            ".#..\n"
            ".#..\n"
            ".#..\n"
            "..#.\n"
            "..#.\n");
}

TEST(PainterLine, OfOnePointIsTheBrush) {
  Canvas canvas(5, 5);
  Painter painter(canvas.view());

  painter.line({1, 1}, {1, 1}, 3, kInk);
  painter.line({3, 3}, {3, 3}, 2, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "###..\n"
            "###..\n"
            "###..\n"
            "...##\n"
            "...##\n");
}

TEST(PainterLine, ThickLineIsCenteredOnTheThinOne) {
  Canvas canvas(7, 5);

  Painter(canvas.view()).line({1, 2}, {5, 2}, 3, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            ".......\n"
            "#######\n"
            "#######\n"
            "#######\n"
            ".......\n");
}

// The part inside must not depend on how much lies outside.
TEST(PainterLine, ClippedEqualsTheSamePartOfALargerPicture) {
  constexpr std::int32_t kMargin = 40;
  struct Ends {
    PixelPoint from;
    PixelPoint to;
    std::int32_t thickness;
  };
  for (const Ends& ends :
       {Ends{{-33, -7}, {50, 23}, 1}, Ends{{50, 23}, {-33, -7}, 3}, Ends{{4, -39}, {9, 47}, 2},
        Ends{{9, 47}, {4, -39}, 5}, Ends{{-30, 20}, {45, -25}, 1}, Ends{{-20, -1}, {30, -1}, 3},
        Ends{{-38, -38}, {-12, 30}, 1}}) {
    Canvas small(16, 12);
    Canvas large(16 + 2 * kMargin, 12 + 2 * kMargin);

    Painter(small.view()).line(ends.from, ends.to, ends.thickness, kInk);
    Painter(large.view())
        .line({ends.from.u_px + kMargin, ends.from.v_px + kMargin},
              {ends.to.u_px + kMargin, ends.to.v_px + kMargin}, ends.thickness, kInk);

    for (std::int32_t v = 0; v < 12; ++v) {
      for (std::int32_t u = 0; u < 16; ++u) {
        ASSERT_EQ(small.at(u, v), large.at(u + kMargin, v + kMargin))
            << "pixel " << u << ", " << v << " of the line from " << ends.from.u_px << ", "
            << ends.from.v_px;
      }
    }
    EXPECT_TRUE(small.guards_intact());
  }
}

TEST(PainterLine, FarAwayEndsNeitherWrapNorHang) {
  Canvas canvas(5, 3);
  Painter painter(canvas.view());

  painter.line({kLow, 1}, {kHigh, 1}, 1, kInk);
  painter.line({kLow, kHigh}, {kLow, kLow}, 1, kInk);
  painter.line({kHigh, -40}, {kHigh, 40}, 5, kInk);

  EXPECT_EQ(canvas.drawn(kInk), ".....\n#####\n.....\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterCrossHair, LeavesItsGapOpen) {
  Canvas canvas(9, 9);

  Painter(canvas.view()).cross_hair({4, 4}, 2, 4, 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "....#....\n"
            "....#....\n"
            "....#....\n"
            ".........\n"
            "###...###\n"
            ".........\n"
            "....#....\n"
            "....#....\n"
            "....#....\n");
}

TEST(PainterCrossHair, ClosedAndClippedAtTheCorner) {
  Canvas canvas(5, 5);

  Painter(canvas.view()).cross_hair({0, 4}, 0, 3, 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk), ".....\n#....\n#....\n#....\n####.\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterDiagonalCross, EndsOnTheCornersOfItsBox) {
  Canvas canvas(5, 5);

  Painter(canvas.view()).diagonal_cross({2, 2}, 2, 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk), "#...#\n.#.#.\n..#..\n.#.#.\n#...#\n");
}

TEST(PainterCircle, OfRadiusThree) {
  Canvas canvas(9, 9);

  Painter(canvas.view()).circle({4, 4}, 3, kInk);

  // Hand-drawn: (0, 3) and (1, 3) lie 0 and 0.16 px off the circle, (2, 2) 0.17 px.
  EXPECT_EQ(canvas.drawn(kInk),
            ".........\n"
            "...###...\n"
            "..#...#..\n"
            ".#.....#.\n"
            ".#.....#.\n"
            ".#.....#.\n"
            "..#...#..\n"
            "...###...\n"
            ".........\n");
}

TEST(PainterRing, FillsWhatLiesBetweenTwoRadii) {
  Canvas ring(9, 9);
  Canvas disc(9, 9);

  Painter(ring.view()).ring({4, 4}, 2, 3, kInk);
  Painter(disc.view()).ring({3, 8}, 0, 2, kInk);

  EXPECT_EQ(ring.drawn(kInk),
            ".........\n"
            "...###...\n"
            "..#####..\n"
            ".##...##.\n"
            ".##...##.\n"
            ".##...##.\n"
            "..#####..\n"
            "...###...\n"
            ".........\n");
  EXPECT_EQ(disc.drawn(kInk),
            ".........\n"
            ".........\n"
            ".........\n"
            ".........\n"
            ".........\n"
            ".........\n"
            "..###....\n"
            ".#####...\n"
            ".#####...\n");
  EXPECT_TRUE(disc.guards_intact());
}

TEST(PainterCircle, OfAnyRadiusStaysWithinAPixelAndClosed) {
  for (const std::int32_t radius : {0, 1, 2, 5, 17, 60}) {
    Canvas canvas(2 * radius + 3, 2 * radius + 3);

    Painter(canvas.view()).circle({radius + 1, radius + 1}, radius, kInk);

    std::int32_t in_line = 0;
    for (const PixelPoint& pixel : canvas.pixels_of(kInk, canvas.height())) {
      const std::int32_t u = pixel.u_px - radius - 1;
      const std::int32_t v = pixel.v_px - radius - 1;
      const std::int32_t square = u * u + v * v;
      EXPECT_LE(square, (radius + 1) * (radius + 1)) << "radius " << radius;
      EXPECT_GE(square, radius == 0 ? 0 : (radius - 1) * (radius - 1)) << "radius " << radius;
      in_line += u == 0 ? 1 : 0;
    }
    EXPECT_EQ(in_line, radius == 0 ? 1 : 2);
    // Closed: each line of its height has a pixel.
    for (std::int32_t v = 1; v <= 2 * radius + 1; ++v) {
      bool any = false;
      for (std::int32_t u = 0; u < canvas.width(); ++u) {
        any = any || canvas.at(u, v) == kInk;
      }
      EXPECT_TRUE(any) << "radius " << radius << ", line " << v;
    }
  }
}

TEST(PainterText, DrawsGlyphsSixApart) {
  Canvas canvas(11, 9);

  Painter(canvas.view()).text({0, 0}, "7g", 1, kInk);

  EXPECT_EQ(canvas.drawn(kInk),
            "#####......\n"
            "....#......\n"
            "...#...####\n"
            "...#..#...#\n"
            "..#...#...#\n"
            "..#...#...#\n"
            "..#....####\n"
            "..........#\n"
            ".......###.\n");
}

TEST(PainterText, ScalesEachDotToASquare) {
  Canvas canvas(10, 14);

  Painter(canvas.view()).text({0, 0}, "L", 2, kInk);

  std::string expected;
  for (int i = 0; i < 12; ++i) {
    expected += "##........\n";
  }
  expected += "##########\n##########\n";
  EXPECT_EQ(canvas.drawn(kInk), expected);
}

TEST(PainterText, IsClippedAndNeverWraps) {
  Canvas canvas(6, 5);
  Painter painter(canvas.view());

  painter.text({4, -4}, "LLLL", 1, kInk);
  painter.text({kHigh, kHigh}, "88", 3, kInk);
  painter.text({kLow, kLow}, "88", 3, kInk);

  // Rows 4..8 of an L whose upright stands at u = 4.
  EXPECT_EQ(canvas.drawn(kInk), "....#.\n....#.\n....##\n......\n......\n");
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(PainterDeathTest, RefusesAStrideShorterThanALine) {
  Canvas canvas(4, 4);
  RgbImageView view = canvas.view();
  view.stride_bytes = 11;

  EXPECT_DEATH(Painter{view}, "");
}

}  // namespace
}  // namespace tubesight::core::overlay
