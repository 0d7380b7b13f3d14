#include "core/tracking/old_picture_watch.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/noisy_picture.h"

namespace tubesight::core::tracking {
namespace {

/// A watch shown grey pictures whose noise is `seed`'s.
class OldPictureWatchOf : public NoisyPicture {
 protected:
  bool look(std::uint32_t seed) {
    draw(seed);
    return look();
  }
  bool look() {
    Field field;
    field.parity = Parity::kProgressive;
    field.pixels = view(field.parity);
    return watch_.shows_old(field, {20, 20, 300, 200});
  }
  /// Shows and believes fields at rest with the noises of these seeds.
  void rest(std::uint32_t first, std::uint32_t fields) {
    for (std::uint32_t seed = first; seed < first + fields; ++seed) {
      EXPECT_FALSE(look(seed));
      watch_.believe(true);
    }
  }

  OldPictureWatch watch_;
};

TEST_F(OldPictureWatchOf, FindsAPictureDeliveredAgainOnceNoiseIsKnown) {
  rest(1, 3);
  EXPECT_FALSE(look(4));
  EXPECT_TRUE(look(4));
}

TEST_F(OldPictureWatchOf, FindsATornField) {
  rest(1, 3);
  const std::vector<std::uint8_t> old = pixels_;
  draw(4);
  std::copy(old.begin() + 150 * kWidth, old.end(), pixels_.begin() + 150 * kWidth);
  EXPECT_TRUE(look());
}

TEST_F(OldPictureWatchOf, CallsNoPictureOldThatHasNoNoise) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(look(1)) << "a drawn picture of a tool at rest is always the same";
    watch_.believe(true);
  }
}

TEST_F(OldPictureWatchOf, LearnsOnlyFromThreeFieldsAtRestInARow) {
  rest(1, 2);
  EXPECT_FALSE(look(3));
  watch_.believe(false);  // it moved: that is why the pictures differ
  rest(4, 2);
  EXPECT_FALSE(look(5)) << "equal, but nothing has shown noise yet";
  rest(6, 3);
  EXPECT_TRUE(look(8));
}

TEST_F(OldPictureWatchOf, LearnsNothingFromFieldsThatWereNotBelieved) {
  for (std::uint32_t seed = 1; seed < 9; ++seed) {
    EXPECT_FALSE(look(seed));
  }
  EXPECT_FALSE(look(8));
}

TEST_F(OldPictureWatchOf, ForgetsWithANewStart) {
  rest(1, 3);
  watch_.begin();
  EXPECT_FALSE(look(3));
  EXPECT_FALSE(look(3));
}

}  // namespace
}  // namespace tubesight::core::tracking
