#include "drivers/files/y4m_writer.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

Y4mHeader header_of(std::int32_t width_px, std::int32_t height_px) {
  Y4mHeader header;
  header.width_px = width_px;
  header.height_px = height_px;
  header.rate_numerator = 30000;
  header.rate_denominator = 1001;
  header.interlacing = Y4mInterlacing::kOddFirst;
  return header;
}

TEST(Y4mWriter, WritesGreyFramesWithoutPadding) {
  const support::TemporaryFolder folder;
  const std::array<std::uint8_t, 6> pixels = {'a', 'b', 'X', 'c', 'd', 'X'};  // stride 3
  Y4mWriter writer;

  ASSERT_TRUE(writer.open(folder.path("a.y4m"), header_of(2, 2), Y4mWriter::Colour::kMono));
  ASSERT_TRUE(writer.write_frame(core::ImageView{pixels.data(), 2, 2, 3}));
  ASSERT_TRUE(writer.commit());

  EXPECT_EQ(folder.read("a.y4m"), "YUV4MPEG2 W2 H2 F30000:1001 Ib Cmono\nFRAME\nabcd");
}

TEST(Y4mWriter, WritesColourInLimitedRange) {
  // BT.601 of 8-bit studio video: black 16, white 235, and the primaries' table values.
  const support::TemporaryFolder folder;
  std::array<std::uint8_t, 18> pixels = {0, 0,   0, 255, 255, 255, 255, 0,   0,
                                         0, 255, 0, 0,   0,   255, 128, 128, 128};
  Y4mWriter writer;

  ASSERT_TRUE(writer.open(folder.path("a.y4m"), header_of(6, 1), Y4mWriter::Colour::k444));
  ASSERT_TRUE(writer.write_frame(core::RgbImageView{pixels.data(), 6, 1, 18}));
  ASSERT_TRUE(writer.commit());

  const std::string text = folder.read("a.y4m");
  const std::string head = "YUV4MPEG2 W6 H1 F30000:1001 Ib C444\nFRAME\n";
  ASSERT_EQ(text.size(), head.size() + 18);
  EXPECT_EQ(text.substr(0, head.size()), head);
  const std::array<int, 18> expected = {16,  235, 81,  145, 41,  126,   // Y
                                        128, 128, 90,  54,  240, 128,   // Cb
                                        128, 128, 240, 34,  110, 128};  // Cr
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(static_cast<std::uint8_t>(text[head.size() + i]), expected[i]) << i;
  }
}

TEST(Y4mWriter, RefusesAnotherPicture) {
  const support::TemporaryFolder folder;
  std::array<std::uint8_t, 12> pixels{};
  Y4mWriter writer;
  const core::ImageView grey{pixels.data(), 2, 2, 2};

  EXPECT_EQ(writer.write_frame(grey).error(), core::Error::kNotReady);
  ASSERT_TRUE(writer.open(folder.path("a.y4m"), header_of(2, 2), Y4mWriter::Colour::k444));
  EXPECT_EQ(writer.write_frame(grey).error(), core::Error::kInvalidArgument);
  EXPECT_EQ(writer.write_frame(core::RgbImageView{pixels.data(), 2, 1, 6}).error(),
            core::Error::kInvalidArgument);
  EXPECT_EQ(writer.open(folder.path("b.y4m"), Y4mHeader{}, Y4mWriter::Colour::kMono).error(),
            core::Error::kInvalidArgument);
}

TEST(Y4mWriter, LeavesNothingWhenNotCommitted) {
  const support::TemporaryFolder folder;
  {
    Y4mWriter writer;
    ASSERT_TRUE(writer.open(folder.path("a.y4m"), header_of(2, 2), Y4mWriter::Colour::kMono));
  }
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace tubesight::drivers
