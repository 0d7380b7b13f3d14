#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "board/visionbox/box_report.h"
#include "drivers/control/json_line.h"

namespace tubesight::board {
namespace {

BoxReport good_report() {
  BoxReport report;
  report.turned = true;
  report.source_kind = "replay";
  report.source = SourceState::kPlaying;
  report.span = std::chrono::milliseconds(20);
  report.fields_per_s = 49.9;
  report.link_kind = "none";
  report.priority = 50;
  report.tracking.scheduled = true;
  report.lock_wanted = true;
  report.memory_locked = true;
  report.deadline_ms = 10.0;
  report.tracking.grab_to_sighting.add(std::chrono::milliseconds(1));
  report.tracking.lamp = true;
  report.tracking.lamp_permille = 1000;
  return report;
}

std::string bad_row(const BoxReport& report) {
  std::string bad;
  for (const SelfTestRow& row : self_test(report)) {
    if (row.verdict == SelfTestRow::Verdict::kBad) {
      bad += bad.empty() ? std::string(row.what) : "," + std::string(row.what);
    }
  }
  const bool ok = self_test_answer(report).find("\"ok\":true") != std::string::npos;
  EXPECT_EQ(ok, bad.empty());
  return bad;
}

TEST(SelfTest, FindsNothingInASoundBox) { EXPECT_EQ(bad_row(good_report()), ""); }

TEST(SelfTest, FindsEachFault) {
  BoxReport report = good_report();
  report.source = SourceState::kFailed;
  EXPECT_EQ(bad_row(report), "source");
  report = good_report();
  report.pairs.file = "p.csv";
  report.pairs.written = 3;
  EXPECT_EQ(bad_row(report), "");
  EXPECT_NE(status_answer(report).find("p.csv, 3 written"), std::string::npos);
  report.pairs.lost = 1;
  report.pairs.trouble = "p.csv: cannot be written";
  EXPECT_EQ(bad_row(report), "pairs");
  report = good_report();
  report.fields_per_s = 30.0;
  EXPECT_EQ(bad_row(report), "rate");
  report = good_report();
  for (int i = 0; i < 3; ++i) {
    report.tracking.grab_to_sighting.add(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(bad_row(report), "time");
  report = good_report();
  report.tracking.counters.dimmer_errors = 1;
  EXPECT_EQ(bad_row(report), "lamp");
  for (const auto condition :
       {core::lighting::LampCondition::kWeak, core::lighting::LampCondition::kDark,
        core::lighting::LampCondition::kUnseen}) {
    report = good_report();
    report.tracking.lamp_ruled = true;
    report.tracking.lamp_condition = condition;
    EXPECT_EQ(bad_row(report), "lamp");
    const std::string meaning(core::lighting::words_of(condition).meaning);
    EXPECT_NE(self_test_answer(report).find(meaning), std::string::npos) << meaning;
  }
  report = good_report();
  report.tracking.scheduled = false;
  EXPECT_EQ(bad_row(report), "priority");
  report = good_report();
  report.memory_locked = false;
  EXPECT_EQ(bad_row(report), "memory");
  report = good_report();
  report.link_kind = "modbus";
  EXPECT_EQ(bad_row(report), "link");
}

TEST(SelfTest, LooksAtTheDiskOfTheRecorder) {
  BoxReport report = good_report();
  report.recorder.folder = "/kept";
  EXPECT_EQ(bad_row(report), "disk") << "the folder is not there";
  report.recorder.open = true;
  report.recorder.needed_mb = 64;
  report.recorder.room_mb = 63;
  EXPECT_EQ(bad_row(report), "disk") << "a recording has no room";
  report.recorder.room_mb = 64;
  report.recorder.counters.written = 3;
  EXPECT_EQ(bad_row(report), "");
  EXPECT_NE(self_test_answer(report).find("/kept, 3 written, 64 MB of room"), std::string::npos);
  report.recorder.counters.failed = 1;
  report.recorder.trouble = "/kept/box.y4m: cannot be written: No space left on device";
  EXPECT_EQ(bad_row(report), "disk");
  EXPECT_NE(self_test_answer(report).find("No space left"), std::string::npos);
}

TEST(SelfTest, TellsHowTheRobotsLinkIsDoing) {
  BoxReport report = good_report();
  report.link_kind = "modbus";
  report.link.open = true;
  report.link.counters.requests = 1234;
  report.link.counters.crc_errors = 2;
  report.link.counters.cut_frames = 3;

  EXPECT_EQ(bad_row(report), "");
  EXPECT_NE(self_test_answer(report).find(
                R"("link":{"verdict":"good","words":"modbus, open, 1234 requests, 5 errors"})"),
            std::string::npos);
  EXPECT_NE(status_answer(report).find(R"("link":{"kind":"modbus","open":true,"requests":1234,)"),
            std::string::npos);
}

TEST(SelfTest, WhatIsNotWantedIsAbsentAndNotBad) {
  BoxReport report = good_report();
  report.tracking.lamp = false;
  report.priority = 0;
  report.tracking.scheduled = false;
  report.lock_wanted = false;
  report.memory_locked = false;

  EXPECT_EQ(bad_row(report), "");
  EXPECT_NE(self_test_answer(report).find(R"("disk":{"verdict":"absent")"), std::string::npos);
}

TEST(SelfTest, ACalibrationThatNamesNoCameraIsToldAndNoFault) {
  BoxReport report = good_report();
  report.camera = CameraStatus{true, "well", true, true, {}, {}};
  EXPECT_NE(self_test_answer(report).find(R"("identity":{"verdict":"good")"), std::string::npos);

  report.camera->doubt = "calibration is bound to no camera: this one is model = 'x'";
  EXPECT_EQ(bad_row(report), "");
  EXPECT_NE(
      self_test_answer(report).find(R"("identity":{"verdict":"absent","words":"calibration )"),
      std::string::npos);
  EXPECT_NE(status_answer(report).find("camera    well; calibration is bound to no camera"),
            std::string::npos);
}

TEST(StatusAnswer, TellsStateAndTubeInBothForms) {
  BoxReport report = good_report();
  core::Sighting& sighting = report.tracking.sighting;
  sighting.state = core::TrackState::kDegraded;
  sighting.reason = core::Reason::kFewTubes;
  sighting.tool_known = true;
  sighting.tool = {40, 60};
  sighting.offset_um_q8 = 256 * 735;
  sighting.aligned = true;

  const std::string answer = status_answer(report);

  EXPECT_NE(answer.find(R"("state":"degraded","reason":"few-tubes")"), std::string::npos);
  EXPECT_NE(answer.find(R"("tube":"40,60","aligned":true,"offset_mm":0.7350)"), std::string::npos);
  EXPECT_EQ(answer.find('\n'), std::string::npos);
  EXPECT_NE(drivers::find_json_string(answer, "text")
                .find("degraded (only two tube-ends left), under tube 40,60, 0.7350 mm off, "
                      "vouched for"),
            std::string::npos);
}

TEST(StatusAnswer, SaysNothingOfTrackingBeforeTheFirstTurn) {
  BoxReport report = good_report();
  report.turned = false;

  EXPECT_EQ(status_answer(report).find("\"tracking\":"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::board
