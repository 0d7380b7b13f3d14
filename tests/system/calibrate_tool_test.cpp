// `tubesight calibrate tool` on stills drawn with the guidetube docked, and what it must refuse.

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/settings_list.h"
#include "tests/system/pose_stills.h"

namespace tubesight::tests {
namespace {

using support::replaced;

constexpr std::array kTrue{-3.074, 31.629, 112.789, -0.0639, -0.8174, 47.9947};

/// Draws the tool of the shipped example at rest on tube (40, 60) as `path` says, the first frame
/// into NAME.pgm; the clicks are in NAME.session.toml.
void draw_docked(const TemporaryFolder& folder, const std::string& name, const std::string& path) {
  std::string text = replaced(text_of(TUBESIGHT_SOURCE_DIR "/docs/examples/steam-generator.toml"),
                              "window_px = [40, 36, 595, 330]", "window_px = [8, 8, 627, 472]");
  text.erase(text.find("[path]"));
  folder.write(name + ".toml", text + "[video]\nlength_s = 0.04\n[path]\ntube = [40, 60]\n" + path +
                                   "\n[[step]]\nrest_s = 1\n");
  const ProgramRun run = run_tubesight(folder, {"simulate", name + ".toml", "--out", name});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string video = folder.read(name + ".y4m");
  const std::size_t frame = video.find("FRAME\n");
  ASSERT_NE(frame, std::string::npos);
  folder.write(name + ".pgm", "P5\n635 480\n255\n" + video.substr(frame + 6, 635 * 480));
}

/// The session of a drawing, without [tool], as it is not known yet.
void forget_tool(const TemporaryFolder& folder, const std::string& name) {
  std::string text = folder.read(name + ".session.toml");
  const std::size_t at = text.find("[tool]");
  const std::size_t next = text.find("\n[", at);
  ASSERT_NE(next, std::string::npos);
  folder.write(name + ".session.toml", text.erase(at, next + 1 - at));
}

/// --start of a drawing's own clicks.
std::string clicks_of(const TemporaryFolder& folder, const std::string& name) {
  const std::string text = folder.read(name + ".session.toml");
  std::string clicks;
  for (std::size_t at = text.find("{ row = "); at != std::string::npos;
       at = text.find("{ row = ", at + 1)) {
    int row = 0;
    int column = 0;
    double u = 0.0;
    double v = 0.0;
    EXPECT_EQ(std::sscanf(text.c_str() + at, "{ row = %d, column = %d, at_px = [%lf, %lf]", &row,
                          &column, &u, &v),
              4);
    clicks += (clicks.empty() ? "" : ";") + std::to_string(row) + "," + std::to_string(column) +
              "," + std::to_string(u) + "," + std::to_string(v);
  }
  return clicks;
}

TEST(CalibrateTool, FromADockedStillIsRight) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0\noffset_mm = [0.05, -0.04]");
  forget_tool(folder, "d");
  folder.write("tool.toml", "what stood here");

  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,60", "d.pgm",
                             "--dock-offset-mm", "0.05,-0.04", "--out", "tool.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.starts_with("docked on tube (40, 60): ")) << run.out;
  const std::string settings = folder.read("tool.toml");
  const auto tip = list_of(settings, "position_mm");
  const auto angles = list_of(settings, "rotation_deg");
  const auto sigma = list_of(settings, "sigma");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(tip[i], kTrue[i], 0.02) << i;
    EXPECT_NEAR(angles[i], kTrue[i + 3], 0.02) << i;
    EXPECT_GT(sigma[i], 0.0005);
    EXPECT_LT(sigma[i], 0.01) << "the offset is known";
  }
  EXPECT_NE(settings.find("[tool_quality]\nid = \""), std::string::npos);
  EXPECT_EQ(folder.read("tool.toml.bak"), "what stood here");

  // What it wrote is what a session includes.
  std::string session = folder.read("d.session.toml");
  folder.write("s.toml", "include = [\"tool.toml\"]\n" + session);
  const ProgramRun pose =
      run_tubesight(folder, {"pose", "s.toml", "d.pgm", "--start", clicks_of(folder, "d")});
  EXPECT_EQ(pose.status, 0) << pose.err;
  EXPECT_NE(pose.out.find("under tube (40, 60): offset 0.0640 mm"), std::string::npos) << pose.out;
}

TEST(CalibrateTool, TakesSeveralHeadingsAndChecksAnother) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"calibrate", "tool", "a.session.toml"};
  std::vector<std::string> starts;
  for (const std::string name : {"a", "b", "c"}) {
    draw_docked(folder, name,
                "height_mm = 0\noffset_mm = [0.1, 0.0]\nheading_deg = " +
                    std::string(name == "a"   ? "0"
                                : name == "b" ? "90"
                                              : "180"));
    arguments.insert(arguments.end(), {name == "c" ? "--check" : "--dock", "40,60", name + ".pgm"});
    starts.insert(starts.end(), {"--start", clicks_of(folder, name)});
  }
  forget_tool(folder, "a");
  arguments.insert(arguments.end(), starts.begin(), starts.end());

  const ProgramRun run = run_tubesight(folder, arguments);

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("dockings              tips within 0.0"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("docked off the middle dx 0.0"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("check on tube (40, 60): tip 0.1"), std::string::npos) << run.out;
}

TEST(CalibrateTool, RefusesTheWrongTubeWhereItCanTell) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0");
  folder.write("tool.toml", "kept");

  // By the session's [tool].
  ProgramRun run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,61",
                                          "d.pgm", "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err,
            "d.pgm: docked on tube (40, 61) by --dock, under tube (40, 60) by [tool], expected the "
            "two to agree; without [tool] in the session if it is of another tool\n");

  // By another docking, and by a check.
  forget_tool(folder, "d");
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,61", "d.pgm",
                               "--dock", "40,60", "d.pgm", "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("the dockings contradict each other by 25.4 mm"), std::string::npos)
      << run.err;
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,61", "d.pgm",
                               "--check", "40,60", "d.pgm", "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("the check on tube (40, 60) has the tip 25.4 mm off its centre"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(folder.read("tool.toml"), "kept");
}

TEST(CalibrateTool, TellsEachMistakeOfItsArguments) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0");
  forget_tool(folder, "d");
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"calibrate", "tool", "d.session.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_tubesight(folder, arguments);
    EXPECT_EQ(run.status, 2) << run.err;
    return run.err;
  };

  EXPECT_EQ(told({}), "--dock: none is given, expected ROW,COLUMN IMAGE... of a docking\n");
  EXPECT_EQ(told({"--dock", "d.pgm", "40,60"}),
            "--dock: 'd.pgm', expected ROW,COLUMN of the tube before its pictures\n");
  EXPECT_EQ(told({"--dock", "40,60", "41,60"}),
            "--dock: no picture of the docking on tube (40, 60), expected ROW,COLUMN IMAGE...\n");
  EXPECT_EQ(told({"--dock", "400,60", "d.pgm"}),
            "--dock: (400, 60) is no open tube-end of this tubesheet\n");
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--dock-offset-mm", "1"}),
            "--dock-offset-mm: '1', expected X,Y on the sheet\n");
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--start", "1,2,3,4", "--start", "1,2,3,4"}),
            "--start: 2 for 1 dockings and checks, expected one for all or one for each\n");
  EXPECT_EQ(told({"--dock", "40,60", "absent.pgm"}),
            "absent.pgm: cannot be read: No such file or directory\n");
}

}  // namespace
}  // namespace tubesight::tests
