#include "drivers/ffmpeg/ffmpeg_words.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(FfmpegWords, SayWhatAFileOfSoundAloneLacks) {
  FfmpegWords words;
  words.take(
      "Stream map '0:v:0' matches no streams.\nTo ignore this, add a trailing '?' to the map.\n");
  EXPECT_EQ(words.in_one_line("x"), "it holds no picture");
}

TEST(FfmpegWords, SaysCauseAndOutcomeInOneLine) {
  FfmpegWords words;

  words.take("[mov,mp4,m4a,3gp,3g2,mj2 @ 0x55d0c0f] moov atom not fo");
  words.take("und\nsomething between\nfile:/dev/fd/4: Invalid data found\n");

  EXPECT_EQ(words.in_one_line("/dev/fd/4"), "moov atom not found; Invalid data found");
}

TEST(FfmpegWords, SaysASingleLineOnce) {
  FfmpegWords words;

  words.take("No such stream");  // without a line feed

  EXPECT_FALSE(words.empty());
  EXPECT_EQ(words.in_one_line("x"), "No such stream");
}

TEST(FfmpegWords, KeepsBracketsThatAreNoObject) {
  FfmpegWords words;

  words.take("[start] is no object\n");

  EXPECT_EQ(words.in_one_line("x"), "[start] is no object");
}

TEST(FfmpegWords, StaysShortAndPrintable) {
  FfmpegWords words;

  words.take("a\tb\x1B[31m\n" + std::string(100'000, 'z') + "\n");

  const std::string text = words.in_one_line("x");
  EXPECT_TRUE(text.starts_with("a?b?[31m; zzz"));
  EXPECT_EQ(text.size(), 300U);
}

TEST(FfmpegWords, IsEmptyAtFirst) {
  const FfmpegWords words;

  EXPECT_TRUE(words.empty());
  EXPECT_EQ(words.in_one_line("x"), "");
}

}  // namespace
}  // namespace tubesight::drivers
