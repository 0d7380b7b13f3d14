#include "board/visionbox/recording_writer.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/visionbox/wakeup.h"
#include "core/base/image_view.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

/// A recorder that is given fields, and its writer.
class WriterTest : public ::testing::Test {
 protected:
  WriterTest() {
    session_->camera.width_px = kWidth;
    session_->camera.height_px = kHeight;
    session_->camera.scan = core::Scan::kProgressive;
    settings_.folder = folder_.path("kept");
    settings_.disk_mb = 16;
    settings_.recorder.memory_mb = 4;
    settings_.recorder.fields_after = 0;
  }
  ~WriterTest() override {
    if (writer_ != nullptr) {
      writer_->stop();
    }
  }

  void start() {
    ASSERT_TRUE(recorder_.configure(settings_.recorder, session_->camera, 100));
    recorder_.put_state(recorder_.state_wanted().size());
    writer_ = std::make_unique<RecordingWriter>(
        recorder_, settings_, *session_, "recorded in boot 17", [this](const std::string& line) {
          const std::lock_guard lock(mutex_);
          said_ += line + "\n";
        });
    writer_->start();
  }

  /// A field that is kept; the number of the request for it.
  std::uint32_t record() {
    const std::uint32_t number = recorder_.request();
    input_->field.number = 2 * next_++;
    input_->field.parity = core::Parity::kProgressive;
    input_->field.pixels =
        core::field_of({pixels_.data(), kWidth, kHeight, kWidth}, core::Parity::kProgressive);
    recorder_.take(*input_, *output_);
    const auto state = recorder_.state_wanted();
    if (!state.empty()) {
      recorder_.put_state(state.size());
    }
    return number;
  }

  RecordAnswer wait_for(std::uint32_t number) const {
    const MonotonicTime until = monotonic_now() + std::chrono::seconds(20);
    RecordAnswer answer = writer_->answer(number);
    while (answer.state == RecordAnswer::State::kPending && monotonic_now() < until) {
      sleep_until(monotonic_now() + std::chrono::milliseconds(5));
      answer = writer_->answer(number);
    }
    return answer;
  }

  std::string said() {
    const std::lock_guard lock(mutex_);
    return said_;
  }

  static constexpr std::int32_t kWidth = 160;
  static constexpr std::int32_t kHeight = 120;

  support::TemporaryFolder folder_;
  std::unique_ptr<core::SessionSettings> session_ = std::make_unique<core::SessionSettings>();
  RecordSettings settings_;
  EventRecorder recorder_;
  std::unique_ptr<RecordingWriter> writer_;
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  std::vector<std::uint8_t> pixels_ =
      std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth) * kHeight, 9);
  std::int64_t next_ = 0;
  std::mutex mutex_;
  std::string said_;
};

TEST_F(WriterTest, WritesAndSaysWhere) {
  std::filesystem::create_directory(settings_.folder);
  start();
  const RecordAnswer answer = wait_for(record());

  ASSERT_EQ(answer.state, RecordAnswer::State::kWritten) << answer.words;
  EXPECT_TRUE(std::filesystem::exists(answer.words + ".y4m"));
  EXPECT_TRUE(std::filesystem::exists(answer.words + ".session.toml"));
  std::string first;
  std::getline(std::ifstream(answer.words + ".session.toml"), first);
  EXPECT_EQ(first, "# recorded in boot 17") << "who made it, and when";
  const RecorderReport report = writer_->report();
  EXPECT_TRUE(report.open);
  EXPECT_EQ(report.last, answer.words);
  EXPECT_EQ(report.trouble, "");
  EXPECT_EQ(report.room_mb, 16) << "the bound of all recordings";
  EXPECT_EQ(report.counters.written, 1U);
  EXPECT_EQ(said(), "recorder: written, " + answer.words + "\n");
}

