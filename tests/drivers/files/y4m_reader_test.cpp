#include "drivers/files/y4m_reader.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/recording_text.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using support::compress_xz;
using support::recording_text;
using support::source_of;
using Luma = std::vector<std::uint8_t>;

constexpr const char* kMono = "YUV4MPEG2 W4 H2 F30:1 It Cmono";

TEST(Y4mReader, DeliversFramesUntilTheEnd) {
  const std::string text = recording_text(kMono, 2, 8);
  Y4mReader reader;
  Luma luma(8);

  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  ASSERT_TRUE(reader.read_frame(luma));
  EXPECT_EQ(luma, (Luma{0, 1, 2, 3, 4, 5, 6, 7}));
  ASSERT_TRUE(reader.read_frame(luma));
  EXPECT_EQ(luma, (Luma{10, 11, 12, 13, 14, 15, 16, 17}));
  const auto end = reader.read_frame(luma);

  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), core::Error::kEndOfData);
  EXPECT_EQ(reader.frames_read(), 2);
  EXPECT_EQ(reader.message(), "");
}

TEST(Y4mReader, PassesOverChroma) {
  for (const char* const space : {"", " C420jpeg", " C420mpeg2", " C420paldv"}) {
    const std::string text = recording_text(std::string("YUV4MPEG2 W4 H2") + space, 2, 8, 4);
    Y4mReader reader;
    Luma luma(8);

    ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
    ASSERT_TRUE(reader.read_frame(luma));
    ASSERT_TRUE(reader.read_frame(luma)) << reader.message();

    EXPECT_EQ(luma[7], 17) << space;
  }
}

TEST(Y4mReader, GivesTheUpperBitsOfDeepSamples) {
  // 10 bits: 0x3FF, 0x200, 0x003 and, beyond them, 0x1234.
  const std::string text = std::string("YUV4MPEG2 W4 H1 C420p10\nFRAME\n") +
                           std::string("\xFF\x03\x00\x02\x03\x00\x34\x12", 8) +
                           std::string(8, '\x7F');
  Y4mReader reader;
  Luma luma(4);

  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  ASSERT_TRUE(reader.read_frame(luma)) << reader.message();

  EXPECT_EQ(luma, (Luma{255, 128, 0, 255}));
  EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kEndOfData);
}

TEST(Y4mReader, TellsHowMuchOfAFileIsRead) {
  const support::TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kMono, 40'000, 8));  // 560 kB
  Y4mReader reader;
  Luma luma(8);
  ASSERT_TRUE(reader.open(path));

  for (int frame = 0; frame < 20'000; ++frame) {
    ASSERT_TRUE(reader.read_frame(luma));
  }
  EXPECT_NEAR(reader.share_read(), 0.5, 0.13);  // it reads 64 KiB at a time
  const std::string memory = recording_text(kMono, 1, 8);
  ASSERT_TRUE(reader.open(source_of(memory), "m.y4m"));
  EXPECT_LT(reader.share_read(), 0.0);
}

TEST(Y4mReader, AcceptsFrameParameters) {
  Y4mReader reader;
  Luma luma(2);
  const std::string text = "YUV4MPEG2 W2 H1 Cmono\nFRAME Ip XCOMMENT\nab";

  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  ASSERT_TRUE(reader.read_frame(luma));

  EXPECT_EQ(luma, (Luma{'a', 'b'}));
}

TEST(Y4mReader, ReadsFilesPlainAndCompressed) {
  const support::TemporaryFolder folder;
  // Larger than the reader's buffer, so that it is refilled within a frame.
  const std::string text = recording_text("YUV4MPEG2 W400 H300 Cmono", 3, 120000);
  for (const std::string& path :
       {folder.write("a.y4m", text), folder.write("a.y4m.xz", compress_xz(text))}) {
    Y4mReader reader;
    Luma luma(120000);

    ASSERT_TRUE(reader.open(path)) << reader.message();
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_TRUE(reader.read_frame(luma)) << reader.message();
      EXPECT_EQ(luma[119999], (10 * frame + 119999) % 256);
    }
    EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kEndOfData);
  }
}

