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