TEST_F(WriterTest, AFolderThatComesLaterGetsWhatWaited) {
  start();
  const std::uint32_t number = record();
  const RecordAnswer waits = wait_for(number);
  EXPECT_EQ(waits.state, RecordAnswer::State::kWaits) << "it is not lost";
  EXPECT_TRUE(waits.words.starts_with("not written yet, waits for the folder: " + settings_.folder +
                                      ": cannot be read: "))
      << waits.words;
  RecorderReport report = writer_->report();
  EXPECT_FALSE(report.open);
  EXPECT_NE(report.trouble.find("kept: cannot be read"), std::string::npos);

  std::filesystem::create_directory(settings_.folder);
  const MonotonicTime until = monotonic_now() + std::chrono::seconds(20);
  do {
    sleep_until(monotonic_now() + std::chrono::milliseconds(20));
    report = writer_->report();
  } while (report.counters.written == 0 && monotonic_now() < until);

  EXPECT_TRUE(report.open);
  EXPECT_EQ(report.trouble, "");
  EXPECT_EQ(writer_->answer(number).state, RecordAnswer::State::kWritten);
  const std::string lines = said();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2) << "told once each: " << lines;
}

TEST_F(WriterTest, ADiskThatGoesIsTriedAgain) {
  std::filesystem::create_directory(settings_.folder);
  start();
  ASSERT_EQ(wait_for(record()).state, RecordAnswer::State::kWritten);
  std::filesystem::remove_all(settings_.folder);
  const RecordAnswer failed = wait_for(record());
  EXPECT_EQ(failed.state, RecordAnswer::State::kNotWritten);
  EXPECT_NE(failed.words.find("kept: cannot be read"), std::string::npos) << failed.words;
  EXPECT_EQ(writer_->report().counters.failed, 1U);
  EXPECT_NE(writer_->report().trouble, "");

  std::filesystem::create_directory(settings_.folder);
  EXPECT_EQ(wait_for(record()).state, RecordAnswer::State::kWritten);
  EXPECT_EQ(writer_->report().trouble, "");
}

TEST_F(WriterTest, WhoWaitsWhenItEndsHearsThatNothingCame) {
  std::filesystem::create_directory(settings_.folder);
  start();
  const std::uint32_t number = recorder_.request();  // no field shows it
  writer_->stop();
  EXPECT_EQ(writer_->answer(number).state, RecordAnswer::State::kNotWritten);
  EXPECT_EQ(writer_->answer(number).words, "the box ended before it was written");
}

TEST_F(WriterTest, AFolderThatNeverCameIsSaidWhenItEnds) {
  start();
  const std::uint32_t number = record();
  writer_->stop();
  const RecordAnswer answer = writer_->answer(number);
  EXPECT_EQ(answer.state, RecordAnswer::State::kNotWritten);
  EXPECT_TRUE(answer.words.starts_with("the box ended before it was written: " + settings_.folder +
                                       ": cannot be read"))
      << answer.words;
}

TEST_F(WriterTest, ASecondBoxWaitsUntilTheFirstIsGone) {
  std::filesystem::create_directory(settings_.folder);
  auto first = std::make_unique<drivers::RecordingFolder>(settings_.folder, 1 << 20);
  ASSERT_TRUE(first->open());
  start();
  const std::uint32_t number = record();
  const std::string why = settings_.folder + ": another box records there";
  EXPECT_NE(wait_for(number).words.find(why), std::string::npos) << wait_for(number).words;
  EXPECT_EQ(said(), "recorder: " + why + "\n");
  first.reset();

  const MonotonicTime until = monotonic_now() + std::chrono::seconds(20);
  while (writer_->answer(number).state != RecordAnswer::State::kWritten &&
         monotonic_now() < until) {
    sleep_until(monotonic_now() + std::chrono::milliseconds(20));
  }
  EXPECT_EQ(writer_->answer(number).state, RecordAnswer::State::kWritten);
}

TEST_F(WriterTest, WhatWasHandedOverIsWrittenBeforeItEnds) {
  std::filesystem::create_directory(settings_.folder);
  start();
  const std::uint32_t number = record();
  writer_->stop();

  EXPECT_EQ(writer_->answer(number).state, RecordAnswer::State::kWritten);
}

TEST(TooMuchMemory, IsMoreThanHalfOfTheMachines) {
  RecordSettings record;
  record.recorder.memory_mb = 513;
  EXPECT_EQ(too_much_memory(record, 1024), "") << "nothing is recorded";
  record.folder = "/var";
  EXPECT_EQ(too_much_memory(record, 1024),
            "record.memory_mb: 513, expected at most 512, half of this machine's memory");
  EXPECT_EQ(too_much_memory(record, 1026), "");
  EXPECT_EQ(too_much_memory(record, 0), "") << "not known";
  EXPECT_GT(machine_memory_mb(), 64);
}

}  // namespace
}  // namespace tubesight::board
