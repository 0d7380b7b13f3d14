// The driver against Aravis itself: its own GigE Vision camera, in a process of its own on the
// loopback of a network of its own, shows the shipped recording.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>

#include "board/visionbox/camera_source.h"
#include "core/base/scalar.h"
#include "drivers/aravis/aravis_frame_grabber.h"
#include "drivers/files/result_csv.h"
#include "tests/benchmark/recorded_session.h"
#include "tests/system/gige_camera.h"
#include "tests/system/network_namespace.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using drivers::AravisTrouble;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush";
/// Pictures at rest before the mission: those that are not believed yet, and some.
constexpr int kLead = 8;

class GigeMission : public testing::Test {
 protected:
  void SetUp() override {
    const std::string problem = enter_network_of_its_own();
    ASSERT_EQ(problem, "");
    drivers::Messages messages;
    ASSERT_TRUE(mission_.load(kFolder, messages));
    const core::CameraSettings& camera = mission_.settings().camera;
    frames_ = frames_of(mission_.fields(), camera);
    camera_.show(frames_, camera, kLead);
    settings_.device = "address:127.0.0.1";
    settings_.calibrated.serial = "4711";
    settings_.fields_per_s = 60.0;
    settings_.width_px = camera.width_px;
    settings_.height_px = camera.height_px;
    settings_.scan = camera.scan;
    grabber_ = std::make_unique<drivers::AravisFrameGrabber>(settings_, clock_);
  }

  void start() {
    ASSERT_TRUE(camera_.start()) << camera_.error();
    ASSERT_TRUE(grabber_->start()) << grabber_->messages().front();
  }
  /// The field as it was drawn of the frame that it shows, the first from `frame_` on; false: it
  /// shows none of them.
  [[nodiscard]] bool find_drawn(const core::Field& seen, core::Field& drawn) {
    const std::size_t from = frame_;
    for (; frame_ < frames_.size(); ++frame_) {
      drawn = seen;
      drawn.pixels = core::field_of({reinterpret_cast<const std::uint8_t*>(frames_[frame_].data()),
                                     settings_.width_px, settings_.height_px, settings_.width_px},
                                    seen.parity);
      if (same(seen.pixels, drawn.pixels)) {
        return true;
      }
    }
    frame_ = from;
    return false;
  }
  static bool same(const core::FieldView& a, const core::FieldView& b) {
    for (std::int32_t line = 0; line < a.lines; ++line) {
      if (std::memcmp(a.pixels + static_cast<std::ptrdiff_t>(line) * a.stride_px,
                      b.pixels + static_cast<std::ptrdiff_t>(line) * b.stride_px,
                      static_cast<std::size_t>(a.width_px)) != 0) {
        return false;
      }
    }
    return a.lines == b.lines && a.width_px == b.width_px;
  }
  /// What `replay` writes of a field.
  static std::string row_of(const core::Field& field, const core::Sighting& sighting) {
    std::string row;
    drivers::append_fields_row(row, field.number, field.parity, sighting);
    return row;
  }
  /// Takes fields until one is good.
  [[nodiscard]] bool good_within(int fields) {
    for (int i = 0; i < fields; ++i) {
      grabber_->look_after();
      const auto lease = grabber_->grab_for(milliseconds(500));
      if (lease && lease->field().status == FieldStatus::kGood) {
        return true;
      }
    }
    return false;
  }

  RecordedSession mission_;
  std::vector<std::string> frames_;
  std::size_t frame_ = 0;
  GigeCamera camera_;
  board::SystemClock clock_;
  drivers::AravisSettings settings_;
  std::unique_ptr<drivers::AravisFrameGrabber> grabber_;
};

// What arrives is what was drawn, and what is seen in it is, to the byte, what a replay of the
// drawn fields at the same times gives.
TEST_F(GigeMission, IsSeenAsTheReplayOfItsFieldsIs) {
  SessionRun<core::FixedPoint> session;
  SessionRun<core::FixedPoint> replay;
  ASSERT_TRUE(session.configure(mission_.settings()));
  ASSERT_TRUE(replay.configure(mission_.settings()));
  start();
  EXPECT_GE(grabber_->agreed().packet_bytes, 1400);
  int aligned = 0;
  int good = 0;
  while (frame_ + 1 < frames_.size()) {
    const auto lease = grabber_->grab_for(milliseconds(1000));
    ASSERT_TRUE(lease) << frame_;
    good += lease->field().status == FieldStatus::kGood ? 1 : 0;
    if (good == 0) {
      continue;  // the start's clicks are on the first one that is believed
    }
    // Of a damaged one, on a busy machine, nobody looks at the pixels.
    core::Field drawn = lease->field();
    if (drawn.status == FieldStatus::kGood) {
      ASSERT_TRUE(find_drawn(lease->field(), drawn)) << "no picture from " << frame_ << " on";
    }
    session.give(lease->field());
    session.step();
    replay.give(drawn);
    replay.step();
    ASSERT_EQ(row_of(lease->field(), session.output().sighting),
              row_of(drawn, replay.output().sighting));
    aligned += session.output().sighting.aligned ? 1 : 0;
  }
  const drivers::AravisReport report = grabber_->report();
  // A socket that has not been given its room yet does not hold the first one whole.
  EXPECT_LE(report.counters.incomplete, 2);
  EXPECT_EQ(report.counters.other_size, 0);
  EXPECT_TRUE(report.stamps);
  EXPECT_TRUE(report.counts);
  EXPECT_GE(good, 2 * static_cast<int>(frames_.size()) - 6) << "all of the mission";
  EXPECT_GE(aligned, 11) << "as in expected_fields.csv, and while it rests before";
}

