// A whole box before Aravis' own camera: what it records of a mission is replayed by the program to
// the byte that it said; and the daemon, to which a camera comes, goes and comes back.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/vision_box.h"
#include "drivers/files/result_csv.h"
#include "tests/benchmark/recorded_session.h"
#include "tests/support/events.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/daemon.h"
#include "tests/system/gige_camera.h"
#include "tests/system/network_namespace.h"

namespace tubesight::tests {
namespace {

using core::EventOrigin;
using core::FieldStatus;
using std::chrono::seconds;

constexpr const char* kSessionFile =
    TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/session.toml";
constexpr const char* kSource =
    "[source]\nkind = \"aravis\"\ndevice = \"address:127.0.0.1\"\nfields_per_s = 60\n"
    "[realtime]\npriority = 0\nlock_memory = false\n";

class GigeBox : public testing::Test {
 protected:
  void SetUp() override {
    const std::string problem = enter_network_of_its_own();
    ASSERT_EQ(problem, "");
    drivers::Messages messages;
    ASSERT_TRUE(mission_.load(TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush", messages));
    const core::CameraSettings& camera = mission_.settings().camera;
    camera_.show(frames_of(mission_.fields(), camera), camera, 8);
  }

  /// A mission before a box that records it. `whole`: every field came in time and was good.
  void play(bool& whole);

  RecordedSession mission_;
  GigeCamera camera_;
};

void GigeBox::play(bool& whole) {
  ASSERT_TRUE(camera_.start()) << camera_.error();
  const support::TemporaryFolder folder;
  folder.write("box.toml", std::string("include = [\"") + kSessionFile + "\"]\n" + kSource +
                               "[record]\nfolder = \".\"\nmemory_mb = 64\nfields_after = 4\n"
                               "on_track_lost = false\n");
  const auto settings = std::make_unique<board::BoxSettings>();
  drivers::Messages messages;
  ASSERT_TRUE(board::load_box_settings(folder.path("box.toml"), *settings, messages))
      << messages.front();
  std::string told;
  board::VisionBox box(*settings, [&](const std::string& line) { told += line + "\n"; });
  ASSERT_TRUE(box.start_without_tracking());
  std::string rows;
  int aligned = 0;
  const auto turns = [&](int count) {
    for (int i = 0; i < count; ++i) {
      box.tracking().turn();
      const core::Sighting& sighting = box.loop().output().sighting;
      const core::Field& field = box.loop().input().field;
      drivers::append_fields_row(rows, field.number, field.parity, sighting);
      aligned += sighting.aligned ? 1 : 0;
      whole = whole && field.status == FieldStatus::kGood;
    }
  };

  int waited = 0;
  do {
    turns(1);
  } while (box.loop().input().field.status != FieldStatus::kGood && ++waited < 60);
  whole = true;
  ASSERT_TRUE(box.station().submit(
      event_of(core::Start{settings->told().start.tubes, {}, false}, EventOrigin::kOperator)));
  turns(static_cast<int>(mission_.fields().size()));
  if (whole) {
    EXPECT_EQ(box.loop().output().sighting.state, core::TrackState::kTracking) << told;
    EXPECT_GE(aligned, 11) << "as in expected_fields.csv";
  }
  static_cast<void>(box.request_recording());
  turns(8);
  box.stop();

  std::string name;
  for (const std::string& file : folder.names()) {
    name = file.ends_with("-command.y4m") ? file.substr(0, file.size() - 4) : name;
  }
  ASSERT_NE(name, "");
  const Answered run = run_program(
      TUBESIGHT_PROGRAM, {"replay", folder.path(name + ".session.toml"), folder.path(name + ".y4m"),
                          "--fields", folder.path("fields.csv")});
  ASSERT_EQ(run.status, 0) << run.err;
  std::string replayed = folder.read("fields.csv");
  replayed.erase(0, replayed.find('\n') + 1);
  EXPECT_GT(std::count(replayed.begin(), replayed.end(), '\n'), 50);
  EXPECT_NE(rows.find(replayed), std::string::npos) << "box:\n" << rows << "replay:\n" << replayed;
}

// In real time: on a busy machine fields come too late, and a track may be lost for it. What the
// box says is replayed to the byte then, too; one of three times all of them are to come.
TEST_F(GigeBox, TracksAMissionAndReplaysItToTheByte) {
  bool whole = false;
  for (int i = 0; i < 3 && !whole && !HasFailure(); ++i) {
    play(whole);
  }
  EXPECT_TRUE(whole) << "this machine is too busy";
}

TEST_F(GigeBox, TheDaemonTakesACameraThatComesLateAndOneThatComesBack) {
  Daemon box;
  box.folder().write("box.toml", std::string("include = [\"") + kSessionFile +
                                     "\"]\n[control]\nsocket = \"box\"\n" + kSource);
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  EXPECT_NE(box.wait_for("\"failed\"", seconds(10)).find("\"failed\""), std::string::npos);
  EXPECT_NE(box.said().find("camera address:127.0.0.1: does not answer"), std::string::npos)
      << box.said();

  ASSERT_TRUE(camera_.start()) << camera_.error();
  EXPECT_NE(box.wait_for("\"state\":\"playing\"", seconds(15)).find("\"playing\""),
            std::string::npos)
      << box.said();

  // Killed and started again, it knows nothing of us: the library says so, or our time-out does.
  ASSERT_TRUE(camera_.start()) << camera_.error();
  EXPECT_NE(box.wait_for("\"passes\":2", seconds(20)).find("\"passes\":2"), std::string::npos);
  EXPECT_NE(box.wait_for("\"state\":\"playing\"", seconds(5)).find("\"playing\""),
            std::string::npos);
  const std::string said = box.said();
  EXPECT_TRUE(said.find("camera: nothing comes") != std::string::npos ||
              said.find("camera: control lost") != std::string::npos)
      << said;
  box.signal(SIGTERM);
  EXPECT_EQ(box.wait_for_end(seconds(15)), 0) << box.said();
}

}  // namespace
}  // namespace tubesight::tests
