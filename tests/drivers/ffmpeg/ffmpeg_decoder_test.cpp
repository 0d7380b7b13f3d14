#include "drivers/ffmpeg/ffmpeg_decoder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "drivers/files/y4m_reader.h"
#include "tests/support/made_video.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using support::run_ffmpeg;
using support::TemporaryFolder;

/// Five frames of noise that has no neighbours alike, 33 x 21 pixels of 8-bit grey.
constexpr const char* kNoise =
    "-f lavfi -i \"nullsrc=s=33x21:r=25,format=gray,geq=lum='mod(X*37+Y*91+N*53,256)'\" "
    "-frames:v 5 ";

struct Read {
  Y4mHeader header;
  std::vector<std::vector<std::uint8_t>> frames;
  std::vector<std::optional<FrameStamp>> stamps;
  Error end = Error::kNotReady;
  std::string message;
};

Read read_video(const std::string& path) {
  Read read;
  auto source = FfmpegDecoder::open(path, read.message);
  if (!source) {
    read.end = source.error();
    return read;
  }
  FfmpegDecoder* const stamps = source->get();
  Y4mReader reader;
  if (const auto opened = reader.open(std::move(*source), "v"); !opened) {
    read.end = opened.error();
    read.message = reader.message();
    return read;
  }
  read.header = reader.header();
  while (true) {
    std::vector<std::uint8_t> frame(static_cast<std::size_t>(reader.header().luma_bytes()));
    if (const auto one = reader.read_frame(frame); !one) {
      read.end = one.error();
      read.message = reader.message();
      return read;
    }
    read.frames.push_back(frame);
    read.stamps.push_back(stamps->next_stamp());
  }
}

std::uint8_t noise(int u, int v, int frame) {
  return static_cast<std::uint8_t>((u * 37 + v * 91 + frame * 53) % 256);
}

void expect_noise(const Read& read) {
  EXPECT_EQ(read.end, Error::kEndOfData) << read.message;
  EXPECT_EQ(read.header.width_px, 33);
  EXPECT_EQ(read.header.height_px, 21);
  ASSERT_EQ(read.frames.size(), 5U);
  for (int frame = 0; frame < 5; ++frame) {
    for (int v = 0; v < 21; ++v) {
      for (int u = 0; u < 33; ++u) {
        ASSERT_EQ(
            read.frames[static_cast<std::size_t>(frame)][static_cast<std::size_t>(33 * v + u)],
            noise(u, v, frame))
            << u << ' ' << v << ' ' << frame;
      }
    }
  }
}

TEST(FfmpegDecoder, ReadsTheVeryPixelsOfALosslessVideoOfOddSize) {
  const TemporaryFolder folder;
  run_ffmpeg(folder, std::string(kNoise) + "-c:v ffv1 v.mkv");

  expect_noise(read_video(folder.path("v.mkv")));
}

TEST(FfmpegDecoder, GivesTheUpperBitsOfDeepPixels) {
  const TemporaryFolder folder;
  for (const char* const deep : {"gray10le", "gray12le", "gray16le"}) {
    SCOPED_TRACE(deep);
    run_ffmpeg(folder, std::string(kNoise) + "-c:v ffv1 -pix_fmt " + deep + " v.mkv");

    const Read read = read_video(folder.path("v.mkv"));

    expect_noise(read);
    EXPECT_GT(read.header.depth_bits, 8);
  }
}

TEST(FfmpegDecoder, TellsStampsOfAVariableRateAndNeitherDoublesNorDrops) {
  const TemporaryFolder folder;
  // The third frame and those behind it come two periods late.
  run_ffmpeg(folder, std::string(kNoise) +
                         "-vf \"setpts='(N+if(gte(N,2),2,0))/25/TB'\" -fps_mode vfr -c:v ffv1 "
                         "v.mkv");

  const Read read = read_video(folder.path("v.mkv"));

  expect_noise(read);
  ASSERT_EQ(read.stamps.size(), 5U);
  std::vector<double> times;
  for (const auto& stamp : read.stamps) {
    ASSERT_TRUE(stamp);
    times.push_back(static_cast<double>(stamp->ticks) * static_cast<double>(stamp->numerator) /
                    static_cast<double>(stamp->denominator));
  }
  EXPECT_NEAR(times[1] - times[0], 0.04, 0.0011);
  EXPECT_NEAR(times[2] - times[1], 0.12, 0.0011);
  EXPECT_NEAR(times[4] - times[3], 0.04, 0.0011);
}

TEST(FfmpegDecoder, TellsInterlacedFramesByTheHeader) {
  const TemporaryFolder folder;
  run_ffmpeg(folder,
             "-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 3 -vf setfield=tff -flags +ildct "
             "-c:v mpeg2video -q:v 2 t.mpg");
  run_ffmpeg(folder, "-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 3 -c:v mpeg2video p.mpg");

  EXPECT_EQ(read_video(folder.path("t.mpg")).header.interlacing, Y4mInterlacing::kEvenFirst);
  EXPECT_EQ(read_video(folder.path("p.mpg")).header.interlacing, Y4mInterlacing::kProgressive);
}

