#include "drivers/scenario/scenario_file.h"

#include <gtest/gtest.h>

#include "tests/drivers/scenario/scenario_reading.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

TEST(ScenarioFile, NeedsAPathAndLeavesTheRestAtItsDefaults) {
  const ScenarioReading read(kRestPath);

  ASSERT_TRUE(read.good) << read.told();
  const drivers::Scenario& scenario = read.scenario();
  EXPECT_EQ(scenario.seed, 1U);
  EXPECT_EQ(scenario.video.rate_numerator, 30);
  EXPECT_EQ(scenario.video.window_margin_px, -1);
  EXPECT_EQ(scenario.light.lamp_permille, 1000);
  EXPECT_TRUE(scenario.faults.empty());
  EXPECT_TRUE(scenario.events.empty());
  EXPECT_EQ(scenario.scene.sheet.bore_mm, 18.6);
  EXPECT_EQ(scenario.told.start.tubes.size(), 3) << "clicks are made of the truth";
  EXPECT_EQ(read.file->files, (std::vector<std::string>{"s.toml", "plant.toml"}));
}

TEST(ScenarioFile, MakesClicksOnTheTubesNamedAsFarOffAsSaid) {
  drivers::MemoryFiles files;
  files.texts["s.toml"] = kRestPath + drivers::kCameraTable + drivers::kToolTable +
                          drivers::kTubesheetTable +
                          "[start]\nwindow_px = [40, 36, 595, 330]\noff_center = 0.0\n"
                          "click_on = [[40, 60], [41, 60], [40, 61], [41, 61]]\n";
  ScenarioReading read(kRestPath);  // for its storage

  read.messages.clear();
  ASSERT_TRUE(load_scenario(files, "s.toml", {}, *read.file, read.messages)) << read.told();

  const auto& clicks = read.scenario().told.start.tubes;
  ASSERT_EQ(clicks.size(), 4);
  EXPECT_EQ(clicks[3].address, (core::TubeAddress{41, 61}));
  // Where the recording of this camera, tool and height has tube (40, 60), within the change of
  // place: (311, 191).
  EXPECT_NEAR(clicks[0].at_px[0], 311.0, 6.0);
  EXPECT_NEAR(clicks[0].at_px[1], 191.0, 6.0);
}

TEST(ScenarioFile, TakesTheClicksThatAreGiven) {
  drivers::MemoryFiles files;
  files.texts["s.toml"] = kRestPath + drivers::kCameraTable + drivers::kToolTable +
                          drivers::kTubesheetTable + drivers::kStartTable;
  ScenarioReading read(kRestPath);

  read.messages.clear();
  ASSERT_TRUE(load_scenario(files, "s.toml", {}, *read.file, read.messages)) << read.told();

  ASSERT_EQ(read.scenario().told.start.tubes.size(), 3);
  EXPECT_EQ(read.scenario().told.start.tubes[2].at_px[0], 387.0);
}

TEST(ScenarioFile, OverridesSeedAndWindow) {
  const ScenarioReading read(kRestPath + "[scenario]\nseed = 7\n", {9, true});

  ASSERT_TRUE(read.good) << read.told();
  EXPECT_EQ(read.scenario().seed, 9U);
  EXPECT_EQ(read.scenario().video.window_margin_px, 24);
}

