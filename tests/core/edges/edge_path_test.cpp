#include "core/edges/edge_path.h"

#include <gtest/gtest.h>

#include "tests/core/edges/picture.h"

namespace tubesight::core::edges {
namespace {

TEST(EdgePath, RunsAlongALineOfTheFieldWithTheNeighbouringLinesBeside) {
  Picture picture(40, 20);
  picture.fill_random(1);

  const EdgePath path = horizontal_path(picture.field(Parity::kOdd), 4);

  // Line 4 of the odd field is line 9 of the frame; its neighbours in the field are 7 and 11.
  for (std::int32_t u = 0; u < 40; ++u) {
    EXPECT_EQ(path.pixel(u), picture.I(u, 9)) << u;
    EXPECT_EQ(path.pair(u), picture.I(u, 7) + picture.I(u, 11)) << u;
  }
}

TEST(EdgePath, RunsAlongAColumnWithThePathsTwoColumnsBeside) {
  Picture picture(40, 20);
  picture.fill_random(2);

  const EdgePath path = vertical_path(picture.field(Parity::kEven), 37);

  for (std::int32_t line = 0; line < 10; ++line) {
    EXPECT_EQ(path.pixel(line), picture.I(37, 2 * line)) << line;
    EXPECT_EQ(path.pair(line), picture.I(35, 2 * line) + picture.I(39, 2 * line)) << line;
  }
}

TEST(EdgePath, OfAProgressivePictureTakesEveryLine) {
  Picture picture(40, 20);
  picture.fill_random(3);

  const EdgePath along = horizontal_path(picture.field(Parity::kProgressive), 4);
  const EdgePath down = vertical_path(picture.field(Parity::kProgressive), 2);

  EXPECT_EQ(along.pair(11), picture.I(11, 3) + picture.I(11, 5));
  EXPECT_EQ(down.pair(11), picture.I(0, 11) + picture.I(4, 11));
}

}  // namespace
}  // namespace tubesight::core::edges
