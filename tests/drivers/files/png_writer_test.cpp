#include "drivers/files/png_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/picture_reader.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using Pixels = std::vector<std::uint8_t>;

TEST(WritePng, KeepsGreyValues) {
  const support::TemporaryFolder folder;
  const std::array<std::uint8_t, 6> pixels = {0, 64, 99, 128, 255, 99};  // stride 3
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(write_png(folder.path("a.png"), core::ImageView{pixels.data(), 2, 2, 3}, message));
  ASSERT_TRUE(read_grey_picture(folder.path("a.png"), picture, message)) << message;

  EXPECT_EQ(picture.width_px, 2);
  EXPECT_EQ(picture.pixels, (Pixels{0, 64, 128, 255}));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST(WritePng, KeepsColourChannelsInOrder) {
  const support::TemporaryFolder folder;
  std::array<std::uint8_t, 9> pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255};
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(write_png(folder.path("a.png"), core::RgbImageView{pixels.data(), 3, 1, 9}, message));
  ASSERT_TRUE(read_grey_picture(folder.path("a.png"), picture, message)) << message;

  // The luma of pure red, green and blue: 0.299, 0.587 and 0.114 of 255.
  EXPECT_EQ(picture.pixels, (Pixels{76, 150, 29}));
}

/// A picture of 40 x 30 in lines of 130 bytes whose pixels are all of `count` colours, greys among
/// them; the luma of each.
void expect_kept(int count) {
  SCOPED_TRACE(count);
  const support::TemporaryFolder folder;
  std::vector<std::uint8_t> pixels(130 * 30, 17);
  Pixels expected;
  for (int i = 0; i < 40 * 30; ++i) {
    const int colour = i * 7 % count;
    std::uint8_t* const pixel = pixels.data() + 130 * (i / 40) + 3 * (i % 40);
    const bool grey = colour % 2 == 0;
    pixel[0] = static_cast<std::uint8_t>(grey ? colour % 256 : colour / 2 % 256);
    pixel[1] = grey ? pixel[0] : static_cast<std::uint8_t>(255 - colour / 512);
    pixel[2] = grey ? pixel[0] : 3;
    expected.push_back(
        static_cast<std::uint8_t>((299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2] + 500) / 1000));
  }
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(
      write_png(folder.path("a.png"), core::RgbImageView{pixels.data(), 40, 30, 130}, message));
  ASSERT_TRUE(read_grey_picture(folder.path("a.png"), picture, message)) << message;

  EXPECT_EQ(picture.width_px, 40);
  EXPECT_EQ(picture.pixels, expected);
}

TEST(WritePng, KeepsEveryColourWhetherTheyAreFewOrMany) {
  for (const int count : {1, 2, 17, 255, 256, 257, 300, 1200}) {
    expect_kept(count);
  }
}

/// What was written so and read back, as luma.
Pixels written_with_all_greys(PngGreys greys, Pixels pixels) {
  const support::TemporaryFolder folder;
  const auto width = static_cast<std::int32_t>(pixels.size() / 3);
  GreyPicture picture;
  std::string message;
  EXPECT_TRUE(write_png(folder.path("a.png"),
                        core::RgbImageView{pixels.data(), width, 1, 3 * width}, message, greys));
  const std::string bytes = folder.read("a.png");
  EXPECT_EQ(bytes.find("PLTE") != std::string::npos, greys == PngGreys::kNear);
  EXPECT_TRUE(read_grey_picture(folder.path("a.png"), picture, message)) << message;
  return picture.pixels;
}

TEST(WritePng, MovesTheRarestGreysByOneLevelWhereThatIsAllowed) {
  Pixels pixels;
  Pixels luma;
  for (int grey = 0; grey < 256; ++grey) {
    const auto count = static_cast<std::size_t>(std::min(2 * grey + 1, 31));
    pixels.insert(pixels.end(), 3 * count, static_cast<std::uint8_t>(grey));
    luma.insert(luma.end(), count, static_cast<std::uint8_t>(grey));
  }
  for (int colour = 0; colour < 8; ++colour) {
    pixels.insert(pixels.end(), {static_cast<std::uint8_t>(200 + colour), 0, 0});
    luma.push_back(static_cast<std::uint8_t>((299 * (200 + colour) + 500) / 1000));
  }

  EXPECT_EQ(written_with_all_greys(PngGreys::kExact, pixels), luma);
  const Pixels near = written_with_all_greys(PngGreys::kNear, pixels);

  ASSERT_EQ(near.size(), luma.size());
  int moved = 0;
  for (std::size_t i = 0; i < luma.size(); ++i) {
    EXPECT_LE(std::abs(near[i] - luma[i]), 1) << i;
    moved += near[i] == luma[i] ? 0 : 1;
  }
  // 0, 2, 4 ... 14 become 1, 3, 5 ... 15: each stands for one alone.
  EXPECT_EQ(moved, 1 + 5 + 9 + 13 + 17 + 21 + 25 + 29);
}

TEST(WritePng, TellsAFullDisk) {
  const std::array<std::uint8_t, 1> pixels = {7};
  std::string message;

  const auto written = write_png("/dev/full", core::ImageView{pixels.data(), 1, 1, 1}, message);

  ASSERT_FALSE(written);
  EXPECT_EQ(written.error(), core::Error::kIo);
  EXPECT_EQ(message, "/dev/full: cannot be written: No space left on device");
}

}  // namespace
}  // namespace tubesight::drivers
