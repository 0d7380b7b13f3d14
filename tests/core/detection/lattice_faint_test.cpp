// A lattice with a tube-end that a flat lamp fills with light: found where that is asked for.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/detection/lattice_finder.h"
#include "tests/core/detection/drawn_lattice.h"

namespace tubesight::core::detection {
namespace {

constexpr int kRow = 2;
constexpr int kColumn = 8;

FinderRefusal find_in(const picture::AveragedPicture& picture, bool with_faint,
                      FoundLattice& found) {
  const auto finder = std::make_unique<LatticeFinder>();
  std::vector<std::uint16_t> scratch(static_cast<std::size_t>(picture.width_px) *
                                     static_cast<std::size_t>(picture.height_px));
  FinderOptions options;
  options.with_faint = with_faint;
  return finder->find(picture, options, scratch, found);
}

TEST(LatticeFinderInLittleLight, ATubeEndFilledWithLightIsMarkedFaintAndOnlyFoundWhenAskedFor) {
  DrawnLattice drawn;
  drawn.background = 30.0;
  drawn.inside = 4.0;
  drawn.absent = [](int row, int column) { return row == kRow && column == kColumn; };
  const picture::AveragedPicture picture = drawn.draw();
  // A bore in its place: dark at its left end, brighter than the sheet at the right one.
  const Eigen::Vector2d at = drawn.pixel_of(drawn.center(kRow, kColumn));
  for (int v = -12; v <= 12; ++v) {
    for (int u = -12; u <= 12; ++u) {
      if (u * u + v * v <= 150) {
        const int x = static_cast<int>(std::lround(at.x())) + u;
        const int y = static_cast<int>(std::lround(at.y())) + v;
        drawn.cover(x, y, x, y, 27 + u / 2);
      }
    }
  }

  const auto found = std::make_unique<FoundLattice>();
  ASSERT_EQ(find_in(picture, false, *found), FinderRefusal::kNone);
  const std::int32_t without = found->elements.size();
  ASSERT_EQ(find_in(picture, true, *found), FinderRefusal::kNone);

  EXPECT_EQ(without, drawn.rows * drawn.columns - 1);
  EXPECT_EQ(found->elements.size(), without + 1);
  int faint = 0;
  for (const LatticeElement& element : found->elements) {
    if (element.faint) {
      ++faint;
      EXPECT_LT((element.center_px - at).norm(), 1.0);
      EXPECT_EQ(element.share, 0.0);
    }
  }
  EXPECT_EQ(faint, 1);
}

TEST(LatticeFinderInLittleLight, SpecksOfNoiseDoNotHideADimLattice) {
  DrawnLattice drawn;
  drawn.background = 22.0;
  drawn.inside = 3.0;
  picture::AveragedPicture picture = drawn.draw();
  // Two pixels of each tile that thresholds are chosen by, or of the next.
  for (int v = 3; v < drawn.height_px - 1; v += 11) {
    for (int u = 5; u < drawn.width_px - 1; u += 13) {
      drawn.cover(u, v, u, v, 255);
    }
  }

  const auto found = std::make_unique<FoundLattice>();
  ASSERT_EQ(find_in(picture, true, *found), FinderRefusal::kNone);

  EXPECT_EQ(found->elements.size(), drawn.rows * drawn.columns);
  for (const LatticeElement& element : found->elements) {
    EXPECT_LT(
        (element.center_px - drawn.pixel_of(drawn.center(element.row, element.column))).norm(),
        0.5);
  }
}

TEST(LatticeFinderInLittleLight, ATubeEndBeyondALaneOfPlugsIsFound) {
  DrawnLattice drawn;
  drawn.background = 60.0;
  drawn.absent = [](int row, int column) { return row >= 6 ? column != 4 || row != 7 : row == 5; };
  const picture::AveragedPicture picture = drawn.draw();

  const auto found = std::make_unique<FoundLattice>();
  ASSERT_EQ(find_in(picture, true, *found), FinderRefusal::kNone);

  EXPECT_EQ(found->elements.size(), 5 * drawn.columns + 1);
}

}  // namespace
}  // namespace tubesight::core::detection
