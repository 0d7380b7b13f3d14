#include "drivers/files/y4m_header.h"

#include <utility>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

Y4mHeader parse(std::string_view line) {
  std::string message;
  const auto header = parse_y4m_header(line, message);
  EXPECT_TRUE(header) << message;
  return header ? *header : Y4mHeader{};
}

/// The message of a header that is refused.
std::string why(std::string_view line, core::Error error) {
  std::string message;
  const auto header = parse_y4m_header(line, message);
  EXPECT_FALSE(header) << line;
  if (!header) {
    EXPECT_EQ(header.error(), error) << line;
  }
  return message;
}

TEST(ParseY4mHeader, ReadsWhatFfmpegWrites) {
  const Y4mHeader header = parse("YUV4MPEG2 W635 H480 F30:1 It A1:1 Cmono XYSCSS=MONO");

  EXPECT_EQ(header.width_px, 635);
  EXPECT_EQ(header.height_px, 480);
  EXPECT_EQ(header.rate_numerator, 30);
  EXPECT_EQ(header.rate_denominator, 1);
  EXPECT_EQ(header.interlacing, Y4mInterlacing::kEvenFirst);
  EXPECT_EQ(header.chroma_bytes, 0);
}

TEST(ParseY4mHeader, TakesAMissingColourAs420) {
  // 5 x 3 pixels: two chroma planes of 3 x 2.
  const Y4mHeader header = parse("YUV4MPEG2 H3 W5");

  EXPECT_EQ(header.chroma_bytes, 12);
  EXPECT_EQ(header.rate_numerator, 0);
  EXPECT_EQ(header.interlacing, Y4mInterlacing::kUnstated);
}

TEST(ParseY4mHeader, KnowsTheChromaOfEachFormat) {
  const std::pair<const char*, std::int64_t> expected[] = {
      {"mono", 0}, {"420", 12}, {"420jpeg", 12}, {"420mpeg2", 12}, {"420paldv", 12},
      {"411", 12}, {"422", 18}, {"444", 30},     {"444alpha", 45}};
  for (const auto& [space, bytes] : expected) {
    // 5 x 3 pixels; 411 has ceil(5 / 4) = 2 columns of chroma, 422 has 3.
    EXPECT_EQ(parse(std::string("YUV4MPEG2 W5 H3 C") + space).chroma_bytes, bytes) << space;
  }
}

TEST(ParseY4mHeader, ReadsInterlacing) {
  EXPECT_EQ(parse("YUV4MPEG2 W5 H3 Ip").interlacing, Y4mInterlacing::kProgressive);
  EXPECT_EQ(parse("YUV4MPEG2 W5 H3 Ib").interlacing, Y4mInterlacing::kOddFirst);
  EXPECT_EQ(parse("YUV4MPEG2 W5 H3 I?").interlacing, Y4mInterlacing::kUnstated);
}

TEST(ParseY4mHeader, RefusesWhatIsNoRecording) {
  constexpr const char* kMessage =
      "not a YUV4MPEG2 file: expected the first line to begin with 'YUV4MPEG2 '";
  EXPECT_EQ(why("RIFF", core::Error::kInvalidArgument), kMessage);
  EXPECT_EQ(why("", core::Error::kInvalidArgument), kMessage);
  EXPECT_EQ(why("YUV4MPEG22 W1 H1", core::Error::kInvalidArgument), kMessage);
}

TEST(ParseY4mHeader, SaysWhichParameterIsWrong) {
  EXPECT_EQ(why("YUV4MPEG2", core::Error::kInvalidArgument),
            "the header lacks the picture's size: expected W<pixels> and H<pixels>");
  EXPECT_EQ(why("YUV4MPEG2 W5x H3", core::Error::kInvalidArgument),
            "header parameter 'W5x': expected a size in pixels");
  EXPECT_EQ(why("YUV4MPEG2 W5 H-3", core::Error::kInvalidArgument),
            "header parameter 'H-3': expected a size in pixels");
  EXPECT_EQ(why("YUV4MPEG2 W8193 H3", core::Error::kUnsupported),
            "header parameter 'W8193': expected at most 8192 pixels");
  EXPECT_EQ(why("YUV4MPEG2 W5 H3 F30", core::Error::kInvalidArgument),
            "header parameter 'F30': expected frames a second as F<number>:<number>");
  EXPECT_EQ(why("YUV4MPEG2 W5 H3 F30:0", core::Error::kInvalidArgument),
            "header parameter 'F30:0': expected frames a second as F<number>:<number>");
  EXPECT_EQ(why("YUV4MPEG2 W5 H3 Ix", core::Error::kInvalidArgument),
            "header parameter 'Ix': expected It, Ib or Ip");
  EXPECT_EQ(why("YUV4MPEG2 W5 H3 Im", core::Error::kUnsupported),
            "header says Im (mixed interlacing): expected It, Ib or Ip");
  for (const std::string colour : {"C410", "C420p17", "C411p10", "Cmono8", "Cmonop10"}) {
    EXPECT_EQ(
        why("YUV4MPEG2 W5 H3 " + colour, core::Error::kUnsupported),
        "colour format '" + colour +
            "' is not supported: expected Cmono, C420jpeg, C420mpeg2, C420paldv, C411, C422 or "
            "C444, or 9 to 16 bits as in Cmono10, C420p10, C422p10 or C444p10");
  }
}

TEST(Y4mHeader, TakesSamplesOfTwoBytes) {
  const auto header = [](std::string_view colour) {
    std::string message;
    const auto parsed = parse_y4m_header("YUV4MPEG2 W5 H3 " + std::string(colour), message);
    EXPECT_TRUE(parsed) << message;
    return parsed.value_or(Y4mHeader{});
  };

  EXPECT_EQ(header("Cmono16").depth_bits, 16);
  EXPECT_EQ(header("Cmono16").stored_luma_bytes(), 30);
  EXPECT_EQ(header("Cmono16").luma_bytes(), 15);
  EXPECT_EQ(header("Cmono16").chroma_bytes, 0);
  EXPECT_EQ(header("C420p10").depth_bits, 10);
  EXPECT_EQ(header("C420p10").chroma_bytes, 24);
  EXPECT_EQ(header("C422p12").chroma_bytes, 36);
  EXPECT_EQ(header("C444p9").chroma_bytes, 60);
  EXPECT_EQ(header("C444").depth_bits, 8);
  EXPECT_EQ(header("C444").stored_luma_bytes(), 15);
}

}  // namespace
}  // namespace tubesight::drivers