TEST(ScenarioFile, TheTruthDiffersFromWhatIsToldByTheCalibrationErrors) {
  const ScenarioReading read(kRestPath +
                             "[calibration_error]\n"
                             "tool_position_mm = [0.1, -0.2, 0.3]\n"
                             "tool_rotation_deg = [0.01, 0.02, 0.03]\n"
                             "focal_length_mm = 0.01\n"
                             "center_px = [1, -1]\n"
                             "pitch_share = 0.005\n"
                             "bore_mm = -0.1\n");

  ASSERT_TRUE(read.good) << read.told();
  const drivers::Scenario& scenario = read.scenario();
  EXPECT_NEAR(scenario.scene.tool.position_mm[1], 31.629 - 0.2, 1e-12);
  EXPECT_NEAR(scenario.scene.tool.rotation_deg[2], 47.9947 + 0.03, 1e-12);
  EXPECT_NEAR(scenario.scene.camera.focal_length_mm, 5.07, 1e-12);
  EXPECT_NEAR(scenario.scene.camera.center_px[1], 232.8, 1e-12);
  EXPECT_NEAR(scenario.scene.sheet.row_step_mm[1], 25.527, 1e-12);
  EXPECT_NEAR(scenario.scene.sheet.bore_mm, 18.5, 1e-12);
  EXPECT_EQ(scenario.told.tubesheet.row_step_mm[1], 25.4);
  EXPECT_EQ(scenario.told.tool.position_mm[1], 31.629);
}

TEST(ScenarioFile, WhatStandsUnlistedIsTrueAndNotTold) {
  const ScenarioReading read(
      kRestPath +
      "[sheet]\nrolled = [[40, 63]]\nflush = [[39, 62], [48, 60]]\n"
      "voids = [[38, 60]]\n"
      "displaced = [ { row = 41, column = 60, by_mm = [0.1, 0.2, -0.5] } ]\n");

  ASSERT_TRUE(read.good) << read.told();
  const auto& scene = read.scenario().scene;
  ASSERT_EQ(scene.plugs.size(), 3);
  EXPECT_EQ(scene.plugs[0].kind, core::rendering::PlugKind::kRolled);
  EXPECT_EQ(scene.plugs[1].address, (core::TubeAddress{39, 62}));
  EXPECT_EQ(scene.sheet.missing.size(), 3);
  EXPECT_EQ(read.scenario().told.tubesheet.missing.size(), 2);
  EXPECT_EQ(read.scenario().told.tubesheet.plugged.size(), 1);
  EXPECT_EQ(scene.displaced[0].by_mm[2], -0.5);
}

TEST(ScenarioFile, ReadsLooksAndLight) {
  const ScenarioReading read(
      kRestPath +
      "[look]\nboron = 0.25\n[sensor]\nblur_px = 1.1\n"
      "[guidetube]\nradius_mm = 8\n"
      "[lamp]\nlamp_permille = 400\npwm_hz = 200\nlag_s = 0.25\nring = 0.5\nbeam = 4\n"
      "[scenario]\nsheet_seed = 12\n");

  ASSERT_TRUE(read.good) << read.told();
  const drivers::Scenario& scenario = read.scenario();
  EXPECT_EQ(scenario.scene.look.boron, 0.25);
  EXPECT_EQ(scenario.scene.sensor.blur_px, 1.1);
  EXPECT_EQ(scenario.scene.guidetube.radius_mm, 8.0);
  EXPECT_EQ(scenario.light.lamp_permille, 400);
  EXPECT_EQ(scenario.light.pwm_hz, 200.0);
  EXPECT_EQ(scenario.light.lag_s, 0.25);
  EXPECT_EQ(scenario.light.ring, 0.5);
  EXPECT_EQ(scenario.scene.lamp.beam, 4.0);
  EXPECT_EQ(scenario.scene.seed, 12U);
}

TEST(ScenarioFile, KeepsTheRateAsAFraction) {
  const ScenarioReading read(kRestPath + "[video]\nrate_hz = 29.97\n");

  ASSERT_TRUE(read.good) << read.told();
  EXPECT_EQ(read.scenario().video.rate_numerator, 2997);
  EXPECT_EQ(read.scenario().video.rate_denominator, 100);
}

