#include "drivers/settings/session_text.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/settings/session_settings.h"
#include "tests/drivers/settings/settings_files.h"
#include "tests/drivers/settings/table_text.h"

namespace tubesight::drivers {
namespace {

/// Everything different from its default.
std::unique_ptr<SessionFile> odd_session() {
  auto file = std::make_unique<SessionFile>();
  MemoryFiles files;
  files.texts["s.toml"] =
      "[camera]\nwidth_px = 635\nheight_px = 480\nscan = \"odd-first\"\nfocal_length_mm = 5.0603\n"
      "cell_width_mm = 0.00841\ncell_height_mm = 0.0098\nsensor_columns = 768\n"
      "frame_columns = 635\nhorizontal_scale = 1.021\ncenter_px = [324.37, 233.81]\n"
      "distortion_per_mm2 = 0.0092\ndistortion2_per_mm4 = -0.00001\n"
      "[tool]\nposition_mm = [-3.074145, 31.628971, 112.789218]\n"
      "rotation_deg = [-0.0639064, -0.8174368, 47.9947489]\n"
      "[tubesheet]\norigin_mm = [1.5, -2.25]\nrow_step_mm = [0.0, 19.24741459910915]\n"
      "column_step_mm = [11.1125, 0.0]\nbore_mm = 14.2\nweld = \"fillet\"\nrows = [-3, 120]\n"
      "columns = [-4, 121]\naddresses = \"odd-sum\"\nodd_row_shift = -0.375\nmissing = [[1, 2], "
      "[3, 4]]\n"
      "plugged = [[5, 6]]\n"
      "[start]\ntubes = [ { row = 40, column = 61, at_px = [313.25, 196] },\n"
      "{ row = 41, column = 60, at_px = [288, 230] }, { row = 40, column = 63, at_px = [360, 190] "
      "} ]\n"
      "window_px = [41, 37, 594, 329]\noptimum_px = [300.5, 170]\n"
      "[motion]\nmax_speed_mm_s = 251.5\nmax_acceleration_mm_s2 = 2001\n"
      "max_height_speed_mm_s = 201.5\nmax_height_acceleration_mm_s2 = 1501\n"
      "max_turn_speed_deg_s = 301.5\nmax_turn_acceleration_deg_s2 = 1201\n"
      "max_lean_speed_deg_s = 21.5\nmax_lean_acceleration_deg_s2 = 501\n"
      "[edges]\ninitial_threshold = 210\nregion_threshold = 61\n"
      "[verification]\naligned_within_mm = 2.25\n"
      "claim_within_s = 0.031\nclaim_oldest_s = 0.35\n";
  Messages messages;
  const bool good =
      load_session_settings(files, "s.toml", kReplayNeeds, *file, messages).has_value();
  EXPECT_TRUE(good) << (messages.empty() ? "" : messages.front());
  return file;
}

TEST(SessionText, ReadsBackAsItWasToTheLastBit) {
  const auto before = odd_session();
  const std::string text = session_text(before->settings);
  MemoryFiles files;
  files.texts["again.toml"] = text;
  const auto after = std::make_unique<SessionFile>();
  Messages messages;

  ASSERT_TRUE(load_session_settings(files, "again.toml", kReplayNeeds, *after, messages))
      << messages.front() << "\n"
      << text;

  const core::SessionSettings& a = before->settings;
  const core::SessionSettings& b = after->settings;
  EXPECT_EQ(b.camera.scan, core::Scan::kOddFirst);
  EXPECT_EQ(a.camera.focal_length_mm, b.camera.focal_length_mm);
  EXPECT_EQ(a.camera.center_px, b.camera.center_px);
  EXPECT_EQ(a.camera.distortion2_per_mm4, b.camera.distortion2_per_mm4);
  EXPECT_EQ(a.camera.cell_width_mm, b.camera.cell_width_mm);
  EXPECT_EQ(a.tool.position_mm, b.tool.position_mm);
  EXPECT_EQ(a.tool.rotation_deg, b.tool.rotation_deg);
  EXPECT_EQ(a.tubesheet.origin_mm, b.tubesheet.origin_mm);
  EXPECT_EQ(a.tubesheet.row_step_mm, b.tubesheet.row_step_mm);
  EXPECT_EQ(b.tubesheet.weld, core::Weld::kFillet);
  EXPECT_EQ(b.tubesheet.addresses, core::AddressParity::kOddSum);
  EXPECT_EQ(b.tubesheet.odd_row_shift, -0.375);
  EXPECT_EQ(a.tubesheet.rows, b.tubesheet.rows);
  EXPECT_EQ(a.tubesheet.columns, b.tubesheet.columns);
  ASSERT_EQ(b.tubesheet.missing.size(), 2);
  EXPECT_EQ(b.tubesheet.missing[1], (core::TubeAddress{3, 4}));
  ASSERT_EQ(b.tubesheet.plugged.size(), 1);
  ASSERT_EQ(b.start.tubes.size(), 3);
  EXPECT_EQ(b.start.tubes[0].at_px[0], 313.25);
  EXPECT_EQ(a.start.window_px, b.start.window_px);
  EXPECT_EQ(a.start.optimum_px, b.start.optimum_px);
  EXPECT_EQ(b.motion.max_speed_mm_s, 251.5);
  EXPECT_EQ(b.motion.max_turn_acceleration_deg_s2, 1201.0);
  EXPECT_EQ(b.edges.initial_threshold, 210);
  EXPECT_EQ(b.verification.aligned_within_mm, 2.25);
  EXPECT_EQ(b.verification.claim_within_s, 0.031);
  EXPECT_EQ(b.verification.claim_oldest_s, 0.35);
}

/// Every key of a session, none at its default, as session_text() writes it.
const std::string kEveryKey =
    "[camera]\nwidth_px = 635\nheight_px = 480\nscan = \"odd-first\"\nfocal_length_mm = 5.0603\n"
    "cell_width_mm = 0.00841\ncell_height_mm = 0.0098\nsensor_columns = 768\n"
    "frame_columns = 635\nhorizontal_scale = 1.021\ncenter_px = [324.37, 233.81]\n"
    "distortion_per_mm2 = 0.0092\ndistortion2_per_mm4 = -0.00001\n"
    "\n[tool]\nposition_mm = [-3.074145, 31.628971, 112.789218]\n"
    "rotation_deg = [-0.0639064, -0.8174368, 47.9947489]\n"
    "\n[tubesheet]\norigin_mm = [1.5, -2.25]\nrow_step_mm = [0.0, 19.24741459910915]\n"
    "column_step_mm = [11.1125, 0.0]\nbore_mm = 14.2\nweld = \"fillet\"\nrows = [-3, 120]\n"
    "columns = [-4, 121]\naddresses = \"odd-sum\"\nodd_row_shift = -0.375\n"
    "missing = [[1, 2], [3, 4]]\nplugged = [[5, 6]]\n"
    "\n[motion]\nmax_speed_mm_s = 251.5\nmax_acceleration_mm_s2 = 2001.0\n"
    "max_height_speed_mm_s = 201.5\nmax_height_acceleration_mm_s2 = 1501.0\n"
    "max_turn_speed_deg_s = 301.5\nmax_turn_acceleration_deg_s2 = 1201.0\n"
    "max_lean_speed_deg_s = 21.5\nmax_lean_acceleration_deg_s2 = 501.0\n"
    "\n[edges]\ninitial_threshold = 210\nregion_threshold = 61\n"
    "\n[verification]\naligned_within_mm = 2.25\nclaim_within_s = 0.031\n"
    "claim_oldest_s = 0.35\n"
    "\n[start]\ntubes = [{ row = 40, column = 61, at_px = [313.25, 196.0] }, "
    "{ row = 41, column = 60, at_px = [288.0, 230.0] }, "
    "{ row = 40, column = 63, at_px = [360.0, 190.0] }]\n"
    "window_px = [41, 37, 594, 329]\noptimum_px = [300.5, 170.0]\n";

/// Reads a session's text; what is told of it goes to `messages`.
bool read(const std::string& text, SessionFile& file, Messages& messages) {
  MemoryFiles files;
  files.texts["s.toml"] = text;
  messages.clear();
  return load_session_settings(files, "s.toml", kReplayNeeds, file, messages).has_value();
}

TEST(SessionText, WritesEveryKeyAsItWasRead) {
  const auto file = std::make_unique<SessionFile>();
  Messages messages;

  ASSERT_TRUE(read(kEveryKey, *file, messages)) << messages.front();

  EXPECT_EQ(session_text(file->settings), kEveryKey);
}

TEST(SessionText, WritesEveryKeyThatTheReaderKnows) {
  const auto file = std::make_unique<SessionFile>();
  Messages messages;
  Messages all;
  for (const std::string& text : with_an_unknown_key(kEveryKey)) {
    EXPECT_FALSE(read(text, *file, messages));
    all.insert(all.end(), messages.begin(), messages.end());
  }

  // What a person says of the tool's heading, for a start of one click, is no setting of the box.
  EXPECT_EQ(surplus_of(all, kEveryKey), std::set<std::string>{"start.heading_deg"});

  // Within a click, too.
  const std::size_t click = kEveryKey.find("{ row");
  ASSERT_FALSE(read(kEveryKey.substr(0, click) + "{ unheard_of = 1, " + kEveryKey.substr(click + 2),
                    *file, messages));
  EXPECT_EQ(expected_words(messages.front()), (std::vector<std::string>{"row", "column", "at_px"}));
}

TEST(SessionText, WritesEveryTableThatTheReaderKnowsButWhatACalibrationSays) {
  const auto file = std::make_unique<SessionFile>();
  Messages messages;
  ASSERT_FALSE(read(kEveryKey + "[unheard_of]\n", *file, messages));

  for (const std::string& table : expected_words(messages.front())) {
    const bool calibrated = table == "camera_quality" || table == "tool_quality" ||
                            table == "base" || table == "base_quality" || table == "silhouette";
    EXPECT_EQ(kEveryKey.find("[" + table + "]\n") == std::string::npos, calibrated) << table;
  }
}

// A key whose value is the default could be lost on the way and nobody would see.
TEST(SessionText, TellsEveryKeyOfTheTestFromItsDefault) {
  const auto file = std::make_unique<SessionFile>();
  Messages messages;
  for (const TextKey& key : keys_of(kEveryKey)) {
    // A session refused without the key is another one, too.
    if (read(without(kEveryKey, key), *file, messages)) {
      EXPECT_NE(session_text(file->settings), kEveryKey) << key.table << "." << key.key;
    }
  }
}

}  // namespace
}  // namespace tubesight::drivers