TEST(Y4mReader, UsesTheCompleteFramesOfACutRecording) {
  const std::string whole = recording_text(kMono, 2, 8);
  // Wherever the second frame is cut: within FRAME, before its line feed, within the pixels.
  for (const std::size_t missing :
       {std::size_t{1}, std::size_t{8}, std::size_t{9}, std::size_t{12}}) {
    const std::string text = whole.substr(0, whole.size() - missing);
    Y4mReader reader;
    Luma luma(8);
    ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
    ASSERT_TRUE(reader.read_frame(luma));

    const auto cut = reader.read_frame(luma);

    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error(), core::Error::kDataLoss) << missing;
    EXPECT_EQ(reader.message(), "a.y4m: cut short: only its first 1 frame is complete");
    EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kDataLoss) << "it stays";
  }
}

TEST(Y4mReader, CountsTheChromaOfACutFrame) {
  const std::string whole = recording_text("YUV4MPEG2 W4 H2", 3, 8, 4);
  const std::string text = whole.substr(0, whole.size() - 1);
  Y4mReader reader;
  Luma luma(8);
  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  ASSERT_TRUE(reader.read_frame(luma));
  ASSERT_TRUE(reader.read_frame(luma));

  EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kDataLoss);
  EXPECT_EQ(reader.message(), "a.y4m: cut short: only its first 2 frames are complete");
}

TEST(Y4mReader, UsesTheCompleteFramesOfACutCompressedRecording) {
  std::string text = "YUV4MPEG2 W400 H300 Cmono\n";
  std::uint32_t noise = 1;
  for (int frame = 0; frame < 3; ++frame) {
    text += "FRAME\n";
    for (int i = 0; i < 120000; ++i) {
      noise = noise * 1664525u + 1013904223u;
      text += static_cast<char>(noise >> 24);
    }
  }
  const std::string compressed = compress_xz(text);
  const std::string cut = compressed.substr(0, compressed.size() / 2);
  Y4mReader reader;
  Luma luma(120000);
  ASSERT_TRUE(reader.open(source_of(cut), "a.y4m.xz"));

  ASSERT_TRUE(reader.read_frame(luma));
  const auto second = reader.read_frame(luma);

  ASSERT_FALSE(second);
  EXPECT_EQ(second.error(), core::Error::kDataLoss);
  EXPECT_EQ(reader.message(), "a.y4m.xz: cut short: only its first 1 frame is complete");
}

TEST(Y4mReader, TellsCorruptCompressionEvenAfterTheLastFrame) {
  std::string compressed = compress_xz(recording_text(kMono, 2, 8));
  compressed.back() = 'x';  // the stream's footer
  Y4mReader reader;
  Luma luma(8);
  ASSERT_TRUE(reader.open(source_of(compressed), "a.y4m.xz"));
  ASSERT_TRUE(reader.read_frame(luma));
  ASSERT_TRUE(reader.read_frame(luma));

  const auto end = reader.read_frame(luma);

  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), core::Error::kIo);
  EXPECT_EQ(reader.message(), "a.y4m.xz: cannot be read after 2 frames: the xz data is corrupt");
}

/// Reads all frames; gives the error at the end and leaves the message.
core::Error end_of(Y4mReader& reader, const std::string& text, std::int64_t frames) {
  const auto opened = reader.open(source_of(text), "a.y4m");
  EXPECT_TRUE(opened) << reader.message();
  Luma luma(static_cast<std::size_t>(reader.header().luma_bytes()));
  while (true) {
    if (const auto frame = reader.read_frame(luma); !frame) {
      EXPECT_EQ(reader.frames_read(), frames);
      EXPECT_EQ(reader.read_frame(luma).error(), frame.error()) << "it stays";
      return frame.error();
    }
  }
}

TEST(Y4mReader, UsesTheCompleteFramesBeforeAGarbageTail) {
  const std::string whole = recording_text(kMono, 3, 8);
  const std::string first = "a.y4m: cut short: only its first 3 frames are complete, the ";
  for (const std::string& tail :
       {std::string("\n"), std::string("\r\n"), std::string(4096, '\0'), std::string("FRAMES\n"),
        std::string("FRAUD\n12345678"), std::string("garbage\nFRAME"), std::string(100000, 'F')}) {
    for (const bool compressed : {false, true}) {
      const std::string text = compressed ? compress_xz(whole + tail) : whole + tail;
      Y4mReader reader;

      EXPECT_EQ(end_of(reader, text, 3), core::Error::kDataLoss) << tail;

      EXPECT_EQ(reader.message(), first + std::to_string(tail.size()) +
                                      (tail.size() == 1 ? " byte behind them is no frame"
                                                        : " bytes behind them are no frame"));
    }
  }
  Y4mReader reader;
  EXPECT_EQ(end_of(reader, recording_text(kMono, 1, 8) + "x", 1), core::Error::kDataLoss);
  EXPECT_EQ(
      reader.message(),
      "a.y4m: cut short: only its first 1 frame is complete, the 1 byte behind it is no frame");
}

