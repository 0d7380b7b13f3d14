// What a box records from the middle of a mission replays to the bytes that the whole mission gave.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/bench/output/result_files.h"
#include "board/bench/script/replay_script.h"
#include "board/bench/script/scripted_ports.h"
#include "board/box/box_loop.h"
#include "board/box/event_recorder.h"
#include "board/box/pose_service.h"
#include "drivers/recording/file_recording_store.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/session_text.h"
#include "hal/clock.h"
#include "hal/frame_grabber.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using core::FixedPoint;

const std::string kData = std::string(TUBESIGHT_TEST_DATA_DIR) + "/";

/// Lines of a results file, each with the field that it begins with.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// A camera of whose fields some come too late for their turn.
class LateFrameGrabber final : public hal::FrameGrabber {
 public:
  /// Each `every`-th call gets none; 0: all get one.
  LateFrameGrabber(hal::FrameGrabber& camera, int every) : camera_(&camera), every_(every) {}

  core::Result<void> start() override { return camera_->start(); }
  void stop() override { camera_->stop(); }
  core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override {
    ++calls_;
    if (every_ > 0 && calls_ % every_ == 0) {
      return core::Unexpected(core::Error::kTimeout);
    }
    return camera_->grab_for(timeout);
  }
  void give_back(std::int32_t /*buffer*/) override {}

 private:
  hal::FrameGrabber* camera_;
  int every_;
  int calls_ = 0;
};

/// A field that does not come is given up 10 ms after the one before it.
class LateClock final : public hal::Clock {
 public:
  explicit LateClock(const drivers::ReplayFrameGrabber& grabber) : grabber_(&grabber) {}
  [[nodiscard]] core::FieldTime now() const override {
    return grabber_->field_time() + std::chrono::milliseconds(10);
  }

 private:
  const drivers::ReplayFrameGrabber* grabber_;
};

/// A box that sees a recording's fields, hears its events, and records by itself.
struct RecordedBox {
  support::TemporaryFolder folder;
  std::vector<std::string> recordings;  ///< paths without ending

  /// `asked`: fields after which somebody asks for a recording. `late`: as LateFrameGrabber. What
  /// the box says goes to live.csv.
  void play(const std::string& session_file, const std::string& recording,
            const std::vector<std::int64_t>& asked, int late = 0) {
    const auto file = std::make_unique<drivers::SessionFile>();
    drivers::Messages messages;
    ASSERT_TRUE(
        drivers::load_session_settings(session_file, drivers::kReplayNeeds, *file, messages));
    drivers::ReplayFrameGrabber grabber(file->settings.camera, recording);
    drivers::ReplayEvents events;
    ASSERT_TRUE(grabber.start());
    ASSERT_TRUE(events.load_beside(recording, messages));
    LateFrameGrabber camera(grabber, late);
    const LateClock clock(grabber);
    board::ReplayScript script(file->settings.start, events, grabber);
    board::ScriptedRobotLink link(script);
    board::ScriptedOperatorStation station(script);
    const auto session = std::make_unique<core::session::Session<FixedPoint>>();
    ASSERT_TRUE(session->configure(file->settings));
    board::PoseService poses;
    ASSERT_TRUE(poses.configure(file->settings));
    board::EventRecorder recorder;
    board::RecorderSettings settings;
    settings.memory_mb = 64;
    settings.fields_after = 10;
    ASSERT_TRUE(recorder.configure(settings, file->settings.camera,
                                   core::session::Session<FixedPoint>::state_bytes()));
    drivers::FileRecordingStore store(folder.path("."), 2000, drivers::session_text(file->settings),
                                      [] { return std::int64_t{0}; });
    ASSERT_TRUE(store.open());
    board::BoxServices services;
    services.poses = events.has_pose_results() ? nullptr : &poses;
    services.recorder = &recorder;
    const auto loop = std::make_unique<board::BoxLoop<FixedPoint>>(
        *session, board::BoxPorts{&camera, &clock, nullptr, &link, &station}, services);
    board::ResultFiles live;
    ASSERT_TRUE(live.open(folder.path("live.csv"), folder.path("live_centers.csv")));
    ASSERT_TRUE(loop->start());
    const auto write = [&] {
      while (recorder.write_next(store)) {
        recordings.push_back(store.path());
      }
    };
    for (std::int64_t field = 0; loop->turn(std::chrono::milliseconds(0)); ++field) {
      if (std::find(asked.begin(), asked.end(), field) != asked.end()) {
        recorder.request();
      }
      write();
      const core::Field& given = loop->input().field;
      ASSERT_TRUE(
          live.add(given.number, given.parity, loop->output().sighting, loop->output().tubes));
    }
    recorder.flush();
    write();
    ASSERT_TRUE(live.commit());
    EXPECT_EQ(recorder.counters().failed, 0U) << store.message();
    EXPECT_EQ(recorder.counters().restarted, 0U);
  }

  /// Replays each recording, by the settings that came with it, and compares its rows with those of
  /// the whole.
  void expect_rows_of(const std::string& session_file, const std::string& recording) {
    const ProgramRun whole = run_tubesight(folder, {"replay", session_file, recording, "--fields",
                                                    "whole.csv", "--centers", "wc.csv"});
    ASSERT_EQ(whole.status, 0) << whole.err;
    expect_parts_of(folder.read("whole.csv"), folder.read("wc.csv"));
  }

  /// The same with the rows of the box that recorded.
  void expect_live_rows() {
    expect_parts_of(folder.read("live.csv"), folder.read("live_centers.csv"));
  }

