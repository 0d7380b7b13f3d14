#include "drivers/recording/file_recording_store.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "tests/support/events.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::FieldStatus;
using core::Parity;
using support::TemporaryFolder;

constexpr std::int32_t kWidth = 64;
constexpr std::int32_t kHeight = 64;

/// Gives a store the fields of a box whose camera's picture has the field's number all over.
class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    head_.width_px = kWidth;
    head_.height_px = kHeight;
    head_.fields = 8;
    head_.state = state_;
  }

  [[nodiscard]] core::Result<void> add(std::int64_t number, FieldStatus status = FieldStatus::kGood,
                                       const std::vector<core::Event>& events = {}) {
    std::fill(frame_.begin(), frame_.end(), static_cast<std::uint8_t>(number));
    core::Field field;
    field.number = number;
    field.status = status;
    field.parity = number % 2 == 0 ? Parity::kEven : Parity::kOdd;
    field.sequence = status == FieldStatus::kMissing ? 0 : 5000 - number;  // a camera may do so
    field.mid_exposure = core::FieldTime(1'000'000'007 + number);
    field.lamp_permille = 640;
    if (status != FieldStatus::kMissing) {
      field.pixels = core::field_of({frame_.data(), kWidth, kHeight, kWidth}, field.parity);
    }
    return store_.add(field, events);
  }

  [[nodiscard]] core::CameraSettings camera() const {
    core::CameraSettings camera;
    camera.width_px = kWidth;
    camera.height_px = kHeight;
    return camera;
  }

  TemporaryFolder folder_;
  FileRecordingStore store_{folder_.path("."), 1, "format = 1\n",
                            [] { return std::int64_t{1'796'000'467}; }};
  std::array<std::byte, 3> state_{std::byte{1}, std::byte{0}, std::byte{255}};
  hal::RecordingHead head_;
  std::vector<std::uint8_t> frame_ = std::vector<std::uint8_t>(kWidth * kHeight);
};

TEST_F(StoreTest, WritesWhatReplayReadsBackExactly) {
  ASSERT_TRUE(store_.open());
  ASSERT_TRUE(store_.begin(head_));
  ASSERT_TRUE(add(40));
  ASSERT_TRUE(add(41, FieldStatus::kDamaged));
  ASSERT_TRUE(add(42, FieldStatus::kMissing));
  ASSERT_TRUE(add(43));
  ASSERT_TRUE(add(44));  // its frame's other field was no step
  ASSERT_TRUE(add(46));
  ASSERT_TRUE(add(47));
  ASSERT_TRUE(store_.finish());

  EXPECT_EQ(folder_.names().size(), 5U);
  const std::string path = store_.path();
  EXPECT_EQ(path, folder_.path("./box-000001-20261130T010107Z-command"));
  EXPECT_EQ(folder_.read("box-000001-20261130T010107Z-command.state"), std::string("\1\0\377", 3));
  EXPECT_EQ(folder_.read("box-000001-20261130T010107Z-command.session.toml"), "format = 1\n");
  ReplayFrameGrabber grabber(camera(), path + ".y4m");
  grabber.follow_rows();
  ASSERT_TRUE(grabber.start()) << grabber.messages().front();
  for (const std::int64_t number : {40, 41, 42, 43, 44, 46, 47}) {
    const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
    ASSERT_TRUE(lease) << (grabber.messages().empty() ? "" : grabber.messages().front());
    const core::Field& field = lease->field();
    EXPECT_EQ(field.number, number);
    EXPECT_EQ(field.parity, number % 2 == 0 ? Parity::kEven : Parity::kOdd);
    EXPECT_EQ(field.mid_exposure.count(), 1'000'000'007 + number);
    EXPECT_EQ(field.lamp_permille, 640);
    if (number == 42) {
      EXPECT_EQ(field.status, FieldStatus::kMissing);
      continue;
    }
    EXPECT_EQ(field.status, number == 41 ? FieldStatus::kDamaged : FieldStatus::kGood);
    EXPECT_EQ(field.sequence, 5000 - number);
    EXPECT_EQ(field.pixels.pixels[kWidth - 1], number);
  }
  EXPECT_EQ(grabber.grab_for(std::chrono::milliseconds(0)).error(), Error::kEndOfData);
}

TEST_F(StoreTest, WritesEventsExactly) {
  core::Event start = tests::event_of(core::Start{}, core::EventOrigin::kRobot);
  start.id = -4;
  start.at = core::FieldTime(999'999'999);
  auto& content = std::get<core::Start>(start.content);
  ASSERT_TRUE(content.tubes.try_push_back({{1, 2}, {100.0 / 3.0, 1e-9}}));
  content.seen_field = 1'000'000;  // nonsense that a robot may send, and the session refuses
  core::Event lamp = tests::event_of(core::LampCommand{300}, core::EventOrigin::kOperator);
  ASSERT_TRUE(store_.begin(head_));
  ASSERT_TRUE(add(40));
  ASSERT_TRUE(add(41, FieldStatus::kGood, {start, lamp}));
  ASSERT_TRUE(store_.finish());

  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.load_beside(store_.path() + ".y4m", messages)) << messages.front();
  core::EventList list;
  events.take_before(40, list);
  EXPECT_TRUE(list.empty());
  events.take_before(41, list);
  ASSERT_EQ(list.size(), 2);
  EXPECT_EQ(list[0].id, -4);
  EXPECT_EQ(list[0].origin, core::EventOrigin::kRobot);
  EXPECT_EQ(list[0].at, core::FieldTime(999'999'999));
  const auto back = tests::content_of<core::Start>(list[0]);
  ASSERT_EQ(back.tubes.size(), 1);
  EXPECT_EQ(back.tubes[0].at_px, (std::array{100.0 / 3.0, 1e-9}));
  EXPECT_EQ(back.seen_field, 1'000'000);
  EXPECT_EQ(list[1].origin, core::EventOrigin::kOperator);
}

TEST_F(StoreTest, LeavesNothingOfWhatWasNotFinished) {
  ASSERT_TRUE(store_.begin(head_));
  ASSERT_TRUE(add(0));
  EXPECT_FALSE(folder_.names().empty()) << "unfinished files";
  ASSERT_TRUE(store_.begin(head_));
  ASSERT_TRUE(add(0));
  ASSERT_TRUE(store_.finish());
  EXPECT_EQ(folder_.names().size(), 5U);
  EXPECT_EQ(store_.finish().error(), Error::kNotReady);
}

TEST_F(StoreTest, KeepsTheFolderWithinItsBound) {
  // The store holds a megabyte: one of these, and what eight fields take.
  folder_.write("box-000001-20261130T010107Z-command.y4m", std::string(600'000, 'x'));
  folder_.write("box-000002-20261130T010107Z-command.y4m", std::string(500'000, 'x'));
  ASSERT_TRUE(store_.open());
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(store_.begin(head_));
    for (std::int64_t number = 0; number < 8; ++number) {
      ASSERT_TRUE(add(number));
    }
    ASSERT_TRUE(store_.finish());
  }
  const auto names = folder_.names();
  EXPECT_EQ(names.size(), 1U + 4U * 5U);
  EXPECT_EQ(std::count(names.begin(), names.end(), "box-000006-20261130T010107Z-command.y4m"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "box-000002-20261130T010107Z-command.y4m"), 1);
}

TEST_F(StoreTest, RefusesARecordingThatNeverFits) {
  head_.fields = 10'000;
  EXPECT_EQ(store_.begin(head_).error(), Error::kOutOfRange);
  EXPECT_NE(store_.message().find("bytes, expected at most the 1048576"), std::string::npos);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(StoreTest, LeavesRemainsThatTheNextBoxRemovesWhenItIsKilled) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const bool begun = store_.begin(head_) && add(0) && add(1) && add(2);
    static_cast<void>(::kill(::getpid(), begun ? SIGKILL : SIGTERM));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  EXPECT_EQ(folder_.names().size(), 5U);
  folder_.write("notes.y4m.1-0.part", "of somebody else");

  ASSERT_TRUE(store_.open());

  EXPECT_EQ(folder_.names(), std::vector<std::string>{"notes.y4m.1-0.part"});
}

/// Files of this process end at so many bytes, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit limit{bytes, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(StoreTest, LeavesNothingOnAFullDiskAndTellsWhy) {
  {
    const FileSizeLimit limit(6000);
    ASSERT_TRUE(store_.begin(head_));
    core::Result<void> result;
    for (std::int64_t number = 0; number < 8 && result; ++number) {
      result = add(number);
    }
    if (result) {
      result = store_.finish();
    }
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error(), Error::kIo);
  }
  EXPECT_NE(store_.message().find(".y4m: cannot be written: "), std::string::npos)
      << store_.message();
  EXPECT_TRUE(folder_.names().empty());
  ASSERT_TRUE(store_.begin(head_));
  ASSERT_TRUE(add(0));
  EXPECT_TRUE(store_.finish()) << "there is room again";
}

}  // namespace
}  // namespace tubesight::drivers
