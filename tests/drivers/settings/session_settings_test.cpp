#include "drivers/settings/session_settings.h"

#include <array>
#include <cstddef>
#include <memory>

#include <gtest/gtest.h>

#include "tests/drivers/settings/settings_files.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

const std::string kWhole = kCameraTable + kToolTable + kTubesheetTable + kStartTable;

class SessionSettings : public testing::Test {
 protected:
  Messages load(const std::string& text, NeededTables needed = kReplayNeeds) {
    MemoryFiles files;
    files.texts["s.toml"] = text;
    Messages messages;
    const auto outcome = load_session_settings(files, "s.toml", needed, *session_, messages);
    EXPECT_EQ(outcome.has_value(), messages.empty());
    return messages;
  }

  /// The mistakes after one passage of the whole settings is replaced.
  Messages load_with(const std::string& from, const std::string& to) {
    std::string text = kWhole;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return load(text.replace(at, from.size(), to));
  }

  std::unique_ptr<SessionFile> session_ = std::make_unique<SessionFile>();
  const core::SessionSettings& settings_ = session_->settings;
};

TEST_F(SessionSettings, ReadsEveryTable) {
  ASSERT_EQ(load(kWhole + "optimum_px = [320, 190.5]\n[motion]\nmax_speed_mm_s = 250\n"
                          "max_acceleration_mm_s2 = 2000.5\nmax_height_speed_mm_s = 150\n"
                          "max_height_acceleration_mm_s2 = 1000\nmax_turn_speed_deg_s = 600\n"
                          "max_turn_acceleration_deg_s2 = 2000\nmax_lean_speed_deg_s = 25\n"
                          "max_lean_acceleration_deg_s2 = 500\n[edges]\ninitial_threshold = 150\n"
                          "region_threshold = 50\n[verification]\naligned_within_mm = 2\n"
                          "claim_within_s = 0.04\nclaim_oldest_s = 0.2\n"
                          "[camera_quality]\nid = \"c1\"\nserial = \"4711\"\nmodel = \"m\"\nsigma "
                          "= [1.0]\n[tool_quality]\n"
                          "id = \"t1\"\nmade_at = 1995-08-01\n"),
            Messages{});

  EXPECT_EQ(settings_.camera.width_px, 635);
  EXPECT_EQ(settings_.camera.scan, core::Scan::kEvenFirst);
  EXPECT_EQ(settings_.camera.center_px[1], 233.8);
  EXPECT_EQ(settings_.camera.distortion2_per_mm4, 0.0);
  EXPECT_EQ(settings_.tool.position_mm[2], 112.789);
  EXPECT_EQ(settings_.tool.rotation_deg[0], -0.0639);
  EXPECT_EQ(settings_.tubesheet.row_step_mm[1], 25.4);
  EXPECT_EQ(settings_.tubesheet.columns[1], 120);
  EXPECT_EQ(settings_.tubesheet.weld, core::Weld::kFlush);
  EXPECT_EQ(settings_.tubesheet.addresses, core::AddressParity::kAll);
  ASSERT_EQ(settings_.tubesheet.missing.size(), 2);
  EXPECT_EQ(settings_.tubesheet.missing[1], (core::TubeAddress{50, 62}));
  ASSERT_EQ(settings_.tubesheet.plugged.size(), 1);
  ASSERT_EQ(settings_.start.tubes.size(), 3);
  EXPECT_EQ(settings_.start.tubes[1].address, (core::TubeAddress{41, 60}));
  EXPECT_EQ(settings_.start.tubes[1].at_px[1], 251.0);
  EXPECT_EQ(settings_.start.window_px[2], 595);
  EXPECT_EQ(settings_.start.optimum_px[1], 190.5);
  EXPECT_EQ(settings_.motion.max_speed_mm_s, 250.0);
  EXPECT_EQ(settings_.motion.max_acceleration_mm_s2, 2000.5);
  EXPECT_EQ(settings_.motion.max_height_speed_mm_s, 150.0);
  EXPECT_EQ(settings_.motion.max_height_acceleration_mm_s2, 1000.0);
  EXPECT_EQ(settings_.motion.max_turn_speed_deg_s, 600.0);
  EXPECT_EQ(settings_.motion.max_turn_acceleration_deg_s2, 2000.0);
  EXPECT_EQ(settings_.motion.max_lean_speed_deg_s, 25.0);
  EXPECT_EQ(settings_.motion.max_lean_acceleration_deg_s2, 500.0);
  EXPECT_EQ(settings_.edges.initial_threshold, 150);
  EXPECT_EQ(settings_.edges.region_threshold, 50);
  EXPECT_EQ(settings_.verification.aligned_within_mm, 2.0);
  EXPECT_EQ(settings_.verification.claim_within_s, 0.04);
  EXPECT_EQ(settings_.verification.claim_oldest_s, 0.2);
  EXPECT_EQ(session_->camera_quality.id, "c1");
  EXPECT_EQ(session_->camera_quality.serial, "4711");
  EXPECT_EQ(session_->camera_quality.model, "m");
  EXPECT_EQ(session_->tool_quality.id, "t1");
  EXPECT_TRUE(session_->has_tool);
}

