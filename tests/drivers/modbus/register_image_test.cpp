#include "drivers/modbus/register_image.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(RegisterImage, PutsTheHighWordWhereTheSettingsSay) {
  RegisterImage high(WordOrder::kHighFirst);
  RegisterImage low(WordOrder::kLowFirst);

  high.set(Register::kWordOrderMark, 0x01020304);
  low.set(Register::kWordOrderMark, 0x01020304);

  EXPECT_EQ(high.word(2), 0x0102);
  EXPECT_EQ(high.word(3), 0x0304);
  EXPECT_EQ(low.word(2), 0x0304);
  EXPECT_EQ(low.word(3), 0x0102);
  EXPECT_EQ(high.get(Register::kWordOrderMark), 0x01020304);
  EXPECT_EQ(low.get(Register::kWordOrderMark), 0x01020304);
}

TEST(RegisterImage, HoldsNegativeNumbers) {
  RegisterImage image(WordOrder::kHighFirst);

  image.set(Register::kTubeRow, -3);

  EXPECT_EQ(image.word(122), 0xFFFF);
  EXPECT_EQ(image.word(123), 0xFFFD);
  EXPECT_EQ(image.get(Register::kTubeRow), -3);
}

TEST(RegisterImage, ScalesAndRoundsAwayFromZero) {
  RegisterImage image(WordOrder::kHighFirst);

  EXPECT_TRUE(image.set_scaled(Register::kOffset, 1'234'500, 1'000'000));  // mm from nm: 1.2345
  EXPECT_EQ(image.get(Register::kOffset), 1235);
  EXPECT_TRUE(image.set_scaled(Register::kOffset, -1'234'500, 1'000'000));
  EXPECT_EQ(image.get(Register::kOffset), -1235);
}

TEST(RegisterImage, WhatDoesNotFitIsNotKnown) {
  RegisterImage image(WordOrder::kHighFirst);

  EXPECT_FALSE(image.set_scaled(Register::kOffset, std::int64_t{1} << 31, 1000));
  EXPECT_EQ(image.word(126), 0x8000);
  EXPECT_EQ(image.word(127), 0x0000);
  EXPECT_TRUE(image.set_scaled(Register::kOffset, INT32_MAX, 1000));
  EXPECT_FALSE(image.set_scaled(Register::kOffset, INT32_MIN, 1000)) << "it says: not known";
  EXPECT_FALSE(image.set_scaled(Register::kOffset, INT64_MAX, 1));
  EXPECT_FALSE(image.set_scaled(Register::kOffset, INT64_MIN, 1));
  EXPECT_TRUE(image.set_scaled(Register::kTracked, 65'534, 1));
  EXPECT_FALSE(image.set_scaled(Register::kTracked, 65'535, 1));
  EXPECT_EQ(image.get(Register::kTracked), 65'535);
  EXPECT_FALSE(image.set_scaled(Register::kTracked, -1, 1));
}

}  // namespace
}  // namespace tubesight::drivers
