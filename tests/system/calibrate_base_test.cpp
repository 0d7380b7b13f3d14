// `tubesight calibrate base` on pairs of poses, and what it must refuse.

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/settings_list.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::replaced;
using support::TemporaryFolder;

constexpr const char* kHeader =
    "name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg,"
    "tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,sigma_x_mm,"
    "sigma_y_mm,sigma_z_mm,use\n";

/// A pair of a robot whose base is level at (310, -140, -1000), turned by 30 degrees, and whose
/// tool vision sees turned by another 25: worked out by hand, R = Rz throughout. `off` is the
/// robot's error.
std::string pair_row(const std::string& name, double x, double y, double heading_deg,
                     const std::array<double, 3>& off, bool turned) {
  const double turn = 30.0 * std::numbers::pi / 180.0;
  const double dx = x + off[0] - 310.0;
  const double dy = y + off[1] + 140.0;
  std::array<char, 400> row{};
  std::array<char, 80> robot_angles{",,"};
  std::array<char, 80> tool_angles{",,"};
  if (turned) {
    std::snprintf(robot_angles.data(), robot_angles.size(), "%.5f,0,0", heading_deg - 55.0);
    std::snprintf(tool_angles.data(), tool_angles.size(), "%.5f,0,0", heading_deg);
  }
  std::snprintf(row.data(), row.size(),
                "%s,%.4f,%.4f,%.4f,%s,%.4f,%.4f,-30.0000,%s,0.0200,0.0200,0.0400,1\n", name.c_str(),
                std::cos(turn) * dx + std::sin(turn) * dy,
                std::cos(turn) * dy - std::sin(turn) * dx, 970.0 + off[2], robot_angles.data(), x,
                y, tool_angles.data());
  return row.data();
}

std::string pairs_text(bool turned = true) {
  return kHeader + pair_row("p0", -900.0, -700.0, 10.0, {0.3, -0.2, 0.5}, turned) +
         pair_row("p1", 800.0, -750.0, 60.0, {-0.4, 0.1, -0.7}, turned) +
         pair_row("p2", 900.0, 820.0, 140.0, {0.2, 0.4, 0.3}, turned) +
         pair_row("p3", -850.0, 790.0, -80.0, {-0.1, -0.5, 0.6}, turned) +
         pair_row("p4", 20.0, 60.0, -20.0, {0.1, 0.3, -0.4}, turned) +
         pair_row("p5", 100.0, 950.0, 35.0, {-0.3, -0.1, 0.2}, turned);
}

ProgramRun run_base(const TemporaryFolder& folder, const std::vector<std::string>& further = {}) {
  std::vector<std::string> all = {"calibrate", "base", "pairs.csv"};
  all.insert(all.end(), further.begin(), further.end());
  return run_tubesight(folder, all);
}

TEST(CalibrateBase, FindsTheBaseAndWritesIt) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text());
  folder.write("base.toml", "what stood here");

  const ProgramRun run = run_base(folder, {"--out", "base.toml", "--picture", "base.png"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.starts_with("base from 6 pairs\n")) << run.out;
  EXPECT_NE(run.out.find("points to the sheet"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("good for"), std::string::npos);
  const std::string settings = folder.read("base.toml");
  const auto position = list_of(settings, "position_mm");
  const auto rotation = list_of(settings, "rotation_deg");
  EXPECT_NEAR(position[0], 310.0, 1.0);
  EXPECT_NEAR(position[1], -140.0, 1.0);
  EXPECT_NEAR(position[2], -1000.0, 1.0);
  EXPECT_NEAR(rotation[0], 30.0, 0.05);
  EXPECT_NEAR(rotation[1], 0.0, 0.05);
  EXPECT_NEAR(rotation[2], 0.0, 0.05);
  EXPECT_NE(settings.find("[base_quality]\nid = \""), std::string::npos) << settings;
  EXPECT_EQ(folder.read("base.toml.bak"), "what stood here");
  EXPECT_TRUE(folder.read("base.png").starts_with("\x89PNG"));
}

TEST(CalibrateBase, NamesThePairThatDoesNotFit) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text() + pair_row("of another tube", 500.0, 100.0, 0.0,
                                                    {25.4, 0.0, 0.0}, true));

  const ProgramRun run = run_base(folder);

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("base from 6 pairs, 1 left out\n")) << run.out;
  const std::size_t at = run.out.find("pair of another tube");
  ASSERT_NE(at, std::string::npos) << run.out;
  EXPECT_NE(run.out.substr(at, run.out.find('\n', at) - at).find("left out"), std::string::npos);
}