TEST_F(SessionSettings, TakesACalibrationsUncertaintyWhereItHasSixNumbers) {
  ASSERT_EQ(load(kWhole + "[camera_quality]\nid = \"c1\"\nsigma = [1, 2, 3, 4, 5]\n"
                          "[tool_quality]\nid = \"t1\"\nsigma = [0.1, 0.2, 0.3, 1, 2, 3]\n"
                          "correlation = [[1, 0.5, 0, 0, 0, 0], [0.5, 1, 0, 0, 0, 0],"
                          "[0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0],"
                          "[0, 0, 0, 0, 0, 1]]\n"),
            Messages{});

  EXPECT_FALSE(session_->camera_quality.has_sigma);
  EXPECT_TRUE(session_->tool_quality.has_sigma);
  EXPECT_EQ(session_->tool_quality.sigma[2], 0.3);
  EXPECT_EQ(session_->tool_quality.correlation[1], 0.5);
  EXPECT_EQ(session_->camera_quality.correlation[7], 1.0);
  EXPECT_EQ(session_->camera_quality.correlation[1], 0.0);
}

TEST_F(SessionSettings, HasTheDefaultsOfTheConventions) {
  ASSERT_EQ(load(kWhole), Messages{});

  EXPECT_EQ(settings_.start.optimum_px[0], 317.5);  // the middle of 40..595
  EXPECT_EQ(settings_.start.optimum_px[1], 185.0);  // of 40..330
  EXPECT_EQ(settings_.motion.max_speed_mm_s, 300.0);
  EXPECT_EQ(settings_.motion.max_acceleration_mm_s2, 3000.0);
  EXPECT_EQ(settings_.motion.max_height_speed_mm_s, 0.0);
  EXPECT_EQ(settings_.motion.max_turn_speed_deg_s, 360.0);
  EXPECT_EQ(settings_.motion.max_lean_speed_deg_s, 30.0);
  EXPECT_EQ(settings_.verification.aligned_within_mm, 2.5);
  EXPECT_EQ(settings_.verification.claim_within_s, 0.05);
  EXPECT_EQ(settings_.verification.claim_oldest_s, 0.25);
  EXPECT_EQ(settings_.tubesheet.origin_mm[0], 0.0);
  EXPECT_EQ(settings_.tubesheet.odd_row_shift, 0.0);
}

TEST_F(SessionSettings, ReadsTheShiftOfOddRows) {
  ASSERT_EQ(load_with("rows = [0, 120]", "odd_row_shift = -0.25\nrows = [0, 120]"), Messages{});
  EXPECT_EQ(settings_.tubesheet.odd_row_shift, -0.25);
  EXPECT_EQ(load_with("rows = [0, 120]", "odd_row_shift = 1.25\nrows = [0, 120]"),
            Messages{"s.toml:20: tubesheet.odd_row_shift: 1.25, expected a number from -1 to 1 of "
                     "a column step"});
  ASSERT_EQ(load(kWhole), Messages{});
  EXPECT_EQ(settings_.tubesheet.odd_row_shift, 0.0);
}

TEST_F(SessionSettings, ForgetsWhatItReadBefore) {
  ASSERT_EQ(load(kWhole + "[motion]\nmax_speed_mm_s = 250\n"), Messages{});
  ASSERT_EQ(load(kWhole), Messages{});

  EXPECT_EQ(settings_.motion.max_speed_mm_s, 300.0);
  EXPECT_EQ(settings_.tubesheet.missing.size(), 2);
  EXPECT_EQ(settings_.start.tubes.size(), 3);
}

