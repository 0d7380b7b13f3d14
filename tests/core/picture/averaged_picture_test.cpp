#include "core/picture/averaged_picture.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace tubesight::core::picture {
namespace {

// 2 columns, 4 lines.
constexpr std::int32_t kWidth = 2;
constexpr std::int32_t kHeight = 4;
using Pixels = std::array<std::uint8_t, 8>;

ImageView view(const Pixels& pixels) { return {pixels.data(), kWidth, kHeight, kWidth}; }

class PictureAverageOf : public ::testing::Test {
 protected:
  std::array<std::uint16_t, 8> buffer_{};
  PictureAverage average_{buffer_, kWidth, kHeight};
};

TEST_F(PictureAverageOf, TwoFramesKeepsTheFraction) {
  const Pixels first{10, 0, 255, 7, 1, 2, 3, 4};
  const Pixels second{11, 0, 255, 8, 1, 2, 3, 5};

  ASSERT_TRUE(average_.add(field_of(view(first), Parity::kProgressive)).has_value());
  ASSERT_TRUE(average_.add(field_of(view(second), Parity::kProgressive)).has_value());
  const auto picture = average_.finish();

  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->at(0, 0), 10 * 256 + 128);
  EXPECT_EQ(picture->at(1, 0), 0);
  EXPECT_EQ(picture->at(0, 1), 255 * 256);
  EXPECT_EQ(picture->at(1, 3), 4 * 256 + 128);
}

TEST_F(PictureAverageOf, FieldsCountsTheirOwnLines) {
  const Pixels first{10, 10, 90, 90, 10, 10, 90, 90};
  const Pixels second{20, 20, 50, 50, 20, 20, 50, 50};

  ASSERT_TRUE(average_.add(field_of(view(first), Parity::kEven)).has_value());
  ASSERT_TRUE(average_.add(field_of(view(second), Parity::kEven)).has_value());
  ASSERT_TRUE(average_.add(field_of(view(first), Parity::kOdd)).has_value());

  EXPECT_EQ(average_.count(0), 2);
  EXPECT_EQ(average_.count(1), 1);
  EXPECT_DOUBLE_EQ(average_.mean(0, 2), 15.0);
  EXPECT_DOUBLE_EQ(average_.mean(0, 1), 90.0);
  const auto picture = average_.finish();
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->at(0, 2), 15 * 256);
  EXPECT_EQ(picture->at(1, 3), 90 * 256);
}

TEST_F(PictureAverageOf, OneFieldAloneTakesTheOtherLinesFromItsNeighbours) {
  const Pixels pixels{10, 10, 0, 0, 30, 40, 0, 0};

  ASSERT_TRUE(average_.add(field_of(view(pixels), Parity::kEven)).has_value());
  const auto picture = average_.finish();

  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->at(0, 1), 20 * 256);
  EXPECT_EQ(picture->at(1, 1), 25 * 256);
  EXPECT_EQ(picture->at(1, 3), 40 * 256);  // the last line has one neighbour
}

TEST_F(PictureAverageOf, MoreThan32FramesIsRefused) {
  Pixels pixels{};
  pixels.fill(255);
  for (int i = 0; i < kMaxAveragedFrames; ++i) {
    ASSERT_TRUE(average_.add(field_of(view(pixels), Parity::kProgressive)).has_value()) << i;
  }

  const auto more = average_.add(field_of(view(pixels), Parity::kProgressive));

  ASSERT_FALSE(more.has_value());
  EXPECT_EQ(more.error(), Error::kOutOfRange);
  const auto picture = average_.finish();
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->at(1, 2), 255 * 256);
}

TEST_F(PictureAverageOf, AnotherSizeIsRefused) {
  const Pixels pixels{};
  const ImageView small{pixels.data(), 2, 2, 2};

  const auto added = average_.add(field_of(small, Parity::kProgressive));

  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error(), Error::kInvalidArgument);
}

TEST_F(PictureAverageOf, NothingIsNotReady) {
  const auto picture = average_.finish();

  ASSERT_FALSE(picture.has_value());
  EXPECT_EQ(picture.error(), Error::kNotReady);
}

TEST(AverageOfOne, IsThePictureItself) {
  const std::array<std::uint8_t, 7> pixels = {1, 2, 0, 0, 3, 255, 0};  // stride 4
  std::array<std::uint16_t, 4> buffer{};

  const auto picture = average_of_one(ImageView{pixels.data(), 2, 2, 4}, buffer);

  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->at(0, 0), 1 * 256);
  EXPECT_EQ(picture->at(1, 0), 2 * 256);
  EXPECT_EQ(picture->at(0, 1), 3 * 256);
  EXPECT_EQ(picture->at(1, 1), 255 * 256);
}

TEST(AverageOfOne, NeedsTwoLinesAndRoom) {
  const std::array<std::uint8_t, 4> pixels{};
  std::array<std::uint16_t, 4> buffer{};

  EXPECT_FALSE(average_of_one(ImageView{pixels.data(), 4, 1, 4}, buffer).has_value());
  EXPECT_FALSE(average_of_one(ImageView{pixels.data(), 0, 2, 2}, buffer).has_value());
  EXPECT_FALSE(
      average_of_one(ImageView{pixels.data(), 2, 2, 2}, std::span(buffer).first(3)).has_value());
}

}  // namespace
}  // namespace tubesight::core::picture
