#include "drivers/files/y4m_reader.h"

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

TEST(Y4mReader, TellsAFrameThatIsNone) {
  const std::string text = recording_text(kMono, 1, 8) + "FRAMES\n";
  Y4mReader reader;
  Luma luma(8);
  ASSERT_TRUE(reader.open(source_of(text), "a.y4m"));
  ASSERT_TRUE(reader.read_frame(luma));

  EXPECT_EQ(reader.read_frame(luma).error(), core::Error::kIo);
  EXPECT_EQ(reader.message(),
            "a.y4m: corrupt after 1 frames: expected a line that begins with 'FRAME'");
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