TEST(CalibrateBase, TakesPlacesAloneAndALevelBase) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text(false));

  const ProgramRun run = run_base(folder, {"--level", "--out", "base.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  const auto rotation = list_of(folder.read("base.toml"), "rotation_deg");
  EXPECT_NEAR(rotation[0], 30.0, 0.05);
  EXPECT_EQ(rotation[1], 0.0);
  EXPECT_EQ(rotation[2], 0.0);
}

TEST(CalibrateBase, ComparesWithDockings) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text());
  folder.write("touches.csv", kHeader +
                                  pair_row("t0", -900.0, -700.0, 0.0, {0.5, 0.5, 0.0}, false) +
                                  pair_row("t1", 800.0, -750.0, 0.0, {-0.5, 0.2, 0.0}, false) +
                                  pair_row("t2", 20.0, 900.0, 0.0, {0.2, -0.6, 0.0}, false));

  const ProgramRun run = run_base(folder, {"--touches", "touches.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("by 3 dockings, level"), std::string::npos) << run.out;
}

TEST(CalibrateBase, RefusesABadRowAndSaysWhatAndWhere) {
  struct Case {
    const char* from;
    const char* to;
    const char* message;
  };
  const std::array cases{
      Case{"p2,", "p2,1e3", "pairs.csv:4: robot_x_mm: "},
      Case{"p1,", "p1,,", "pairs.csv:3: "},
      Case{",1\n", ",yes\n", "pairs.csv:2: use: 'yes'"},
      Case{",0.0400,1\n", ",-0.0400,1\n", "pairs.csv:2: sigma_z_mm: "},
      Case{",0,0,", ",,0,", "pairs.csv:2: robot_beta_deg: ''"},
      Case{",0.0400,1\n", ",0.0400,1\nq,1,2,3,0,0,0,4,5,501,0,0,0,0.1,0.1,0.1,1\n",
           "pairs.csv:3: tool_z_mm: '501', expected the tool below the sheet"},
      Case{"name,robot_x_mm", "robot_x_mm,name", "pairs.csv:1: "},
  };
  for (const Case& bad : cases) {
    const TemporaryFolder folder;
    std::string text = pairs_text();
    const std::size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos) << bad.from;
    folder.write("pairs.csv", text.replace(at, std::string(bad.from).size(), bad.to));
    folder.write("base.toml", "what stood here");

    const ProgramRun run = run_base(folder, {"--out", "base.toml"});

    EXPECT_EQ(run.status, 2) << bad.to;
    EXPECT_TRUE(run.err.starts_with(bad.message)) << bad.to << ": " << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
    EXPECT_EQ(folder.read("base.toml"), "what stood here");
  }
}

TEST(CalibrateBase, RefusesPairsThatMakeNoBase) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& further,
                          const std::string& why) {
    const TemporaryFolder folder;
    folder.write("pairs.csv", text);
    folder.write("base.toml", "what stood here");
    std::vector<std::string> all = {"--out", "base.toml"};
    all.insert(all.end(), further.begin(), further.end());
    const ProgramRun run = run_base(folder, all);
    EXPECT_EQ(run.status, 1) << why;
    EXPECT_TRUE(run.err.starts_with("pairs.csv: no base: " + why)) << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
    EXPECT_EQ(folder.read("base.toml"), "what stood here");
  };
  const std::string two =
      kHeader + pair_row("a", 0.0, 0.0, 0.0, {}, true) + pair_row("b", 500.0, 0.0, 0.0, {}, true);
  refused(two, {}, "fewer than three pairs");
  refused(kHeader + pair_row("a", 0.0, 0.0, 0.0, {}, true) +
              pair_row("b", 5.0, 0.0, 50.0, {}, true) + pair_row("c", 0.0, 5.0, 90.0, {}, true),
          {}, "all pairs stand at one place");
  refused(kHeader + pair_row("a", 0.0, 0.0, 0.0, {}, false) +
              pair_row("b", 500.0, 0.0, 0.0, {}, false) + pair_row("c", 900.0, 0.0, 0.0, {}, false),
          {}, "all places are in one line");
  refused(pairs_text() + pair_row("d", 500.0, 0.0, 0.0, {40.0, 0.0, 0.0}, true) +
              pair_row("e", -500.0, 0.0, 0.0, {0.0, 40.0, 0.0}, true) +
              pair_row("f", 0.0, 500.0, 0.0, {-40.0, 10.0, 0.0}, true) +
              pair_row("g", 0.0, -500.0, 0.0, {30.0, 30.0, 0.0}, true) +
              pair_row("h", 200.0, -500.0, 0.0, {-30.0, 50.0, 0.0}, true) +
              pair_row("i", 300.0, -500.0, 0.0, {-80.0, 50.0, 0.0}, true),
          {}, "the pairs contradict each other");
  refused(pairs_text(), {"--tool-known"}, "the places fit one base and the angles do not");
}

TEST(CalibrateBase, IsReadByOtherCommands) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text());
  ASSERT_EQ(run_base(folder, {"--out", "base.toml"}).status, 0);
  folder.write("session.toml",
               "include = [\"base.toml\"]\n[tubesheet]\nrow_step_mm = [0.0, 25.4]\n"
               "column_step_mm = [25.4, 0.0]\nbore_mm = 18.6\nrows = [-30, 30]\n"
               "columns = [-30, 30]\n");

  const ProgramRun run = run_base(folder, {"--sheet", "session.toml"});

  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(CalibrateBase, RefusesWhatBelongsToAnotherCalibration) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", pairs_text());
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "camera", "pairs.csv", "--level"}).status, 2);
  EXPECT_EQ(run_base(folder, {"--dock", "1,2", "x.png"}).status, 2);
  EXPECT_EQ(run_base(folder, {"--out", "pairs.csv"}).status, 2);
}

}  // namespace
}  // namespace tubesight::tests
