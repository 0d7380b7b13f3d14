#include "drivers/files/png_writer.h"

#include <array>
#include <cstdint>

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
