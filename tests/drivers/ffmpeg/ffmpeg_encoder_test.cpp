#include "drivers/ffmpeg/ffmpeg_encoder.h"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/ffmpeg/ffmpeg_decoder.h"
#include "drivers/files/y4m_reader.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using support::TemporaryFolder;

/// A picture of one grey with a stride of its own.
struct Plain {
  Plain(std::int32_t width_px, std::int32_t height_px, std::uint8_t grey)
      : pixels(static_cast<std::size_t>((3 * width_px + 5) * height_px), grey),
        view{pixels.data(), width_px, height_px, 3 * width_px + 5} {}

  std::vector<std::uint8_t> pixels;
  core::RgbImageView view;
};

TEST(FfmpegEncoder, TakesTheNamesOfVideosThatPlayersKnow) {
  EXPECT_TRUE(FfmpegEncoder::encodes("a.mp4"));
  EXPECT_TRUE(FfmpegEncoder::encodes("a/b.MKV"));
  EXPECT_TRUE(FfmpegEncoder::encodes("a.mov"));
  EXPECT_FALSE(FfmpegEncoder::encodes("a.y4m"));
  EXPECT_FALSE(FfmpegEncoder::encodes("mp4"));
  EXPECT_FALSE(FfmpegEncoder::encodes(".mp4"));
}

TEST(FfmpegEncoder, WritesEveryFrameOfAnOddSize) {
  const TemporaryFolder folder;
  for (const char* const name : {"v.mp4", "v.mkv", "v.mov"}) {
    SCOPED_TRACE(name);
    FfmpegEncoder encoder;
    ASSERT_TRUE(encoder.open(folder.path(name), 50, 1)) << encoder.message();
    for (int frame = 0; frame < 7; ++frame) {
      const Plain picture(35, 23, static_cast<std::uint8_t>(20 + 30 * frame));
      ASSERT_TRUE(encoder.write_frame(picture.view)) << encoder.message();
    }
    ASSERT_TRUE(encoder.commit()) << encoder.message();

    std::string message;
    auto source = FfmpegDecoder::open(folder.path(name), message);
    ASSERT_TRUE(source) << message;
    Y4mReader reader;
    ASSERT_TRUE(reader.open(std::move(*source), "v")) << reader.message();
    EXPECT_EQ(reader.header().width_px, 36);
    EXPECT_EQ(reader.header().height_px, 24);
    EXPECT_EQ(reader.header().rate_numerator, 50 * reader.header().rate_denominator);
    std::vector<std::uint8_t> luma(36 * 24);
    for (int frame = 0; frame < 7; ++frame) {
      ASSERT_TRUE(reader.read_frame(luma)) << frame;
      EXPECT_NEAR(luma[36 * 12 + 15], 20 + 30 * frame, 4);
    }
    EXPECT_EQ(reader.read_frame(luma).error(), Error::kEndOfData);
  }
  EXPECT_EQ(folder.names().size(), 3U);
}

TEST(FfmpegEncoder, LeavesNothingUnlessCommitted) {
  const TemporaryFolder folder;
  folder.write("v.mp4", "of yesterday");
  {
    FfmpegEncoder encoder;
    ASSERT_TRUE(encoder.open(folder.path("v.mp4"), 25, 1)) << encoder.message();
    const Plain picture(32, 24, 99);
    ASSERT_TRUE(encoder.write_frame(picture.view));
  }

  EXPECT_EQ(folder.names().size(), 1U);
  EXPECT_EQ(folder.read("v.mp4"), "of yesterday");
}

TEST(FfmpegEncoder, RefusesAVideoWithoutPictures) {
  const TemporaryFolder folder;
  FfmpegEncoder encoder;
  ASSERT_TRUE(encoder.open(folder.path("v.mp4"), 25, 1));

  EXPECT_FALSE(encoder.commit());
  EXPECT_TRUE(encoder.message().ends_with("v.mp4: cannot be written: it has no picture"));
}

TEST(FfmpegEncoder, RefusesAPictureOfAnotherSize) {
  const TemporaryFolder folder;
  FfmpegEncoder encoder;
  ASSERT_TRUE(encoder.open(folder.path("v.mp4"), 25, 1));
  const Plain one(32, 24, 99);
  const Plain other(32, 26, 99);
  ASSERT_TRUE(encoder.write_frame(one.view));

  EXPECT_EQ(encoder.write_frame(other.view).error(), Error::kInvalidArgument);
}

TEST(FfmpegEncoder, NamesThePackageWhereFfmpegIsMissing) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path("").c_str(), 1);
  FfmpegEncoder encoder;

  const auto opened = encoder.open("v.mp4", 25, 1);

  ::setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(opened);
  EXPECT_EQ(encoder.message(),
            "v.mp4: cannot be encoded: ffmpeg is not installed, expected the package ffmpeg (apt "
            "install ffmpeg)");
}

TEST(FfmpegEncoder, SaysWhyTheFileCannotBeMade) {
  FfmpegEncoder encoder;

  ASSERT_FALSE(encoder.open("/no/such/folder/v.mp4", 25, 1));

  EXPECT_EQ(encoder.message(),
            "/no/such/folder/v.mp4: cannot be written: No such file or directory");
}

}  // namespace
}  // namespace tubesight::drivers