TEST_F(SessionSettings, AsksForTheTablesNeeded) {
  EXPECT_EQ(
      load(kCameraTable),
      (Messages{"s.toml:1: tool: the table is missing, expected [tool] here or in an included file",
                "s.toml:1: tubesheet: the table is missing, expected [tubesheet] here or in an "
                "included file",
                "s.toml:1: start: the table is missing, expected [start] here or in an included "
                "file"}));
  EXPECT_EQ(load(kCameraTable + kTubesheetTable, kPoseNeeds), Messages{});
  EXPECT_FALSE(session_->has_tool);
  EXPECT_FALSE(session_->has_start);
  EXPECT_EQ(settings_.start.window_px, (std::array<std::int32_t, 4>{0, 0, 634, 479}));
}

TEST_F(SessionSettings, TellsAllMistakesInTheOrderOfLines) {
  EXPECT_EQ(
      load("[camera]\nwidth_px = 5000\nheight_px = 480.0\nscan = \"both\"\nfocal_length_mm = "
           "\"5\"\ncell_width_mm = nan\ncell_height_mm = 0.0098\nsensor_columns = 768\n"
           "horizontal_scale = 1\ncenter_px = [1]\ndistortion_per_mm2 = true\nzoom = 3\n" +
           kToolTable + kTubesheetTable + kStartTable),
      (Messages{"s.toml:1: camera.frame_columns: missing, expected an integer from 16 to 16384",
                "s.toml:2: camera.width_px: 5000, expected an integer from 64 to 4096",
                "s.toml:3: camera.height_px: 480.0, expected an integer from 64 to 4096",
                "s.toml:4: camera.scan: the text 'both', expected \"even-first\" or \"odd-first\" "
                "or \"progressive\"",
                "s.toml:5: camera.focal_length_mm: the text '5', expected a number from 0.1 to "
                "1000 mm",
                "s.toml:6: camera.cell_width_mm: nan, expected a number from 0.0005 to 0.1 mm",
                "s.toml:10: camera.center_px: a list of 1, expected 2 times a number from 0 to "
                "4096 px",
                "s.toml:11: camera.distortion_per_mm2: true, expected a number from -10 to 10 per "
                "mm2",
                "s.toml:12: camera.zoom: unknown key, expected one of width_px, height_px, scan, "
                "focal_length_mm, cell_width_mm, cell_height_mm, sensor_columns, frame_columns, "
                "horizontal_scale, center_px, distortion_per_mm2, distortion2_per_mm4"}));
}

TEST_F(SessionSettings, ChecksTheTubesheet) {
  EXPECT_EQ(load_with("rows = [0, 120]", "rows = [120, 0]"),
            Messages{"s.toml:20: tubesheet.rows: the first, 120, is above the last, 0, expected "
                     "[first, last]"});
  EXPECT_EQ(load_with("bore_mm = 18.6", "bore_mm = 26"),
            Messages{"s.toml:19: tubesheet.bore_mm: 26, expected less than the 25.4 mm between "
                     "neighbouring tubes"});
  EXPECT_EQ(load_with("column_step_mm = [25.4, 0.0]", "column_step_mm = [0, 30]"),
            Messages{"s.toml:18: tubesheet.column_step_mm: the steps lie in one line, expected "
                     "row_step_mm and column_step_mm at least 6 degrees apart"});
  EXPECT_EQ(
      load_with("           [50, 62]", "           [50, 200]"),
      Messages{"s.toml:23: tubesheet.missing[1]: tube (50, 200), expected a row from 0 to 120 "
               "and a column from 0 to 120"});
  EXPECT_EQ(load_with("[[48, 60]]", "[[48, 60, 1], 7]"),
            (Messages{"s.toml:24: tubesheet.plugged[0]: a list of 3, expected [row, column]",
                      "s.toml:24: tubesheet.plugged[1]: 7, expected [row, column]"}));
  EXPECT_EQ(load_with("[[48, 60]]", "[[50, 61]]"),
            Messages{"s.toml:24: tubesheet.plugged: tube (50, 61) is missing as well, expected it "
                     "in one list"});
}

TEST_F(SessionSettings, RefusesMoreTubesThanItHolds) {
  std::string list = "[";
  for (int i = 0; i <= core::kMaxListedTubes; ++i) {
    list += "[1,1],";
  }
  EXPECT_EQ(load_with("[[48, 60]]", list + "]"),
            Messages{"s.toml:24: tubesheet.plugged: 16385 tubes, expected at most 16384"});
}

