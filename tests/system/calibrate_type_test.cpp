// A camera without a template of its own, from a type's calibration to a tube named: the third tier
// of the source.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/settings_list.h"
#include "tests/system/calibrate_views.h"
#include "tests/system/docked_stills.h"

namespace tubesight::tests {
namespace {

/// A points file of ten lines of ten points, 8 mm apart, as the camera of the shipped example sees
/// them from `away_mm`.
std::string points_at(double away_mm) {
  constexpr double kFocal_mm = 5.06;
  std::string rows = "x_mm,y_mm,u_px,v_px\n";
  for (int i = 0; i < 100; ++i) {
    const double x = 8.0 * (i % 10);
    const double y = 8.0 * (i / 10);
    const double far = away_mm + 0.005 * (y - 36.0);
    const double ideal_x = kFocal_mm * (x - 36.0) / far;
    const double ideal_y = kFocal_mm * (y - 36.0) / far;
    double factor = 1.0;
    for (int k = 0; k < 60; ++k) {
      factor = 1.0 + 0.0092 * (ideal_x * ideal_x + ideal_y * ideal_y) / (factor * factor);
    }
    const double u = 324.3 + ideal_x / factor * 1.021 * 635.0 / 768.0 / 0.0084;
    const double v = 233.8 + ideal_y / factor / 0.0098;
    rows += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(u) + "," +
            std::to_string(v) + "\n";
  }
  return rows;
}

const std::string kTarget =
    "[camera]\nwidth_px = 635\nheight_px = 480\nscan = \"even-first\"\ncell_width_mm = 0.0084\n"
    "cell_height_mm = 0.0098\nsensor_columns = 768\nframe_columns = 635\n[target]\nrows = 10\n"
    "columns = 10\nspacing_mm = 8.0\ndot_mm = 0\n";

/// Another unit of the type: 1.2 % of EFL, 3 and 2 px of the centre, 2 % of k.
const TextChanges kOtherUnit = {{"focal_length_mm = 5.06", "focal_length_mm = 5.12"},
                                {"center_px = [324.3, 233.8]", "center_px = [327.3, 231.8]"},
                                {"distortion_per_mm2 = 0.0092", "distortion_per_mm2 = 0.0094"}};

TEST(CalibrateType, LeadsFromATemplateOfAnotherUnitToTheRightTubes) {
  const TemporaryFolder folder;
  folder.write("near.csv", points_at(82.0));
  folder.write("far.csv", points_at(112.0));
  const ProgramRun type = calibrate(
      folder,
      kTarget + view_of("points = \"near.csv\"", "0") + view_of("points = \"far.csv\"", "30"),
      {"--type", "--out", "type.toml"});
  ASSERT_EQ(type.status, 0) << type.err;

  // This unit sees a docked tube.
  draw_docked(folder, "d", "height_mm = 0", kOtherUnit);
  forget_table(folder, "d", "[tool]");
  forget_table(folder, "d", "[camera]");
  folder.write("s.toml", "include = [\"type.toml\"]\n" + folder.read("d.session.toml"));
  const ProgramRun tool = run_tubesight(folder, {"calibrate", "tool", "s.toml", "--dock", "40,60",
                                                 "d.pgm", "--free-efl", "--out", "tool.toml"});
  ASSERT_EQ(tool.status, 0) << tool.err;
  EXPECT_NE(tool.out.find("good for              tracking and position correction only"),
            std::string::npos)
      << tool.out;
  EXPECT_NE(tool.out.find("  tip by this camera    0."), std::string::npos) << tool.out;
  const std::string settings = folder.read("tool.toml");
  EXPECT_NEAR(number_of(settings, "focal_length_mm"), 5.12, 3.0 * list_of(settings, "sigma")[0]);

  // With both it names tubes, at rest and on the way.
  draw_docked(folder, "m",
              "height_mm = 60\nspeed_mm_s = 100\n[[step]]\nrest_s = 0.1\n[[step]]\nto = [40, 61]",
              kOtherUnit, "0.7");
  forget_table(folder, "m", "[tool]");
  forget_table(folder, "m", "[camera]");
  folder.write("b.toml", "include = [\"tool.toml\"]\n" + folder.read("m.session.toml"));
  const ProgramRun replay =
      run_tubesight(folder, {"replay", "b.toml", "m.y4m", "--fields", "f.csv"});
  ASSERT_EQ(replay.status, 0) << replay.err;
  const std::string fields = folder.read("f.csv");
  const auto count = static_cast<int>(std::count(fields.begin(), fields.end(), '\n')) - 1;
  ASSERT_GT(count, 30);
  int aligned = 0;
  for (int i = 0; i < count; ++i) {
    const Row field(folder.path("f.csv"), i);
    if (field.text("aligned") == "1") {
      ++aligned;
      EXPECT_EQ(field.text("tool_row"), "40") << i;
      EXPECT_EQ(field.text("tool_column"), i < count / 2 ? "60" : "61") << i;
    }
  }
  EXPECT_GT(aligned, 5);
  EXPECT_EQ(Row(folder.path("f.csv"), count - 1).text("tool_column"), "61");
}

}  // namespace
}  // namespace tubesight::tests
