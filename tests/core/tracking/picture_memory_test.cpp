#include "core/tracking/picture_memory.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/noisy_picture.h"

namespace tubesight::core::tracking {
namespace {

class PictureMemoryOf : public NoisyPicture {
 protected:
  PictureLikeness look(Parity parity = Parity::kEven) {
    return memory_.look(view(parity), parity, {20, 20, 300, 200});
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
  EXPECT_EQ(again.compared, 12);
  EXPECT_EQ(again.equal, 12);
}

TEST_F(PictureMemoryOf, FindsNoLineEqualUnderNoise) {
  draw(1);
  static_cast<void>(look());
  draw(2);
  const PictureLikeness fresh = look();
  EXPECT_EQ(fresh.compared, 12);
  EXPECT_EQ(fresh.equal, 0);
}

TEST_F(PictureMemoryOf, FindsTheOldLinesOfATornField) {
  draw(1);
  static_cast<void>(look());
  // Twelve lines from 20 to 200: at 27, 42, 57, 72, 87, 102 and six below the tear.
  std::vector<std::uint8_t> old = pixels_;
  draw(2);
  std::copy(old.begin() + 110 * kWidth, old.end(), pixels_.begin() + 110 * kWidth);
  const PictureLikeness torn = look();
  EXPECT_EQ(torn.compared, 12);
  EXPECT_EQ(torn.equal, 6);
}

TEST_F(PictureMemoryOf, LooksAtNoLineWithoutGrey) {
  for (const std::int32_t level : {0, 252}) {
    draw(1, level);
    static_cast<void>(look());
    EXPECT_EQ(look().compared, 0) << level;
  }
}

TEST_F(PictureMemoryOf, ForgetsWhenCleared) {
  draw(1);
  static_cast<void>(look());
  memory_.clear();
  EXPECT_EQ(look().compared, 0);
}

}  // namespace
}  // namespace tubesight::core::tracking
