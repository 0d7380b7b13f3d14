#include "core/overlay/still_marks.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;

std::string drawn(RimMark finding) {
  Canvas canvas(9, 9);
  Painter painter(canvas.view());
  draw_rim_centre(painter, MarkScale(640), {4, 4}, finding);
  return canvas.drawn(colour_of(finding));
}

// Without their colours, too.
TEST(RimCentre, IsToldByItsShape) {
  EXPECT_EQ(drawn(RimMark::kUsed),
            ".........\n"
            "....#....\n"
            "....#....\n"
            "....#....\n"
            ".#######.\n"
            "....#....\n"
            "....#....\n"
            "....#....\n"
            ".........\n");
  EXPECT_EQ(drawn(RimMark::kRejected),
            ".........\n"
            ".#.....#.\n"
            "..#...#..\n"
            "...#.#...\n"
            "....#....\n"
            "...#.#...\n"
            "..#...#..\n"
            ".#.....#.\n"
            ".........\n");
  EXPECT_EQ(drawn(RimMark::kClosed),
            ".........\n"
            ".#######.\n"
            ".#.....#.\n"
            ".#.....#.\n"
            ".#.....#.\n"
            ".#.....#.\n"
            ".#.....#.\n"
            ".#######.\n"
            ".........\n");
  EXPECT_EQ(drawn(RimMark::kNotMeasured),
            ".........\n"
            ".........\n"
            ".........\n"
            "...###...\n"
            "...###...\n"
            "...###...\n"
            ".........\n"
            ".........\n"
            ".........\n");
}

TEST(RimStretch, HasTheFindingsColour) {
  Canvas canvas(9, 9);
  Painter painter(canvas.view());

  draw_rim_stretch(painter, MarkScale(640), {1, 4}, {7, 4}, RimMark::kRejected);
  draw_edge_point(painter, MarkScale(640), {4, 7});

  EXPECT_EQ(canvas.pixels_of(colour_of(RimMark::kRejected), 9).size(), 7U);
  EXPECT_EQ(canvas.at(4, 7), (Rgb{255, 255, 255}));
}

}  // namespace
}  // namespace tubesight::core::overlay