 private:
  void expect_parts_of(const std::string& fields, const std::string& centers) {
    for (const std::string& part : recordings) {
      const ProgramRun run = run_tubesight(folder, {"replay", part + ".session.toml", part + ".y4m",
                                                    "--fields", "part.csv", "--centers", "pc.csv"});
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_EQ(run.err, "");
      expect_part(fields, folder.read("part.csv"), part, true);
      expect_part(centers, folder.read("pc.csv"), part, false);
    }
  }

  /// The header, and then lines of the whole in a row.
  static void expect_part(const std::string& whole, const std::string& part,
                          const std::string& name, bool rows_needed) {
    const auto lines = lines_of(part);
    ASSERT_FALSE(lines.empty());
    ASSERT_EQ(lines[0], lines_of(whole)[0]);
    if (lines.size() == 1 && !rows_needed) {
      return;
    }
    ASSERT_GT(lines.size(), 8U) << name;
    const std::string rows = part.substr(lines[0].size());  // from the line feed on
    EXPECT_NE(whole.find(rows), std::string::npos) << name << ": first row " << lines[1];
  }
};

TEST(Recorder, ShippedRecordingReplaysFromItsMiddle) {
  const std::string session = kData + "recordings/square_flush/session.toml";
  const std::string recording = kData + "recordings/square_flush/recording.y4m.xz";
  RecordedBox box;
  box.play(session, recording, {12, 40});
  ASSERT_EQ(box.recordings.size(), 2U);
  box.expect_rows_of(session, recording);
}

TEST(Recorder, FieldsThatNeverCameAreStepsOfTheReplay) {
  const std::string session = kData + "recordings/square_flush/session.toml";
  const std::string recording = kData + "recordings/square_flush/recording.y4m.xz";
  for (const int late : {4, 7, 9}) {
    RecordedBox box;
    box.play(session, recording, {10, 24, 40}, late);
    ASSERT_GE(box.recordings.size(), 2U);
    box.expect_live_rows();
    EXPECT_NE(box.folder.read("live.csv").rfind(",tracking,"), std::string::npos);
    const std::string meta =
        box.folder.read(box.recordings[1].substr(box.recordings[1].rfind('/') + 1) + ".meta.csv");
    EXPECT_NE(meta.find(",missing,"), std::string::npos);
  }
}

/// Scenarios whose missions are recorded.
class RecordedScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedScenario, ReplaysFromItsMiddle) {
  RecordedBox box;
  const ProgramRun simulated = run_tubesight(
      box.folder,
      {"simulate", kData + "scenarios/" + GetParam() + ".toml", "--out", "r", "--window-only"});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const std::string session = box.folder.path("r.session.toml");
  const std::string recording = box.folder.path("r.y4m");
  // All but the first begin in the middle, in whatever the mission has come to there.
  std::vector<std::int64_t> asked;
  for (std::int64_t field = 12; field < 2000; field += 23) {
    asked.push_back(field);
  }
  box.play(session, recording, asked);
  EXPECT_GE(box.recordings.size(), 1U);
  box.expect_rows_of(session, recording);
}

/// Four of the library; all of it where the environment says TUBESIGHT_ALL_SCENARIOS, by hand.
std::vector<std::string> scenarios() {
  if (std::getenv("TUBESIGHT_ALL_SCENARIOS") == nullptr) {
    return {"claims-wrong", "fault-black-long", "fault-dropped", "camera-progressive"};
  }
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kData + "scenarios")) {
    if (file.path().extension() == ".toml") {
      names.push_back(file.path().stem().string());
    }
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Library, RecordedScenario, ::testing::ValuesIn(scenarios()));

/// A recording of the shipped one's middle, to be damaged.
class RecordedState : public ::testing::Test {
 protected:
  void SetUp() override {
    box_.play(kSession, kData + "recordings/square_flush/recording.y4m.xz", {20});
    ASSERT_EQ(box_.recordings.size(), 1U);
    name_ = box_.recordings[0].substr(box_.recordings[0].rfind('/') + 1);
  }
  void expect_refused(const std::string& session, const std::string& message) {
    const ProgramRun run =
        run_tubesight(box_.folder, {"replay", session, name_ + ".y4m", "--fields", "f.csv"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, name_ + message + "\n");
    EXPECT_EQ(run.out, "");
  }

  const std::string kSession = kData + "recordings/square_flush/session.toml";
  RecordedBox box_;
  std::string name_;
};

TEST_F(RecordedState, IsRefusedInOneLineWhenDamaged) {
  std::string state = box_.folder.read(name_ + ".state");
  state[state.size() / 2] ^= 1;
  box_.folder.write(name_ + ".state", state);
  expect_refused(kSession, ".state: damaged or cut short, expected the file as the box wrote it");
  box_.folder.write(name_ + ".state", "");
  expect_refused(kSession, ".state: damaged or cut short, expected the file as the box wrote it");
}

TEST_F(RecordedState, IsRefusedInOneLineWithOtherSettings) {
  const std::string other = box_.folder.path("other.toml");
  std::string text;
  {
    std::ifstream file(kSession);
    text.assign(std::istreambuf_iterator<char>(file), {});
  }
  box_.folder.write("other.toml", text + "\n[motion]\nmax_speed_mm_s = 299.0\n");
  expect_refused(other, ".state: of a box with other settings, expected those of " + other);
}

}  // namespace
}  // namespace tubesight::tests
