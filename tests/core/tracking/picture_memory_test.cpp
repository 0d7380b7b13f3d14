#include "core/tracking/picture_memory.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/noisy_picture.h"

namespace tubesight::core::tracking {
namespace {

constexpr std::int32_t kAll = PictureMemory::kLines * PictureMemory::kBlocks;
// Four grey levels alike: a variance of 1.25, twice that of the difference, times 8 times 7.
constexpr std::int32_t kNoise = 140;

class PictureMemoryOf : public NoisyPicture {
 protected:
  PictureLikeness look(Parity parity = Parity::kEven) {
    const PictureLikeness likeness = memory_.look(view(parity), parity, kWindow, kNoise);
    memory_.keep(view(parity), parity, kWindow);
    return likeness;
  }

  PictureMemory memory_;
};

TEST_F(PictureMemoryOf, HasNothingToCompareAtFirst) {
  draw(1);
  EXPECT_EQ(look().compared, 0);
  EXPECT_EQ(look(Parity::kOdd).compared, 0) << "the other lines are another picture";
}

TEST_F(PictureMemoryOf, TellsAPictureDeliveredAgain) {
  draw(1);
  static_cast<void>(look());
  const PictureLikeness again = look();
  EXPECT_EQ(again.compared, kAll);
  EXPECT_EQ(again.equal, kAll);
  EXPECT_EQ(again.equal_edges, 0) << "grey alone";
  EXPECT_EQ(again.noise, 0);
}

TEST_F(PictureMemoryOf, ComparesWithWhatWasKept) {
  draw(1);
  static_cast<void>(look());
  draw(2);
  EXPECT_EQ(memory_.look(view(Parity::kEven), Parity::kEven, kWindow, kNoise).equal, 0);
  draw(1);
  EXPECT_EQ(memory_.look(view(Parity::kEven), Parity::kEven, kWindow, kNoise).equal, kAll);
}

TEST_F(PictureMemoryOf, MeasuresTheNoiseOfTheDifference) {
  draw(1);
  static_cast<void>(look());
  draw(2);
  const PictureLikeness fresh = look();
  EXPECT_EQ(fresh.compared, kAll);
  EXPECT_EQ(fresh.equal, 0);
  EXPECT_NEAR(fresh.noise, kNoise, 0.25 * kNoise);
  EXPECT_NEAR(fresh.middle_noise, 0.9 * kNoise, 0.25 * kNoise);
  EXPECT_NEAR(fresh.grey, 121, 1);
  EXPECT_LT(fresh.quiet, kAll / 3);
}

TEST_F(PictureMemoryOf, TakesNoChangeOfBrightnessForNoise) {
  draw(1);
  static_cast<void>(look());
  draw(1, 140);
  const PictureLikeness brighter = look();
  EXPECT_EQ(brighter.noise, 0);
  EXPECT_EQ(brighter.equal, 0);
  EXPECT_EQ(brighter.quiet, kAll);
}

TEST_F(PictureMemoryOf, FindsTheOldBlocksBesideALiveStrip) {
  draw(1);
  static_cast<void>(look());
  const std::vector<std::uint8_t> old = pixels_;
  draw(2);
  // Seven blocks from 20 to 300, 45 px apart: at 20, 65, 110, 155, 200 and two in the strip.
  keep_left(old, 220);
  const PictureLikeness half = look();
  EXPECT_EQ(half.compared, kAll);
  EXPECT_EQ(half.equal, 5 * PictureMemory::kLines);
}

TEST_F(PictureMemoryOf, FindsTheOldLinesOfATornField) {
  draw(1);
  static_cast<void>(look());
  // Ten lines from 20 to 200: at 29, 47, 65, 83, 101 and five below the tear.
  std::vector<std::uint8_t> old = pixels_;
  draw(2);
  std::copy(old.begin() + 110 * kWidth, old.end(), pixels_.begin() + 110 * kWidth);
  const PictureLikeness torn = look();
  EXPECT_EQ(torn.compared, kAll);
  EXPECT_EQ(torn.equal, 5 * PictureMemory::kBlocks);
}

TEST_F(PictureMemoryOf, TellsEdgesThatStandStill) {
  draw_stripes(0);
  static_cast<void>(look());
  EXPECT_EQ(look().equal_edges, kAll);
  draw_stripes(2);
  EXPECT_EQ(look().equal_edges, 0);
}

TEST_F(PictureMemoryOf, LooksAtNoBlockWithoutGrey) {
  for (const std::int32_t level : {0, 252}) {
    draw(1, level);
    static_cast<void>(look());
    EXPECT_EQ(look().compared, 0) << level;
  }
}

TEST_F(PictureMemoryOf, RemembersNoNarrowWindow) {
  draw(1);
  constexpr PixelBox kNarrow{20, 20, 82, 200};
  memory_.keep(view(Parity::kEven), Parity::kEven, kNarrow);
  EXPECT_EQ(memory_.look(view(Parity::kEven), Parity::kEven, kNarrow, kNoise).compared, 0);
}

TEST_F(PictureMemoryOf, ForgetsWhenCleared) {
  draw(1);
  static_cast<void>(look());
  memory_.clear();
  EXPECT_EQ(look().compared, 0);
}

}  // namespace
}  // namespace tubesight::core::tracking