TEST_F(SessionSettings, AsksForThreeClicksWhereNoLatticeIsFoundCold) {
  std::string text = kWhole;
  const std::string third = ",\n          { row = 40, column = 61, at_px = [387, 186] }";
  text.erase(text.find(third), third.size());

  EXPECT_EQ(load(text, {true, true, true, true}),
            Messages{"s.toml:26: start.tubes: a list of 2, expected at least 3 times { row = R, "
                     "column = C, at_px = [U, V] }"});
  EXPECT_EQ(load(text), Messages{});
  EXPECT_EQ(settings_.start.tubes.size(), 2);
}

TEST_F(SessionSettings, ReadsTheHeadingOfAStart) {
  EXPECT_EQ(load(kWhole), Messages{});
  EXPECT_FALSE(session_->heading_deg);

  ASSERT_EQ(load_with("window_px", "heading_deg = -170.5\nwindow_px"), Messages{});
  EXPECT_EQ(session_->heading_deg, -170.5);

  EXPECT_EQ(load_with("window_px", "heading_deg = 361\nwindow_px").size(), 1U);
}

TEST_F(SessionSettings, ChecksTheStart) {
  EXPECT_EQ(load_with("at_px = [321, 251]", "at_px = [321, 480]"),
            Messages{"s.toml:27: start.tubes[1].at_px: (321, 480), expected a place in the picture "
                     "of 635 x 480"});
  EXPECT_EQ(load_with("row = 41, column = 60,", "row = 50, column = 61,"),
            Messages{"s.toml:27: start.tubes[1]: tube (50, 61) is listed as missing, expected a "
                     "tube that stands"});
  EXPECT_EQ(load_with("row = 41, column = 60,", "row = 39, column = 60,"),
            Messages{"s.toml:26: start.tubes: the clicks go round the other way than their "
                     "addresses, expected the order of row_step_mm and column_step_mm (rows and "
                     "columns swapped, or a step's sign?)"});
  EXPECT_EQ(load_with("row = 41, column = 60,", "row = 41,"),
            Messages{"s.toml:27: start.tubes[1].column: missing, expected an integer from -9999 to "
                     "9999"});
  EXPECT_EQ(load_with("[40, 40, 595, 330]", "[40, 40, 635, 330]"),
            Messages{"s.toml:29: start.window_px: reaches to (635, 330), expected at most (634, "
                     "479)"});
  EXPECT_EQ(load_with("[40, 40, 595, 330]", "[595, 40, 40, 330]"),
            Messages{"s.toml:29: start.window_px: -554 x 291 pixels, expected left, top, right, "
                     "bottom at least 64 apart"});
  EXPECT_EQ(load(kWhole + "optimum_px = [20, 190]\n"),
            Messages{"s.toml:30: start.optimum_px: (20, 190), expected a place in window_px"});
}

TEST_F(SessionSettings, ChecksTheOptionalTables) {
  EXPECT_EQ(load(kWhole + "[motion]\nmax_speed_mm_s = 0\n[edges]\nregion_threshold = 256\n"
                          "[verification]\nwithin = 2\n[[tool_quality]]\n"),
            (Messages{"s.toml:31: motion.max_speed_mm_s: 0, expected a number from 1 to 1600 mm/s",
                      "s.toml:33: edges.region_threshold: 256, expected an integer from 0 to 255",
                      "s.toml:35: verification.within: unknown key, expected one of "
                      "aligned_within_mm, claim_within_s, claim_oldest_s",
                      "s.toml:36: tool_quality: a list of tables, expected [tool_quality] once"}));
}

TEST_F(SessionSettings, ChecksTheLimitsOfHeightHeadingAndLean) {
  EXPECT_EQ(
      load(kWhole + "[motion]\nmax_height_speed_mm_s = -1\n"
                    "max_height_acceleration_mm_s2 = 1000001\nmax_turn_speed_deg_s = 0\n"
                    "max_turn_acceleration_deg_s2 = 0.5\nmax_lean_speed_deg_s = 3601\n"
                    "max_lean_acceleration_deg_s2 = 100001\n"),
      (Messages{
          "s.toml:31: motion.max_height_speed_mm_s: -1, expected a number from 0 to 1600 mm/s",
          "s.toml:32: motion.max_height_acceleration_mm_s2: 1000001, expected a number from 0 "
          "to 1000000 mm/s2",
          "s.toml:33: motion.max_turn_speed_deg_s: 0, expected a number from 1 to 3600 "
          "degrees/s",
          "s.toml:34: motion.max_turn_acceleration_deg_s2: 0.5, expected a number from 1 to "
          "100000 degrees/s2",
          "s.toml:35: motion.max_lean_speed_deg_s: 3601, expected a number from 1 to 3600 "
          "degrees/s",
          "s.toml:36: motion.max_lean_acceleration_deg_s2: 100001, expected a number from 1 to "
          "100000 degrees/s2"}));
  EXPECT_EQ(load(kWhole + "[motion]\nmax_height_speed_mm_s = 0\nmax_turn_speed_deg_s = 3600\n"
                          "max_lean_speed_deg_s = 1\nmax_turn_acceleration_deg_s2 = 100000\n"),
            Messages{});
}

