#include "board/bench/output/progress_line.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include "board/bench/output/text_output.h"

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A stream whose bytes can be read back.
class Stream {
 public:
  Stream() : file_(std::tmpfile()) {}
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { std::fclose(file_); }

  [[nodiscard]] std::FILE* file() const { return file_; }
  [[nodiscard]] std::string text() const {
    std::fflush(file_);
    const long end = std::ftell(file_);
    std::rewind(file_);
    std::array<char, 1000> bytes{};
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file_);
    std::fseek(file_, end, SEEK_SET);
    return {bytes.data(), count};
  }

 private:
  std::FILE* file_;
};

constexpr ProgressLine::Clock::time_point kStart{seconds(1000)};

TEST(ProgressLine, WritesNothingWhenItIsNotShown) {
  const Stream stream;
  {
    ProgressLine line(stream.file(), false);
    line.update(kStart, 1, seconds(0));
    line.update(kStart + seconds(10), 500, seconds(10));
  }

  EXPECT_EQ(stream.text(), "");
}

TEST(ProgressLine, TellsTheTimeThatIsLeft) {
  EXPECT_EQ(share_words(0.25, seconds(10)), "25 %, 0:30 left");
  EXPECT_EQ(share_words(0.5, seconds(4000)), "50 %, 1:06:40 left");
  EXPECT_EQ(share_words(1.0, seconds(10)), "100 %, 0:00 left");
  EXPECT_EQ(share_words(-1.0, seconds(10)), "");
  EXPECT_EQ(share_words(0.0, seconds(10)), "");
  EXPECT_EQ(share_words(0.5, milliseconds(500)), "");
  EXPECT_EQ(share_words(1e-9, seconds(10)), "0 %, 99:59:59 left");
}

TEST(ProgressLine, SaysTheShareBehindTheFields) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, 1, seconds(0), 0.0);
  line.update(kStart + seconds(10), 500, seconds(10), 0.2);

  EXPECT_EQ(stream.text(), "\r500 fields, 10.0 s of the recording, 20 %, 0:40 left");
}

TEST(ProgressLine, SaysWordsOfAnotherJobOverLongerOnes) {
  const Stream stream;
  {
    ProgressLine line(stream.file(), true);
    line.update(kStart, "view 1 of 12");
    line.update(kStart + seconds(1), "view 10 of 12");
    line.update(kStart + seconds(1) + milliseconds(249), "view 11 of 12");
    line.update(kStart + seconds(2), "view 12");
  }

  EXPECT_EQ(stream.text(), "\rview 10 of 12\rview 12      \r             \r");
}

TEST(ProgressLine, SaysThePaceWhereNobodyKnowsTheEnd) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, 1, seconds(0));
  line.update(kStart + seconds(2), 500, seconds(10));

  EXPECT_EQ(stream.text(), "\r500 fields, 10.0 s of the recording, 250 fields a second");
}

TEST(ProgressLine, SaysTheShareOfAnyJob) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, "view 1 of 4", 0.0);
  line.update(kStart + seconds(3), "view 2 of 4", 0.25);
  line.update(kStart + seconds(6), std::string(90, 'x'), 0.5);

  EXPECT_EQ(stream.text(),
            "\rview 2 of 4, 25 %, 0:09 left\r" + std::string(62, 'x') + ", 50 %, 0:06 left");
}

TEST(ProgressLine, GivesWayToAMessage) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, "view 1");
  line.update(kStart + seconds(1), "view 2");
  testing::internal::CaptureStderr();

  tell("a message");

  EXPECT_EQ(stream.text(), "\rview 2\r      \r");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "a message\n");
}

TEST(ProgressLine, WritesNothingForAShortJob) {
  const Stream stream;
  {
    ProgressLine line(stream.file(), true);
    line.update(kStart, 1, seconds(0));
    line.update(kStart + milliseconds(499), 500, seconds(10));
  }

  EXPECT_EQ(stream.text(), "");
}

TEST(ProgressLine, WritesFourTimesASecondAtMost) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, 1, seconds(0));
  line.update(kStart + milliseconds(500), 9, milliseconds(1500));
  line.update(kStart + milliseconds(749), 10, milliseconds(1600));
  line.update(kStart + milliseconds(750), 100, milliseconds(16000));

  EXPECT_EQ(stream.text(),
            "\r9 fields, 1.5 s of the recording"
            "\r100 fields, 16.0 s of the recording");
}

TEST(ProgressLine, IsErasedToItsLastCharacter) {
  const Stream stream;
  {
    ProgressLine line(stream.file(), true);
    line.update(kStart, 1, seconds(0));
    line.update(kStart + milliseconds(600), 100, seconds(16));
    line.update(kStart + milliseconds(900), 9, seconds(1));  // shorter: padded to cover the other
  }

  const std::string first = "100 fields, 16.0 s of the recording";
  const std::string second = "9 fields, 1.0 s of the recording   ";
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(stream.text(),
            "\r" + first + "\r" + second + "\r" + std::string(first.size(), ' ') + "\r");
}

TEST(ProgressLine, SaysTheWordsOfAnyJobOverThoseBefore) {
  const Stream stream;
  ProgressLine line(stream.file(), true);
  line.update(kStart, "docking 1 of 12");
  line.update(kStart + seconds(1), "docking 10 of 12");
  line.update(kStart + seconds(2), "check");

  // The shorter one is padded to what stood there.
  EXPECT_EQ(stream.text(), "\rdocking 10 of 12\rcheck           ");
}

}  // namespace
}  // namespace tubesight::board
