// What the program says and leaves when the settings are wrong.

#include <string>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"
#include "tests/system/tiny_replay.h"
#include "tests/system/tiny_session.h"

namespace tubesight::tests {
namespace {

using support::replaced;
using support::TemporaryFolder;

struct SettingsMistake {
  const char* name;
  const char* right;
  const char* wrong;
  const char* line;
};

class SettingsMistakes : public ::testing::TestWithParam<SettingsMistake> {};

TEST_P(SettingsMistakes, AreRefusedByOneLineWithItsPlace) {
  const TemporaryFolder folder;
  folder.write("s.toml", replaced(tiny_session(), GetParam().right, GetParam().wrong));
  folder.write("r.y4m", recording());

  expect_refused(folder, "r.y4m", GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, SettingsMistakes,
    ::testing::Values(
        SettingsMistake{"UnknownKey", "bore_mm = 18.6\n", "bore_mm = 18.6\nbore_inch = 0.7\n",
                        "s.toml:20: tubesheet.bore_inch: unknown key, expected one of origin_mm, "
                        "row_step_mm, column_step_mm, bore_mm, weld, rows, columns, addresses, "
                        "odd_row_shift, missing, plugged"},
        SettingsMistake{"MissingKey", "bore_mm = 18.6\n", "",
                        "s.toml:16: tubesheet.bore_mm: missing, expected a number from 1 to 200 "
                        "mm"},
        SettingsMistake{"WrongType", "width_px = 96", "width_px = \"96\"",
                        "s.toml:2: camera.width_px: the text '96', expected an integer from 64 to "
                        "4096"},
        SettingsMistake{"OutOfRange", "horizontal_scale = 1.021", "horizontal_scale = 10.21",
                        "s.toml:10: camera.horizontal_scale: 10.21, expected a number from 0.5 to "
                        "2"},
        SettingsMistake{"UnknownWord", "\"even-first\"", "\"even\"",
                        "s.toml:4: camera.scan: the text 'even', expected \"even-first\" or "
                        "\"odd-first\" or \"progressive\""},
        SettingsMistake{"IncludeNotThere", "[camera]", "include = [\"tool.toml\"]\n[camera]",
                        "s.toml:1: include: 'tool.toml' cannot be read: No such file or "
                        "directory"},
        SettingsMistake{"ClicksTheOtherWayRound", "at_px = [70, 30]", "at_px = [10, 30]",
                        "s.toml:23: start.tubes: the clicks go round the other way than their "
                        "addresses, expected the order of row_step_mm and column_step_mm (rows and "
                        "columns swapped, or a step's sign?)"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(ReplaySettings, BeyondTheFixedPointFormatAreRefused) {
  const TemporaryFolder folder;
  folder.write("s.toml",
               replaced(tiny_session(), "focal_length_mm = ", "focal_length_mm = 0.1  # was "));
  folder.write("r.y4m", recording());

  expect_refused(
      folder, "r.y4m",
      "s.toml: the tracking cannot compute with these settings together, expected neighbouring "
      "tubes from 2 mm apart and a picture within 60 degrees of the optical axis");
}

TEST(ReplaySettings, TellsAllMistakesOfTheSettingsAtOnce) {
  const TemporaryFolder folder;
  const std::string one = replaced(tiny_session(), "width_px = 96", "width_px = 9");
  folder.write("s.toml", replaced(one, "bore_mm = 18.6", "bore_mm = 0"));
  folder.write("r.y4m", recording());

  expect_refused(folder, "r.y4m",
                 "s.toml:2: camera.width_px: 9, expected an integer from 64 to 4096\n"
                 "s.toml:19: tubesheet.bore_mm: 0, expected a number from 1 to 200 mm");
}

TEST(ReplaySettings, RefusesTheSameTableTwice) {
  const TemporaryFolder folder;
  folder.write("s.toml", "include = [\"sheet.toml\"]\n" + tiny_session());
  folder.write("sheet.toml", "[tubesheet]\nbore_mm = 18.6\n");
  folder.write("r.y4m", recording());
  const auto before = folder.names();

  const ProgramRun run = replay(folder, "r.y4m");

  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("[tubesheet]: the table is already in "), std::string::npos) << run.err;
  EXPECT_EQ(folder.names().size(), before.size());
}

}  // namespace
}  // namespace tubesight::tests