TEST_F(SessionSettings, NamesTheIncludedFile) {
  const support::TemporaryFolder folder;
  folder.write("camera.toml", "[camera]\nwidth_px = 1\n");
  const std::string path =
      folder.write("s.toml", "include = [\"camera.toml\"]\n" + kToolTable + kTubesheetTable);
  Messages messages;

  EXPECT_FALSE(load_session_settings(path, kPoseNeeds, *session_, messages));

  ASSERT_EQ(messages.size(), 11u) << "the other keys of [camera] are missing";
  EXPECT_EQ(messages.back(), folder.path("camera.toml") +
                                 ":2: camera.width_px: 1, expected an integer from 64 to 4096");
}

TEST_F(SessionSettings, DoesNotMissTablesOfAFileThatIsNoToml) {
  EXPECT_EQ(load("[camera\n").size(), 1u);
}

TEST_F(SessionSettings, CountsWhatItDoesNotTell) {
  std::string text = kWhole + "[motion]\n";
  for (int i = 0; i < 60; ++i) {
    text += "key" + std::to_string(i) + " = 1\n";
  }

  const Messages messages = load(text);

  ASSERT_EQ(messages.size(), 51u);
  EXPECT_EQ(messages.back(), "s.toml: and 10 more mistakes");
}

TEST_F(SessionSettings, KeepsTheGuidetubesSilhouette) {
  SilhouetteSettings told;
  told.diameter_mm = 18.2;
  told.length_mm = 33.5;
  told.edges[0] = {{{270.125, 370.25}, {266.5, 479.0}}, 0.125, true};
  told.edges[1] = {{}, 0.75, false};
  told.edges[2] = {{{352.0, 371.5}, {358.25, 479.0}}, 0.25, true};
  const std::string text = silhouette_text(told);

  ASSERT_EQ(load(kWhole + text), Messages{});

  const SilhouetteSettings& read = session_->silhouette;
  EXPECT_EQ(read.diameter_mm, 18.2);
  EXPECT_EQ(read.length_mm, 33.5);
  for (std::size_t i = 0; i < told.edges.size(); ++i) {
    EXPECT_EQ(read.edges[i].points_px, told.edges[i].points_px) << i;
    EXPECT_EQ(read.edges[i].sigma_px, told.edges[i].sigma_px) << i;
    EXPECT_EQ(read.edges[i].measured, told.edges[i].measured) << i;
  }
  ASSERT_EQ(load(kWhole), Messages{});
  EXPECT_EQ(session_->silhouette.diameter_mm, 0.0) << "of the file before";
}

TEST_F(SessionSettings, TellsWhatIsWrongWithASilhouette) {
  const std::string table =
      "[silhouette]\ndiameter_mm = 0.5\nlength_mm = 33\nleft_px = [[1, 2], [3]]\n"
      "right_px = [[1, -2]]\nmeasured = [\"top\"]\nsigma_px = [0.1, 0.1]\n";
  const Messages messages = load(kWhole + table);

  ASSERT_EQ(messages.size(), 5u);
  const std::string words = messages[0] + messages[1] + messages[2] + messages[3] + messages[4];
  for (const char* const part :
       {"silhouette.diameter_mm: 0.5, expected a number from 1 to 200 mm",
        "expected [u, v], each from 0 to 4096 px", "the text 'top', expected \"left\", \"tip\"",
        "silhouette.sigma_px: a list of 2, expected 3 times a number"}) {
    EXPECT_NE(words.find(part), std::string::npos) << part << "\n" << words;
  }
}

TEST_F(SessionSettings, TakesAnEflsCorrelationWithTheTool) {
  ASSERT_EQ(
      load(kWhole + "[tool_quality]\nid = \"a\"\nfocal_length_correlation = [0.1, 0, -0.9, 0, "
                    "0, 0.25]\n"),
      Messages{});
  EXPECT_EQ(session_->tool_quality.focal_length_correlation,
            (std::array<double, 6>{0.1, 0.0, -0.9, 0.0, 0.0, 0.25}));
}

}  // namespace
}  // namespace tubesight::drivers
