#include "board/bench/output/still_reader.h"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using drivers::GreyPicture;
using support::TemporaryFolder;

TEST(ParseFrames, TakesARangeOrOneFrame) {
  FrameRange frames;
  EXPECT_TRUE(parse_frames("3-12", frames));
  EXPECT_EQ(frames.first, 3);
  EXPECT_EQ(frames.last, 12);
  EXPECT_TRUE(parse_frames("7", frames));
  EXPECT_EQ(frames.first, 7);
  EXPECT_EQ(frames.last, 7);
}

TEST(ParseFrames, TakesNothingElse) {
  FrameRange frames;
  for (const char* text :
       {"", "-", "-1", "1-", "3-2", "a", "1-b", "1,2", " 1", "1-2-3", "100000", "0-100000"}) {
    EXPECT_FALSE(parse_frames(text, frames)) << text;
  }
}

TEST(StillsOf, PicturesStandOnceAndRecordingsForEachFrame) {
  const std::array<std::string, 3> files = {"a.png", "b.y4m", "c.y4m.xz"};

  std::vector<std::string> names;
  for (const Still& still : stills_of(files, {4, 5})) {
    names.push_back(still.name());
  }

  EXPECT_EQ(names, (std::vector<std::string>{"a.png", "b.y4m frame 4", "b.y4m frame 5",
                                             "c.y4m.xz frame 4", "c.y4m.xz frame 5"}));
}

class StillReaderTest : public ::testing::Test {
 protected:
  /// Two pixels a frame: 10 times the frame's number, and that plus 1.
  void SetUp() override {
    std::string text = "YUV4MPEG2 W2 H1 F30:1 Cmono\n";
    for (int frame = 0; frame < 5; ++frame) {
      text += "FRAME\n";
      text += static_cast<char>(10 * frame);
      text += static_cast<char>(10 * frame + 1);
    }
    folder_.write("r.y4m", text);
    folder_.write("cut.y4m", text.substr(0, text.size() - 1));
  }

  core::Result<void> read(const std::string& file, std::int64_t frame) {
    return reader_.read({folder_.path(file), frame}, picture_, message_);
  }

  TemporaryFolder folder_;
  StillReader reader_;
  GreyPicture picture_;
  std::string message_;
};

TEST_F(StillReaderTest, FramesComeInAnyOrder) {
  for (const int frame : {1, 3, 3, 0, 4}) {
    ASSERT_TRUE(read("r.y4m", frame)) << message_;
    EXPECT_EQ(picture_.width_px, 2);
    EXPECT_EQ(picture_.height_px, 1);
    EXPECT_EQ(picture_.pixels,
              (std::vector<std::uint8_t>{static_cast<std::uint8_t>(10 * frame),
                                         static_cast<std::uint8_t>(10 * frame + 1)}));
  }
}

TEST_F(StillReaderTest, AFrameBehindTheEndIsSaidSoAndTheNextIsReadAgain) {
  const auto behind = read("r.y4m", 5);
  ASSERT_FALSE(behind);
  EXPECT_EQ(behind.error(), core::Error::kOutOfRange);
  EXPECT_EQ(message_, folder_.path("r.y4m") +
                          ": has no frame 5, expected --frames within its 5, counted from 0");

  EXPECT_TRUE(read("r.y4m", 2)) << message_;
  EXPECT_EQ(picture_.pixels[0], 20);
}

TEST_F(StillReaderTest, OfACutRecordingTheWholeFramesAreRead) {
  EXPECT_TRUE(read("cut.y4m", 3)) << message_;

  const auto cut = read("cut.y4m", 4);

  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error(), core::Error::kDataLoss);
  EXPECT_EQ(message_.find(folder_.path("cut.y4m")), 0U) << message_;
}

}  // namespace
}  // namespace tubesight::board