/// Threads of this process with SCHED_FIFO.
int real_time_threads() {
  int count = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    count += sched_getscheduler(std::stoi(thread.path().filename())) == SCHED_FIFO ? 1 : 0;
  }
  return count;
}

/// Whether the system gives this user's threads real-time priority.
bool may_have_priority() {
  sched_param mine{};
  mine.sched_priority = 1;
  const bool may = sched_setscheduler(0, SCHED_FIFO, &mine) == 0;
  mine.sched_priority = 0;
  EXPECT_EQ(sched_setscheduler(0, SCHED_OTHER, &mine), 0);
  return may;
}

TEST_F(GigeMission, TheThreadThatReceivesHasThePriorityOfTheSettingsWhereTheSystemGivesIt) {
  const int expected = may_have_priority() ? 1 : 0;
  settings_.priority = 12;
  grabber_ = std::make_unique<drivers::AravisFrameGrabber>(settings_, clock_);
  start();
  ASSERT_TRUE(good_within(20));
  EXPECT_EQ(real_time_threads(), expected);
}

// The camera never sends a packet again: what is incomplete is marked, and what is not is whole.
TEST_F(GigeMission, LostPacketsDamageFieldsAndNothingElse) {
  // 220 packets a picture: one in five is hit.
  ASSERT_TRUE(camera_.start("4711", 0.001)) << camera_.error();
  settings_.packet_bytes = 1400;
  grabber_ = std::make_unique<drivers::AravisFrameGrabber>(settings_, clock_);
  ASSERT_TRUE(grabber_->start()) << grabber_->messages().front();
  int good = 0;
  for (int i = 0; i < 120; ++i) {
    const auto lease = grabber_->grab_for(milliseconds(1000));
    ASSERT_TRUE(lease) << i;
    if (lease->field().status == FieldStatus::kGood) {
      core::Field drawn;
      EXPECT_TRUE(find_drawn(lease->field(), drawn)) << "a picture that was never drawn";
      ++good;
    }
  }
  grabber_->look_after();
  static_cast<void>(grabber_->grab_for(milliseconds(1000)));
  const drivers::AravisCounters counters = grabber_->report().counters;
  EXPECT_GT(counters.incomplete, 0);
  EXPECT_GT(counters.missing_packets, 0);
  EXPECT_GT(good, 20);
}

TEST_F(GigeMission, AKilledCameraIsMissedInASecondAndTakenWhenItIsBack) {
  start();
  ASSERT_TRUE(good_within(20));
  camera_.kill_it();
  const core::FieldTime killed = clock_.now();
  while (true) {
    const auto lease = grabber_->grab_for(milliseconds(100));
    if (!lease && lease.error() != Error::kTimeout) {
      EXPECT_EQ(lease.error(), Error::kIo);
      break;
    }
    ASSERT_LT(clock_.now() - killed, seconds(4));
  }
  EXPECT_LT(clock_.now() - killed, seconds(2)) << "the library says it after five";
  EXPECT_EQ(grabber_->report().trouble, AravisTrouble::kSilent);

  // Before the library has been asked to let go: with nobody there that takes it ten seconds.
  ASSERT_TRUE(camera_.start()) << camera_.error();
  grabber_->stop();
  ASSERT_TRUE(grabber_->start()) << grabber_->messages().front();
  EXPECT_TRUE(good_within(20));
  EXPECT_EQ(grabber_->report().trouble, AravisTrouble::kNone);
}

TEST_F(GigeMission, ACameraThatIsNotThereIsSaidToBeAbsent) {
  const auto absent = grabber_->start();
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error(), Error::kDisconnected);
  EXPECT_TRUE(grabber_->messages().front().starts_with("camera address:127.0.0.1: does not answer"))
      << grabber_->messages().front();
}

TEST_F(GigeMission, AnAddressThatNoNetworkLeadsToIsSaidSo) {
  settings_.device = "address:192.0.2.7";
  drivers::AravisFrameGrabber grabber(settings_, clock_);
  const auto absent = grabber.start();
  ASSERT_FALSE(absent);
  EXPECT_EQ(grabber.messages().front(), "camera address:192.0.2.7: no network leads to 192.0.2.7");
}

TEST_F(GigeMission, AnotherCameraAtTheAddressIsNotTaken) {
  ASSERT_TRUE(camera_.start("0815")) << camera_.error();
  ASSERT_FALSE(grabber_->start());
  EXPECT_EQ(grabber_->messages().front(),
            "camera address:127.0.0.1: has the serial number 0815, expected 4711, the one that was "
            "calibrated");
}

TEST_F(GigeMission, AnotherProgramsCameraIsBusy) {
  start();
  drivers::AravisFrameGrabber second(settings_, clock_);
  ASSERT_FALSE(second.start());
  EXPECT_EQ(second.messages().front(),
            "camera address:127.0.0.1: is busy: another program has its control, expected it free");
  EXPECT_TRUE(good_within(20)) << "the first one goes on";
}

}  // namespace
}  // namespace tubesight::tests