TEST(Y4mReader, CountsAFrameThatEndsInTheTailsValueAsIncomplete) {
  // As after a power cut: of the second frame a line and more is zeros, and zeros follow.
  const std::string whole = recording_text(kMono, 2, 8);
  const std::string cut = whole.substr(0, whole.size() - 5);
  Y4mReader reader;

  EXPECT_EQ(end_of(reader, cut + std::string(5 + 4096, '\0'), 1), core::Error::kDataLoss);
  EXPECT_EQ(reader.message(),
            "a.y4m: cut short: only its first 1 frame is complete, the next ends in bytes of one "
            "value as "
            "does the file");
  // Bytes of the line are still the camera's: the frame is used, and its dark end does no harm.
  EXPECT_EQ(end_of(reader, whole.substr(0, whole.size() - 3) + std::string(3 + 4096, '\0'), 2),
            core::Error::kDataLoss);
  // Black frames, as long as frames follow, are frames.
  const std::string black = "FRAME\n" + std::string(8, '\0');
  EXPECT_EQ(end_of(reader, std::string(kMono) + "\n" + black + black, 2), core::Error::kEndOfData);
  EXPECT_EQ(end_of(reader, std::string(kMono) + "\n" + black + std::string(9, '\0'), 0),
            core::Error::kDataLoss);
  EXPECT_EQ(reader.message(), "a.y4m: cut short within its first frame");
}

TEST(Y4mReader, TellsCorruptCompressionBehindAGarbageTail) {
  std::string compressed = compress_xz(recording_text(kMono, 2, 8) + std::string(4096, '\0'));
  compressed.back() = 'x';  // the stream's footer
  Y4mReader reader;

  EXPECT_EQ(end_of(reader, compressed, 1), core::Error::kIo);
  EXPECT_EQ(reader.message(), "a.y4m: cannot be read after 2 frames: the xz data is corrupt");
}

TEST(Y4mReader, TellsGarbageThatFramesFollow) {
  const std::string whole = recording_text(kMono, 4, 8);
  const std::size_t frame = 6 + 8;
  const std::size_t second = std::string(kMono).size() + 1 + frame;
  struct Spoilt {
    std::string text;
    int told;  ///< frames; the last of them is not delivered, as it may be what lacks bytes
  };
  std::string fraud = whole;
  fraud.replace(second, 5, "FRAUD");
  std::string surplus = whole;
  surplus.insert(second, 1, '\n');
  std::string zeros = whole;
  zeros.insert(second + frame, 100, '\0');
  std::string missing = whole;
  missing.erase(second + 8, 3);
  // Here the last FRAME line stands within the third frame as it is read, or over its end; none
  // follows.
  std::string missing_near_the_end = whole;
  missing_near_the_end.erase(second + frame + 6, 7);
  std::string few_missing_near_the_end = whole;
  few_missing_near_the_end.erase(second + frame + 8, 3);
  for (const auto& [text, told] :
       {Spoilt{fraud, 1}, Spoilt{surplus, 1}, Spoilt{zeros, 2}, Spoilt{missing, 2},
        Spoilt{missing_near_the_end, 3}, Spoilt{few_missing_near_the_end, 3},
        Spoilt{std::string(kMono) + "\nx" + whole, 0}}) {
    Y4mReader reader;

    EXPECT_EQ(end_of(reader, text, std::max(told - 1, 0)), core::Error::kIo) << text;

    EXPECT_EQ(reader.message(), "a.y4m: corrupt after " + std::to_string(told) +
                                    " frames: expected a line that begins with 'FRAME'");
  }
  Y4mReader reader;
  EXPECT_EQ(end_of(reader, whole + whole, 3), core::Error::kIo);
  EXPECT_EQ(reader.message(),
            "a.y4m: corrupt after 4 frames: a second header, expected one recording in a file");
}

