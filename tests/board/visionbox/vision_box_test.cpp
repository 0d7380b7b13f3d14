#include "board/visionbox/vision_box.h"

#include <chrono>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/script_ports.h"
#include "drivers/files/result_csv.h"
#include "tests/support/events.h"

namespace tubesight::board {
namespace {

using core::Liveness;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";

/// The shipped recording in real time, without priority and locks: what a test may ask for.
std::unique_ptr<BoxSettings> shipped(bool script) {
  auto box = std::make_unique<BoxSettings>();
  drivers::Messages messages;
  EXPECT_TRUE(drivers::load_session_settings(std::string(kFolder) + "session.toml",
                                             drivers::kReplayNeeds, box->session, messages));
  box->source.recording = std::string(kFolder) + "recording.y4m.xz";
  box->source.loop = false;
  box->source.script = script;
  box->real_time.priority = 0;
  box->real_time.lock_memory = false;
  return box;
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Plays it to its end; the rows of `--fields`, or nothing where a busy machine let fields come
/// late.
std::string rows_in_real_time(const BoxSettings& settings) {
  const auto box = std::make_unique<VisionBox>(settings, [](const std::string&) {});
  EXPECT_TRUE(box->start_without_tracking());
  std::string rows = std::string(drivers::kFieldsHeader) + "\n";
  TrackingStatus status;
  while (status.source_errors == 0) {
    box->tracking().turn();
    EXPECT_TRUE(box->tracking().status(status));
    const core::Field& field = box->loop().input().field;
    if (field.status == core::FieldStatus::kGood) {
      drivers::append_fields_row(rows, field.number, field.parity, box->loop().output().sighting);
    } else if (status.source_errors == 0) {
      return {};
    }
  }
  EXPECT_EQ(status.step.count(), 52);
  EXPECT_GT(status.step.worst_us(), 0);
  return rows;
}

TEST(VisionBox, SeesInRealTimeWhatAReplaySees) {
  const auto settings = shipped(true);
  std::string rows;
  for (int i = 0; i < 10 && rows.empty(); ++i) {
    rows = rows_in_real_time(*settings);
  }

  EXPECT_EQ(rows, read(std::string(kFolder) + "expected_fields.csv"));
}

TEST(VisionBox, WaitsForAStartAndGoesOnWithoutFieldsAtTheirRate) {
  const auto settings = shipped(false);
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  ASSERT_TRUE(box->start());
  TrackingStatus status;
  const MonotonicTime until = monotonic_now() + std::chrono::seconds(20);
  do {
    sleep_until(monotonic_now() + std::chrono::milliseconds(10));
    ASSERT_LT(monotonic_now(), until);
  } while (!box->tracking().status(status) || status.source_errors < 5);
  const std::int64_t before = status.counters.missing;
  sleep_until(monotonic_now() + std::chrono::milliseconds(500));
  ASSERT_TRUE(box->tracking().status(status));
  box->stop();

  EXPECT_EQ(status.sighting.state, core::TrackState::kWaiting);
  EXPECT_EQ(status.sighting.judged_fields, 0);
  // 60 fields a second; a busy machine makes fewer turns.
  EXPECT_GT(status.counters.missing - before, 10);
  EXPECT_LT(status.counters.missing - before, 40);
  EXPECT_EQ(status.sighting.status, core::FieldStatus::kMissing);
}

TEST(VisionBox, ABoxThatMayJudgeNothingNeverVouchesWhateverItIsTold) {
  const auto settings = shipped(true);  // its script starts it where the others track
  settings->source.loop = true;
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  box->judge_nothing();
  ASSERT_TRUE(box->start_without_tracking());
  core::Event start = tests::event_of(
      core::Start{settings->session.settings.start.tubes, {}, false}, core::EventOrigin::kOperator);
  start.id = ScriptedStation::kFirstStationId + 5;
  ASSERT_TRUE(box->station().submit(start));

  for (int i = 0; i < 70; ++i) {
    box->tracking().turn();
    const core::Sighting& sighting = box->loop().output().sighting;
    ASSERT_EQ(sighting.state, core::TrackState::kWaiting);
    ASSERT_FALSE(sighting.aligned);
    ASSERT_EQ(sighting.judged_fields, 0);
    ASSERT_EQ(sighting.status, core::FieldStatus::kMissing);
  }

  const auto reply = box->station().take_reply();
  ASSERT_TRUE(reply);
  EXPECT_NE(tests::content_of<core::StartReply>(*reply).refusal, core::StartRefusal::kNone);
}

TEST(VisionBox, TakesAStartFromTheStationAndAnswersIt) {
  const auto settings = shipped(false);
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  ASSERT_TRUE(box->start_without_tracking());
  core::Event start = tests::event_of(
      core::Start{settings->session.settings.start.tubes, {}, false}, core::EventOrigin::kOperator);
  start.id = ScriptedStation::kFirstStationId + 5;
  ASSERT_TRUE(box->station().submit(start));

  box->tracking().turn();

  const auto reply = box->station().take_reply();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->id, start.id);
  EXPECT_EQ(tests::content_of<core::StartReply>(*reply).refusal, core::StartRefusal::kNone);
  EXPECT_EQ(box->loop().output().sighting.state, core::TrackState::kTracking);
  EXPECT_EQ(box->loop().output().sighting.tool, (core::TubeAddress{40, 60}));
}

/// A tool at rest under a simulated lamp that the box rules.
Liveness liveness_of_a_rest(bool pattern) {
  const auto settings = shipped(false);
  settings->source.kind = SourceKind::kSimulated;
  settings->source.loop = true;
  settings->lamp.pattern = pattern;
  drivers::Messages messages;
  EXPECT_TRUE(drivers::load_scenario(TUBESIGHT_TEST_DATA_DIR "/scenarios/rest-square.toml", {},
                                     settings->scenario, messages));
  drivers::Scenario& scenario = settings->scenario.scenario;
  scenario.path.clear();
  scenario.events.clear();
  scenario.video.length_s = 60.0;
  scenario.video.window_margin_px = 0;
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  EXPECT_TRUE(box->start_without_tracking());
  // Within two seconds where the machine keeps up; fields that come late tell less.
  const MonotonicTime until = monotonic_now() + std::chrono::seconds(pattern ? 12 : 3);
  Liveness liveness = Liveness::kUnknown;
  while (liveness == Liveness::kUnknown && monotonic_now() < until) {
    box->tracking().turn();
    liveness = box->loop().output().sighting.liveness;
  }
  return liveness;
}

TEST(VisionBox, ProvesThatASimulatedCameraIsLive) {
  EXPECT_EQ(liveness_of_a_rest(true), Liveness::kProved);
}

TEST(VisionBox, ProvesNothingWithoutThePattern) {
  EXPECT_EQ(liveness_of_a_rest(false), Liveness::kUnknown);
}

TEST(VisionBox, StartsWithoutItsCameraAndSaysSo) {
  const auto settings = shipped(false);
  settings->source.kind = SourceKind::kV4l2;
  settings->source.v4l2.device = "serial:of no camera";
  std::string told;
  const auto box = std::make_unique<VisionBox>(
      *settings, [&](const std::string& line) { told += told.empty() ? line : ""; });
  ASSERT_TRUE(box->start_without_tracking());

  box->tracking().turn();
  box->tracking().turn();
  const BoxReport report = box->report();
  box->stop();

  EXPECT_TRUE(told.starts_with("camera serial:of no camera: is not there, expected one of: "))
      << told;
  EXPECT_EQ(report.source_kind, "v4l2");
  EXPECT_EQ(report.source, SourceState::kFailed);
  EXPECT_EQ(report.tracking.sighting.status, core::FieldStatus::kMissing);
  EXPECT_EQ(report.tracking.source_errors, 1) << "the frame's other field is not asked for";
  ASSERT_TRUE(report.camera);
  EXPECT_FALSE(report.camera->well);
  EXPECT_EQ(report.camera->words, "not open");
}

TEST(VisionBox, StopsAndStartsOnce) {
  const auto settings = shipped(false);
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  ASSERT_TRUE(box->start());
  EXPECT_FALSE(box->start());
  box->stop();
  box->stop();
}

}  // namespace
}  // namespace tubesight::board
