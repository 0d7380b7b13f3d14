#include "board/box/picture_tap.h"

#include <array>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

constexpr std::int32_t kWidth = 4;
constexpr std::int32_t kHeight = 2;

core::Field field(std::int64_t number, const std::uint8_t* pixels) {
  core::Field made;
  made.number = number;
  made.pixels = {pixels, kWidth, kHeight, kWidth, 0, 1};
  return made;
}

TEST(PictureTap, HandsOverWhatItCopied) {
  PictureTap tap(kWidth, kHeight);
  std::array<std::uint8_t, kWidth* kHeight> pixels = {1, 2, 3, 4, 5, 6, 7, 8};
  tap.take(field(7, pixels.data()), {});
  pixels.fill(0);
  const PictureTap::Taken* const taken = tap.front();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(taken->field.number, 7);
  EXPECT_EQ(taken->field.pixels.pixels[5], 6);
  tap.pop();
  EXPECT_EQ(tap.front(), nullptr);
}

TEST(PictureTap, LeavesOutWhatFindsNoPlace) {
  PictureTap tap(kWidth, kHeight);
  const std::array<std::uint8_t, kWidth * kHeight> pixels{};
  for (std::int64_t number = 0; number < 10; ++number) {
    tap.take(field(number, pixels.data()), {});
  }
  std::int64_t expected = 0;
  while (const PictureTap::Taken* const taken = tap.front()) {
    EXPECT_EQ(taken->field.number, expected++);
    tap.pop();
  }
  EXPECT_EQ(expected, 4);
}

TEST(PictureTap, TakesTheNewsThatNoFieldCame) {
  PictureTap tap(kWidth, kHeight);
  core::Field missing;
  missing.status = core::FieldStatus::kMissing;
  missing.number = 3;
  tap.take(missing, {});
  ASSERT_NE(tap.front(), nullptr);
  EXPECT_EQ(tap.front()->field.status, core::FieldStatus::kMissing);
}

TEST(PictureTap, IsWantedWhenSomebodySaysSo) {
  PictureTap tap(kWidth, kHeight);
  EXPECT_FALSE(tap.wanted());
  tap.want(true, true);
  EXPECT_TRUE(tap.wanted() && tap.estimates_wanted());
}

}  // namespace
}  // namespace tubesight::board