TEST(Y4mReader, TellsAWrongColourParameter) {
  const std::string wrong = "a.y4m: header parameter C is wrong: it says ";
  Y4mReader reader;

  for (const int frames : {2, 3}) {
    EXPECT_EQ(end_of(reader, recording_text("YUV4MPEG2 W8 H4", frames, 32), 0),
              core::Error::kInvalidArgument);
    EXPECT_EQ(reader.message(),
              wrong + "C420, but a FRAME line stands where chroma should be, as in Cmono");
  }
  // The first frame by that header is longer than the file.
  EXPECT_EQ(end_of(reader, recording_text("YUV4MPEG2 W8 H4 C444", 2, 32), 0),
            core::Error::kInvalidArgument);
  EXPECT_EQ(reader.message(),
            wrong + "C444, but a FRAME line stands where chroma should be, as in Cmono");
  EXPECT_EQ(end_of(reader, recording_text("YUV4MPEG2 W8 H4 Cmono", 2, 32, 16), 0),
            core::Error::kInvalidArgument);
  EXPECT_EQ(reader.message(),
            wrong + "Cmono, but a FRAME line stands as far behind the first as in C420");
  EXPECT_EQ(end_of(reader, recording_text("YUV4MPEG2 W8 H4 C422", 3, 32, 16), 0),
            core::Error::kInvalidArgument);
  EXPECT_EQ(reader.message(),
            wrong + "C422, but a FRAME line stands as far behind the first as in C420");
}

TEST(Y4mReader, TellsATransferInTextMode) {
  const std::string words =
      "a.y4m: damaged by a transfer in text mode: a line ends in CR LF, expected LF alone";
  const std::string whole = recording_text(kMono, 2, 8);
  Y4mReader reader;

  std::string header = whole;
  header.insert(std::string(kMono).size(), "\r");
  EXPECT_EQ(reader.open(source_of(header), "a.y4m").error(), core::Error::kInvalidArgument);
  EXPECT_EQ(reader.message(), words);
  std::string frames = whole;
  frames.insert(std::string(kMono).size() + 6, "\r");
  EXPECT_EQ(end_of(reader, frames, 0), core::Error::kIo);
  EXPECT_EQ(reader.message(), words);
}

TEST(Y4mReader, ServesLongLinesUpToALimit) {
  const std::string frame = recording_text("", 1, 8).substr(1);
  Y4mReader reader;

  const auto with_header_of = [&](std::size_t bytes) {
    const std::string start = std::string(kMono) + " X";
    return start + std::string(bytes - start.size(), 'a') + "\n" + frame;
  };
  EXPECT_EQ(end_of(reader, with_header_of(65535), 1), core::Error::kEndOfData);
  EXPECT_EQ(reader.open(source_of(with_header_of(65537)), "a.y4m").error(),
            core::Error::kUnsupported);
  EXPECT_EQ(reader.message(),
            "a.y4m: header longer than 65536 bytes, expected a line feed within them");
  // Were its beginning taken for the whole line, the rest would be taken for pixels.
  EXPECT_EQ(end_of(reader, std::string(kMono) + "\nFRAME X" + std::string(70000, 'a') + "\n", 0),
            core::Error::kUnsupported);
  EXPECT_EQ(reader.message(), "a.y4m: FRAME line longer than 65536 bytes after 0 frames");
}

TEST(Y4mReader, TellsWhatIsNoRecording) {
  const support::TemporaryFolder folder;
  Y4mReader reader;

  EXPECT_EQ(reader.open(folder.path("none.y4m")).error(), core::Error::kIo);
  EXPECT_EQ(reader.message(),
            folder.path("none.y4m") + ": cannot be read: No such file or directory");
  const std::string path = folder.write("a.y4m", "field,row\n1,2\n");
  EXPECT_EQ(reader.open(path).error(), core::Error::kInvalidArgument);
  EXPECT_EQ(reader.message(),
            path + ": not a YUV4MPEG2 file: expected the first line to begin with 'YUV4MPEG2 '");
  const std::string header = "YUV4MPEG2 W4 H2";
  EXPECT_EQ(reader.open(source_of(header), "b.y4m").error(), core::Error::kDataLoss);
  EXPECT_EQ(reader.message(), "b.y4m: cut short within its header");
}

TEST(Y4mReader, RefusesWithoutARecordingOrRoom) {
  Y4mReader reader;
  Luma luma(7);

  EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kNotReady);
  const std::string text = recording_text(kMono, 1, 8);
  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kBufferTooSmall);
}

}  // namespace
}  // namespace tubesight::drivers
