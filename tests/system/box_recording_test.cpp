// What a box records of a mission in real time, replayed by the program: to the byte what the box
// said.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/control_desk.h"
#include "board/visionbox/vision_box.h"
#include "drivers/files/result_csv.h"
#include "tests/support/events.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

using core::EventOrigin;

/// A simulated box whose turns are made here, so that every sighting is seen.
class RecordingBox : public ::testing::Test {
 protected:
  void load(const std::string& more) {
    folder_.write("box.toml", "[source]\nkind = \"simulated\"\nscenario = \"" +
                                  std::string(TUBESIGHT_SOURCE_DIR) +
                                  "/docs/examples/steam-generator.toml\"\nscript = true\n"
                                  "[realtime]\npriority = 0\nlock_memory = false\n"
                                  "[record]\nfolder = \".\"\n" +
                                  more);
    drivers::Messages messages;
    ASSERT_TRUE(board::load_box_settings(folder_.path("box.toml"), *settings_, messages))
        << messages.front();
    settings_->source.in_real_time = false;  // drawn under the sanitizers, a field may take longer
    box_ = std::make_unique<board::VisionBox>(*settings_, [](const std::string&) {});
    ASSERT_TRUE(box_->start_without_tracking());
  }

  void turns(int count) {
    for (int i = 0; i < count; ++i) {
      box_->tracking().turn();
      const core::Field& field = box_->loop().input().field;
      drivers::append_fields_row(rows_, field.number, field.parity, box_->loop().output().sighting);
    }
  }

  [[nodiscard]] core::TrackState state() const { return box_->loop().output().sighting.state; }

  /// Names of the recordings there, without ending, in order.
  [[nodiscard]] std::vector<std::string> recordings() const {
    std::vector<std::string> names;
    for (const std::string& name : folder_.names()) {
      if (name.ends_with(".y4m")) {
        names.push_back(name.substr(0, name.size() - 4));
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Replays it; the rows must be among those of the box. Says how many there are.
  [[nodiscard]] std::int64_t expect_replay(const std::string& name) const {
    const Answered run = run_program(
        TUBESIGHT_PROGRAM, {"replay", folder_.path(name + ".session.toml"),
                            folder_.path(name + ".y4m"), "--fields", folder_.path("fields.csv")});
    EXPECT_EQ(run.status, 0) << run.err;
    std::string rows = folder_.read("fields.csv");
    const std::string header = std::string(drivers::kFieldsHeader) + "\n";
    EXPECT_TRUE(rows.starts_with(header));
    rows.erase(0, header.size());
    EXPECT_FALSE(rows.empty());
    EXPECT_NE(rows_.find(rows), std::string::npos) << name << ": " << rows.substr(0, 200);
    return std::count(rows.begin(), rows.end(), '\n');
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<board::BoxSettings> settings_ = std::make_unique<board::BoxSettings>();
  std::unique_ptr<board::VisionBox> box_;
  std::string rows_;
};

TEST_F(RecordingBox, ReplaysWhatTheBoxSaidFromTheMiddleOfAMission) {
  load("memory_mb = 32\nfields_after = 20\n");
  turns(150);
  EXPECT_EQ(state(), core::TrackState::kTracking);
  ASSERT_TRUE(
      box_->station().submit(event_of(core::Pick{{313.0, 196.0}, {}}, EventOrigin::kOperator)));
  ASSERT_TRUE(box_->station().submit(event_of(core::LampCommand{900}, EventOrigin::kOperator)));
  static_cast<void>(box_->request_recording());
  turns(30);
  ASSERT_TRUE(box_->station().submit(event_of(core::LampCommand{0}, EventOrigin::kOperator)));
  for (int i = 0; i < 20 && state() != core::TrackState::kLost; ++i) {
    turns(15);
  }
  ASSERT_EQ(state(), core::TrackState::kLost);
  turns(25);
  box_->stop();

  const auto names = recordings();
  ASSERT_EQ(names.size(), 2U);
  EXPECT_TRUE(names[0].ends_with("-command"));
  EXPECT_TRUE(names[1].ends_with("-track-lost"));
  EXPECT_GT(expect_replay(names[0]), 60);
  EXPECT_GT(expect_replay(names[1]), 20);
}

TEST_F(RecordingBox, NoMoreWaitForAnAnswerThanItHasRoomFor) {
  load("memory_mb = 32\n");
  board::ControlDesk desk([this] { return box_->report(); }, *box_, settings_->told().start);
  for (drivers::ControlClient client = 1; client <= 64; ++client) {
    ASSERT_FALSE(desk.handle(client, "1 record"));
    ASSERT_FALSE(desk.handle(client, "1 lamp 500"));
    turns(1);  // the tracking takes what was asked; nobody fetches the answers
  }
  for (const char* line : {"1 record", "1 lamp 500"}) {
    const auto refused = desk.handle(65, line);
    ASSERT_TRUE(refused) << line;
    EXPECT_NE(refused->find("the box has too much to do, ask again"), std::string::npos);
  }
  EXPECT_TRUE(desk.handle(65, "1 status")) << "who asks how it is doing hears it";
  box_->stop();
}

TEST(BoxRecording, WhoWaitsForOneHearsOfItFromABoxThatEnds) {
  Daemon box;
  box.write_simulated_settings(
      "script = true\n[record]\nfolder = \".\"\nmemory_mb = 64\nfields_after = 120\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  Answered asked;
  std::thread client([&] { asked = box.ask({"record"}); });
  static_cast<void>(box.wait_for("\"asked\":1", std::chrono::seconds(20)));

  box.signal(SIGTERM);

  EXPECT_EQ(box.wait_for_end(std::chrono::seconds(20)), 0) << box.said();
  client.join();
  EXPECT_EQ(asked.status, 0) << asked.err;
  EXPECT_TRUE(asked.out.starts_with("written: ")) << asked.out;
}

TEST(BoxRecording, IsAskedForByTheControlProgramAndReplays) {
  Daemon box;
  // A machine that cannot keep up loses the track, and that recording would answer the command,
  // too.
  box.write_simulated_settings(
      "script = true\n[record]\nfolder = \".\"\nmemory_mb = 32\nfields_after = 10\n"
      "on_track_lost = false\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  static_cast<void>(box.wait_for("\"state\":\"tracking\"", std::chrono::seconds(20)));

  const Answered asked = box.ask({"record"});

  ASSERT_EQ(asked.status, 0) << asked.err;
  ASSERT_TRUE(asked.out.starts_with("written: ")) << asked.out;
  ASSERT_TRUE(asked.out.ends_with("-command.y4m\n")) << asked.out;
  const std::string picture = asked.out.substr(9, asked.out.size() - 10);
  const std::string name = picture.substr(0, picture.size() - 4);
  const Answered replay = run_program(
      TUBESIGHT_PROGRAM, {"replay", name + ".session.toml", picture, "--fields", name + ".csv"});
  EXPECT_EQ(replay.status, 0) << replay.err;
  const std::string status = box.ask({"status", "--json"}).out;
  EXPECT_NE(status.find("\"last\":\"" + name + "\""), std::string::npos) << status;
  EXPECT_NE(box.ask({"self-test"}).out.find("disk      good"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::tests