TEST(FfmpegDecoder, TakesANameForNothingButAName) {
  const TemporaryFolder folder;
  run_ffmpeg(folder, std::string(kNoise) + "-c:v ffv1 v.mkv");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  for (const char* const name :
       {"-i", "-version", "http:v", "concat:a|b", "pipe:0", "v%03d.png", "a b'c.txt"}) {
    SCOPED_TRACE(name);
    std::filesystem::copy_file("v.mkv", name);

    expect_noise(read_video(name));
  }
  std::filesystem::current_path(before);
}

TEST(FfmpegDecoder, SaysWhatFfmpegSaid) {
  const TemporaryFolder folder;
  folder.write("no.mp4", "this is no video, whatever its name says\n");

  const Read read = read_video(folder.path("no.mp4"));

  EXPECT_EQ(read.end, Error::kDisconnected);
  EXPECT_EQ(read.message, "v: cannot be read: ffmpeg: Invalid data found when processing input");
}

TEST(FfmpegDecoder, DeliversWhatComesBeforeDamageAndSaysSo) {
  const TemporaryFolder folder;
  run_ffmpeg(folder, std::string(kNoise) + "-c:v mjpeg -q:v 2 -pix_fmt yuvj420p v.avi");
  std::string video = folder.read("v.avi");
  // The fourth picture of five no longer is one.
  std::size_t place = 0;
  for (int picture = 0; picture < 4; ++picture) {
    place = video.find("\xFF\xD8\xFF", place + 1);
    ASSERT_NE(place, std::string::npos);
  }
  for (std::size_t i = 0; i < 400; ++i) {
    video[place + i] = 'x';
  }
  folder.write("v.avi", video);

  const Read read = read_video(folder.path("v.avi"));

  EXPECT_EQ(read.end, Error::kDataLoss);
  EXPECT_EQ(read.frames.size(), 3U);
  EXPECT_TRUE(
      read.message.starts_with("v: cut short: only its first 3 frames are complete: ffmpeg"))
      << read.message;
}

TEST(FfmpegDecoder, TellsThatAFileIsNotThere) {
  std::string message;

  const auto source = FfmpegDecoder::open("/no/such/file", message);

  ASSERT_FALSE(source);
  EXPECT_EQ(source.error(), Error::kIo);
  EXPECT_EQ(message, "No such file or directory");
}

// ffmpeg has threads: on a busy machine it writes the next picture before a frame's stamp, and
// cannot end that while nobody reads it.
TEST(FfmpegDecoder, TakesAStampThatComesBehindTheNextPicture) {
  const TemporaryFolder folder;
  folder.write("v.mp4", "");
  folder.write("ffmpeg",
               "#!/bin/sh\n"
               "frame() { printf 'FRAME\\n'; head -c 307200 /dev/zero; }\n"
               "printf '#tb 0: 1/30\\n' >&3\n"
               "printf 'YUV4MPEG2 W640 H480 F30:1 Ip Cmono\\n'\n"
               "frame; frame; printf '0, 7, 7, 1, 256, 0x0\\n' >&3\n"
               "frame; printf '0, 8, 8, 1, 256, 0x0\\n0, 9, 9, 1, 256, 0x0\\n' >&3\n");
  std::filesystem::permissions(folder.path("ffmpeg"), std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder.path("") + ":" + path).c_str(), 1);

  const Read read = read_video(folder.path("v.mp4"));

  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(read.end, Error::kEndOfData) << read.message;
  ASSERT_EQ(read.stamps.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(read.stamps[i]) << i;
    EXPECT_EQ(read.stamps[i]->ticks, static_cast<std::int64_t>(7 + i));
  }
}

TEST(FfmpegDecoder, NamesThePackageWhereFfmpegIsMissing) {
  const TemporaryFolder folder;
  folder.write("v.mp4", "x");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path("").c_str(), 1);
  std::string message;

  const auto source = FfmpegDecoder::open(folder.path("v.mp4"), message);

  ::setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error(), Error::kUnsupported);
  EXPECT_EQ(message, "ffmpeg is not installed, expected the package ffmpeg (apt install ffmpeg)");
}

TEST(FfmpegDecoder, LeavesNoProcessBehindWhenGivenUp) {
  const TemporaryFolder folder;
  run_ffmpeg(folder, "-f lavfi -i testsrc2=s=320x240:r=25 -frames:v 100 -c:v mjpeg v.avi");
  std::string message;
  {
    auto source = FfmpegDecoder::open(folder.path("v.avi"), message);
    ASSERT_TRUE(source) << message;
    std::vector<std::byte> some(1000);
    ASSERT_TRUE((*source)->read(some));
  }

  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace tubesight::drivers