TEST(ScenarioFile, HandsEventsOverInTheOrderOfTheirTimes) {
  const ScenarioReading read(kRestPath +
                             "[[event]]\nkind = \"lamp\"\nat_s = 0.7\nlamp_permille = 500\n"
                             "[[event]]\nkind = \"start\"\nat_s = 0.6\n"
                             "[[event]]\nkind = \"claim\"\nat_s = 0.1\ntube = [3, 4]\n"
                             "[[event]]\nkind = \"pick\"\nat_s = 0.2\nat_px = [300, 200.5]\n"
                             "[[event]]\nkind = \"pose\"\nat_s = 0.3\n");

  ASSERT_TRUE(read.good) << read.told();
  const auto& events = read.scenario().events;
  ASSERT_EQ(events.size(), 5U);
  EXPECT_EQ(tests::content_of<core::Claim>(events[0].event).tube, (core::TubeAddress{3, 4}));
  EXPECT_EQ(tests::content_of<core::Pick>(events[1].event).at_px[1], 200.5);
  EXPECT_TRUE(tests::is<core::PoseRequest>(events[2].event));
  EXPECT_EQ(tests::content_of<core::Start>(events[3].event).tubes.size(), 3);
  EXPECT_EQ(tests::content_of<core::LampCommand>(events[4].event).permille, 500);
}

TEST(ScenarioFile, ReadsWhatIsExpected) {
  const ScenarioReading read(
      kRestPath +
      "[expect]\nanswered = 0.4\nmissed = 0.6\nend = \"lost\"\n"
      "lost = \"gap\"\ndegraded = \"dark\"\ncontradicted = 2\n"
      "confirmed = 3\ntubes = 4\nundetectable = true\n[scenario]\ntitle = \"a title\"\n");

  ASSERT_TRUE(read.good) << read.told();
  const Expectation& expect = read.file->expect;
  EXPECT_EQ(expect.answered, 0.4);
  EXPECT_EQ(expect.missed, 0.6);
  EXPECT_EQ(expect.end, core::TrackState::kLost);
  EXPECT_EQ(expect.lost, core::Reason::kGap);
  EXPECT_EQ(expect.degraded, core::Reason::kDark);
  EXPECT_EQ(expect.contradicted, 2);
  EXPECT_EQ(expect.confirmed, 3);
  EXPECT_EQ(expect.tubes, 4);
  EXPECT_TRUE(expect.undetectable);
  EXPECT_EQ(read.file->title, "a title");
}

struct Wrong {
  const char* text;
  const char* message;
};

class ScenarioFileRefuses : public testing::TestWithParam<Wrong> {};

TEST_P(ScenarioFileRefuses, InOneLineWithPlaceAndExpectation) {
  const ScenarioReading read(kRestPath + GetParam().text);

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(), std::string(GetParam().message) + "\n");
}

