// A turn allocates nothing: the heap guard is armed around turns over the shipped recording, with a
// robot and an operator that ask in every field, a lamp, a display, a pose service and a recorder.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/box/box_loop.h"
#include "board/box/journal_desk.h"
#include "board/box/pair_desk.h"
#include "board/box/pose_service.h"
#include "drivers/files/messages.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_settings.h"
#include "tests/support/events.h"
#include "tests/support/fake_clock.h"
#include "tests/support/heap_guard.h"

namespace tubesight::board {
namespace {

using core::Result;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";
constexpr std::chrono::milliseconds kTimeout{0};

/// A recording held in memory; then the camera falls silent for some fields.
class MemoryGrabber final : public hal::FrameGrabber {
 public:
  void keep(const core::Field& field) {
    kept_.push_back({field, {}});
    const core::FieldView& lines = field.pixels;
    for (std::int32_t i = 0; i < lines.lines; ++i) {
      const std::uint8_t* const line =
          lines.pixels + static_cast<std::ptrdiff_t>(i) * lines.stride_px;
      kept_.back().pixels.insert(kept_.back().pixels.end(), line, line + lines.width_px);
    }
  }
  Result<void> start() override { return {}; }
  void stop() override {}
  Result<hal::FieldLease> grab_for(std::chrono::milliseconds) override {
    constexpr int kSilent = 6;
    if (next_ == kept_.size()) {
      return core::Unexpected(++late_ <= kSilent ? core::Error::kTimeout : core::Error::kEndOfData);
    }
    Kept& kept = kept_[next_++];
    kept.field.pixels.pixels = kept.pixels.data();
    kept.field.pixels.stride_px = kept.field.pixels.width_px;
    return hal::FieldLease(*this, 0, kept.field);
  }
  void give_back(std::int32_t) override {}

 private:
  struct Kept {
    core::Field field;
    std::vector<std::uint8_t> pixels;
  };

  std::vector<Kept> kept_;
  std::size_t next_ = 0;
  int late_ = 0;
};

/// Asks one thing a turn, the kinds by turns, and counts the answers.
template <typename Port>
class Asker : public Port {
 public:
  Result<void> start() override { return {}; }
  void stop() override {}
  Result<std::optional<core::Event>> poll_event() override {
    if (++polls_ % 2 == 0) {
      return std::optional<core::Event>();
    }
    return std::optional<core::Event>(ask(polls_ / 2));
  }
  Result<void> send_reply(const core::Reply&) override {
    ++replies;
    return {};
  }

  int replies = 0;

 protected:
  ~Asker() = default;
  virtual core::Event ask(int turn) = 0;

 private:
  int polls_ = 0;
};

class Robot final : public Asker<hal::RobotLink> {
 public:
  Result<void> send_sighting(const core::Sighting&) override { return {}; }

 private:
  core::Event ask(int turn) override {
    switch (turn % 3) {
      case 0: return tests::event_of(core::Claim{{40, 60}});
      case 1: return tests::event_of(core::PoseRequest{core::RobotPose{}});
      default: return tests::event_of(core::LampCommand{900 + turn % 100});
    }
  }
};

class Operator final : public Asker<hal::OperatorStation> {
 public:
  explicit Operator(const core::StartSettings& start) : start_(start) {}
  Result<void> show(const core::RgbImageView&, const core::Sighting&) override { return {}; }

 private:
  core::Event ask(int turn) override {
    return turn == 0
               ? tests::event_of(core::Start{start_.tubes, {}, false}, core::EventOrigin::kOperator)
               : tests::event_of(core::Pick{{313.0, 196.0}, {}}, core::EventOrigin::kOperator);
  }

  core::StartSettings start_;
};

class Lamp final : public hal::Dimmer {
 public:
  Result<void> start() override { return {}; }
  void stop() override {}
  Result<void> set_level(std::int32_t permille) override {
    level_ = permille;
    return {};
  }
  std::int32_t level_permille() const override { return level_; }

 private:
  std::int32_t level_ = 0;
};

/// With the shipped recording.
bool fill(MemoryGrabber& grabber, const core::CameraSettings& camera) {
  drivers::ReplayFrameGrabber recording(camera, std::string(kFolder) + "recording.y4m.xz");
  if (!recording.start()) {
    return false;
  }
  while (const auto lease = recording.grab_for(kTimeout)) {
    grabber.keep(lease->field());
  }
  return true;
}

TEST(BoxHeap, IsNotTouchedByATurn) {
  const auto file = std::make_unique<drivers::SessionFile>();
  drivers::Messages messages;
  ASSERT_TRUE(drivers::load_session_settings(std::string(kFolder) + "session.toml",
                                             drivers::kReplayNeeds, *file, messages));
  MemoryGrabber grabber;
  ASSERT_TRUE(fill(grabber, file->settings.camera));
  const auto session = std::make_unique<core::session::Session<core::FixedPoint>>();
  ASSERT_TRUE(session->configure(file->settings));
  PoseService poses;
  ASSERT_TRUE(poses.configure(file->settings));
  FrameView view(file->settings.camera.width_px, file->settings.camera.height_px);
  const auto overlay = std::make_unique<core::Snapshot<OverlaySnapshot>>();
  support::FakeClock clock;
  clock.advance(std::chrono::seconds(2));  // after the recording
  Lamp lamp;
  Robot robot;
  Operator person(file->settings.start);
  EventRecorder recorder;
  RecorderSettings recorder_settings;
  recorder_settings.fields_after = 4;
  ASSERT_TRUE(recorder.configure(recorder_settings, file->settings.camera,
                                 core::session::Session<core::FixedPoint>::state_bytes()));
  recorder.request();
  PairDesk pairs;
  JournalDesk journal(file->settings.camera.width_px, file->settings.camera.height_px);
  const auto loop = std::make_unique<BoxLoop<core::FixedPoint>>(
      *session, BoxPorts{&grabber, &clock, &lamp, &robot, &person},
      BoxServices{&poses, &view, overlay.get(), true, &recorder, {}, &pairs, nullptr, &journal});
  ASSERT_TRUE(loop->start());

  int tracked = 0;
  tests::HeapCalls calls;
  bool more = true;
  while (more) {
    const tests::HeapGuard guard;
    more = static_cast<bool>(loop->turn(kTimeout));
    const tests::HeapCalls now = guard.calls();
    calls.allocations += now.allocations;
    calls.releases += now.releases;
    tracked += loop->output().sighting.state == core::TrackState::kTracking ? 1 : 0;
  }

  EXPECT_GE(loop->counters().fields, 50);
  EXPECT_GT(2 * tracked, loop->counters().fields) << "hardly tracked: the guard saw an idle path";
  EXPECT_GE(loop->counters().missing, 6);
  EXPECT_GE(recorder.counters().asked, 1U);
  EXPECT_EQ(recorder.counters().refused, 0U);
  EXPECT_GE(robot.replies, 40);
  EXPECT_GE(person.replies, 40);
  JournalNote note;
  EXPECT_TRUE(journal.take_note(note));
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

}  // namespace
}  // namespace tubesight::board