// The include and the path are lines 1 to 5.
INSTANTIATE_TEST_SUITE_P(
    What, ScenarioFileRefuses,
    testing::Values(
        Wrong{"[video]\nexposure_s = 0.02\n",
              "s.toml:7: video.exposure_s: longer than a field of 16667 us, expected at most that"},
        Wrong{"[sheet]\nvoids = [[48, 60]]\n",
              "s.toml:7: sheet.voids[0]: tube (48, 60) is plugged as well, expected one of them"},
        Wrong{"[sheet]\nrolled = [[1, 2], [1, 2]]\n",
              "s.toml:7: sheet.rolled[1]: tube (1, 2) is listed twice, expected one plug a tube"},
        Wrong{"[sheet]\nflush = [[50, 61]]\n",
              "s.toml:7: sheet.flush[0]: tube (50, 61) is listed as missing, expected a tube that "
              "stands"},
        Wrong{"[sheet]\ndisplaced = [[1, 2]]\n",
              "s.toml:7: sheet.displaced[0]: a list of 2, expected { row = R, column = C, by_mm = "
              "[X, Y, Z] }"},
        Wrong{"[look]\nboron = 2\n", "s.toml:7: look.boron: 2, expected a number from 0 to 1"},
        Wrong{"[look]\nplate = 0\n", "s.toml:7: look.plate: 0, expected a number from 0.01 to 1"},
        Wrong{"[lamp]\nbeam = 30\n", "s.toml:7: lamp.beam: 30, expected a number from 0 to 8"},
        Wrong{"[sensor]\ngain = 0\n",
              "s.toml:7: sensor.gain: 0, expected a number from 0.01 to 10"},
        Wrong{"[look]\nland_mm = 2\nfillet_mm = 1.5\n",
              "s.toml:7: look.land_mm: 2, expected at most the 1.5 mm of fillet_mm"},
        Wrong{"[look]\nfillet_mm = 1\n",
              "s.toml:7: look.fillet_mm: 1, expected at least the 1.2 mm of land_mm"},
        Wrong{"[[lamp]]\nring = 1\n", "s.toml:6: lamp: a list of tables, expected [lamp] once"},
        Wrong{"[fault]\nkind = \"black\"\n",
              "s.toml:6: fault: one table, expected a list of [[fault]]"},
        Wrong{"[[event]]\nkind = \"lamp\"\nat_s = 2\nlamp_permille = 1\n",
              "s.toml:8: event[0].at_s: after the recording's end, expected within it"},
        Wrong{"[[event]]\nkind = \"start\"\nat_s = 0.5\nclick_on = [[1, 1], [2, 2], [1, 2]]\n",
              "s.toml:6: event[0]: tube (1, 1) is not in the picture then, expected tubes to click "
              "on that are"},
        Wrong{"[calibration_error]\nbore_mm = 2.0\npitch_share = -0.02\ncenter_px = [1]\n",
              "s.toml:9: calibration_error.center_px: a list of 1, expected 2 times a number from "
              "-50 to 50 px"},
        Wrong{"[expect]\nend = \"gone\"\n",
              "s.toml:7: expect.end: the text 'gone', expected \"waiting\" or \"tracking\" or "
              "\"degraded\" or \"lost\""}));

TEST(ScenarioFile, TellsTheMistakesOfAllTablesAtOnce) {
  const ScenarioReading read(
      "[path]\ntube = [40, 60]\nheight_mm = 500\n[[step]]\nrest_s = \"long\"\n"
      "[video]\nrate_hz = 0\n[[fault]]\nkind = \"blink\"\nat_s = 0\n[scenario]\nsed = 1\n");

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.messages.size(), 4U) << read.told();  // the steps wait for a sound path
}

TEST(ScenarioFile, RefusesAScenarioThatTakesNoTime) {
  const ScenarioReading read("[path]\ntube = [40, 60]\n");

  EXPECT_EQ(read.told(),
            "s.toml:2: path: it takes no time, expected a [[step]] or video.length_s\n");
}

TEST(ScenarioFile, SaysNothingOfAPathThatABrokenFileMayHold) {
  const ScenarioReading read("[video]\nrate_hz = 25\n", {}, "[tubesheet\n");

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.messages.size(), 1U) << read.told();
  EXPECT_TRUE(read.told().starts_with("plant.toml:")) << read.told();
}

TEST(ScenarioFile, SaysThatThereIsNoPath) {
  const ScenarioReading read("[video]\nrate_hz = 25\n");

  EXPECT_EQ(read.told(),
            "s.toml:1: path: the table is missing, expected [path] here or in an included file\n");
}

TEST(ScenarioFile, RefusesWhatTheTrackingCannotCompute) {
  const ScenarioReading read(kRestPath + "[video]\nlength_s = 0.1\n", {},
                             "[tubesheet]\nrow_step_mm = [0.0, 1.5]\ncolumn_step_mm = [1.5, 0.0]\n"
                             "bore_mm = 1.0\nrows = [0, 120]\ncolumns = [0, 120]\n");

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.messages.size(), 1U) << read.told();
}

}  // namespace
}  // namespace tubesight::drivers
