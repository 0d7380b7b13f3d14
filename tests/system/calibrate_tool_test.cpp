// `tubesight calibrate tool` on stills drawn with the guidetube docked, and what it must refuse.

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/settings_list.h"
#include "tests/system/docked_stills.h"

namespace tubesight::tests {
namespace {

using support::replaced;

constexpr std::array kTrue{-3.074, 31.629, 112.789, -0.0639, -0.8174, 47.9947};

TEST(CalibrateTool, FromADockedStillIsRight) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0\noffset_mm = [0.05, -0.04]");
  forget_table(folder, "d", "[tool]");
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
  forget_table(folder, "a", "[tool]");
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

  // By what stands there in the picture: the tube-end named, or others behind the guidetube.
  forget_table(folder, "d", "[tool]");
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,61", "d.pgm",
                               "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err,
            "d.pgm: docked on tube (40, 61) by --dock, but that tube-end is seen whole, expected "
            "the guidetube in front of it: another tube is docked on, or the clicks have wrong "
            "addresses\n");
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "38,61", "d.pgm",
                               "--guidetube-mm", "18.2,33", "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("d.pgm: docked on tube (38, 61) by --dock, but t"), std::string::npos)
      << run.err;

  // By another docking, and by a check.
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "41,60", "d.pgm",
                               "--dock", "40,60", "d.pgm", "--out", "tool.toml"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("the dockings contradict each other by 25.4 mm"), std::string::npos)
      << run.err;
  run = run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "41,60", "d.pgm",
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
  forget_table(folder, "d", "[tool]");
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
  EXPECT_TRUE(told({"--dock", "40,60", "d.pgm", "--dock-offset-mm", "9.4,0"})
                  .starts_with("--dock-offset-mm: '9.4,0', expected a tip within the tube, "));
  EXPECT_TRUE(
      told({"--dock", "40,60", "d.pgm", "--dock-height-mm", "nan"})
          .starts_with("tubesight: calibrate: --dock-height-mm: Value nan not in range -500"));
  EXPECT_TRUE(told({"--dock", "40,60", "d.pgm", "--heading-deg", "nan"})
                  .starts_with("tubesight: calibrate: --heading-deg: Value nan not in range -360"));
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--start", "1,2,3,4", "--start", "1,2,3,4"}),
            "--start: 2 for 1 dockings and checks, expected one for all or one for each\n");
  EXPECT_EQ(told({"--dock", "40,60", "absent.pgm"}),
            "absent.pgm: cannot be read: No such file or directory\n");
  folder.write("small.pgm", "P5\n320 240\n255\n" + std::string(320 * 240, 'x'));
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "small.pgm"}),
            "small.pgm: 320 x 240 pixels, expected 635 x 480 as [camera] of the settings says\n");
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--guidetube-mm", "18"}),
            "--guidetube-mm: '18', expected DIAMETER,LENGTH, 1 to 200 and 1 to 2000 mm\n");
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--picture", "d.pgm"}),
            "--picture: 'd.pgm' is also a picture, expected a place of its own\n");
  EXPECT_EQ(told({"--dock", "40,60", "d.pgm", "--points", "p.csv"}),
            "--points: beside --dock, expected one of the two; --check compares\n");
}

TEST(CalibrateTool, FindsTheEflOfACameraOfItsType) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0\noffset_mm = [0.05, -0.04]");
  forget_table(folder, "d", "[tool]");
  const std::string right = folder.read("d.session.toml");
  folder.write("type.toml", replaced(right, "focal_length_mm = 5.06", "focal_length_mm = 5.16"));

  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "tool", "type.toml", "--dock", "40,60", "d.pgm",
                             "--dock-offset-mm", "0.05,-0.04", "--free-efl", "--out", "tool.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find(" mm, freed from 5.1600\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("good for              tracking and position correction only"),
            std::string::npos)
      << run.out;
  const std::string settings = folder.read("tool.toml");
  double focal_mm = 0.0;
  double sigma_mm = 0.0;
  ASSERT_EQ(std::sscanf(settings.c_str() + settings.find("focal_length_mm"),
                        "focal_length_mm = %lf", &focal_mm),
            1);
  ASSERT_EQ(std::sscanf(settings.c_str() + settings.find("sigma = ["), "sigma = [%lf", &sigma_mm),
            1);
  EXPECT_NEAR(focal_mm, 5.06, 3.0 * sigma_mm);
  EXPECT_GT(sigma_mm, 0.0005);
  EXPECT_LT(sigma_mm, 0.02);
  const auto tip = list_of(settings, "position_mm");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(tip[i], kTrue[i], 0.3) << i;
  }
  EXPECT_NE(settings.find("focal_length_correlation = ["), std::string::npos);

  // It takes the place of the type's [camera], and `pose --total` knows how the two belong
  // together.
  std::string session = right;
  session.erase(session.find("[camera]"),
                session.find("\n[", session.find("[camera]") + 1) + 1 - session.find("[camera]"));
  folder.write("s.toml", "include = [\"tool.toml\"]\n" + session);
  const ProgramRun pose = run_tubesight(
      folder, {"pose", "s.toml", "d.pgm", "--total", "--start", clicks_of(folder, "d")});
  EXPECT_EQ(pose.status, 0) << pose.err;
  EXPECT_NE(pose.out.find("under tube (40, 60): offset 0.06"), std::string::npos) << pose.out;
}

TEST(CalibrateTool, FreesNoEflThatThePictureDoesNotTell) {
  const TemporaryFolder folder;
  draw_docked(
      folder, "d", "height_mm = 0",
      {{"position_mm = [-3.074, 31.629, 112.789]\nrotation_deg = [-0.0639, -0.8174, 47.9947]",
        "position_mm = [0.0, 75.0, 110.0]\nrotation_deg = [0.0, 0.0, 0.0]"}});
  forget_table(folder, "d", "[tool]");
  folder.write("tool.toml", "kept");

  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,60", "d.pgm",
                             "--free-efl", "--out", "tool.toml"});

  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_TRUE(
      run.err.starts_with("d.session.toml: no calibration: the docked pictures leave EFL "
                          "and distance open, "))
      << run.err;
  EXPECT_EQ(folder.read("tool.toml"), "kept");
}

TEST(CalibrateTool, StoresTheGuidetubesSilhouette) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0");
  forget_table(folder, "d", "[tool]");

  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--dock", "40,60", "d.pgm",
                             "--dock-offset-mm", "0,0", "--guidetube-mm", "18.2,33", "--picture",
                             "d.png", "--out", "tool.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("  silhouette            left found "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(", right found "), std::string::npos) << run.out;
  const std::string settings = folder.read("tool.toml");
  EXPECT_NE(settings.find("[silhouette]\ndiameter_mm = 18.2\nlength_mm = 33.0\nleft_px = [["),
            std::string::npos)
      << settings;
  EXPECT_TRUE(folder.read("d.png").starts_with("\x89PNG"));

  // A session takes the table, and says where it is wrong.
  folder.write("s.toml", "include = [\"tool.toml\"]\n" + folder.read("d.session.toml"));
  const std::vector<std::string> pose = {"pose", "s.toml", "d.pgm"};
  EXPECT_EQ(run_tubesight(folder, pose).status, 0);
  folder.write("tool.toml", replaced(settings, "left_px = [[", "left_px = [[-2, 1], ["));
  EXPECT_NE(run_tubesight(folder, pose).err.find("silhouette.left_px"), std::string::npos);
}

/// Twelve points of the guidetube of kTrue, computed beside this program.
constexpr const char* kPoints =
    "x_mm,y_mm,z_mm,u_px,v_px\n"
    "-7.881,-4.550,-2,274.01,374.85\n-3.846,-8.247,-2,291.90,366.96\n"
    "3.112,-8.551,-2,324.98,366.25\n7.454,-5.220,-2,344.96,373.34\n"
    "-7.881,-4.550,-8,272.73,400.84\n-3.846,-8.247,-8,291.15,393.52\n"
    "3.112,-8.551,-8,325.31,392.85\n7.454,-5.220,-8,345.91,399.42\n"
    "-7.881,-4.550,-14,271.42,428.29\n-3.846,-8.247,-14,290.39,421.65\n"
    "3.112,-8.551,-14,325.66,421.03\n7.454,-5.220,-14,346.90,426.98\n";

TEST(CalibrateTool, TakesPointsOnTheGuidetube) {
  const TemporaryFolder folder;
  draw_docked(folder, "d", "height_mm = 0");
  forget_table(folder, "d", "[tool]");
  folder.write("p.csv", replaced(kPoints, "3.112,-8.551,-8,325.31", "3.112,-8.551,-8,335.31"));

  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "tool", "d.session.toml", "--points", "p.csv", "--check",
                             "40,60", "d.pgm", "--picture", "p.png", "--out", "tool.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("tool from 11 points: RMS 0.0")) << run.out;
  EXPECT_NE(run.out.find("  line 8             left out: 10.0 px off"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("check on tube (40, 60): tip 0."), std::string::npos) << run.out;
  const auto tip = list_of(folder.read("tool.toml"), "position_mm");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(tip[i], kTrue[i], 0.1) << i;
  }
  EXPECT_TRUE(folder.read("p.png").starts_with("\x89PNG"));
}

TEST(CalibrateTool, TellsEachMistakeOfAPointsFile) {
  const TemporaryFolder folder;
  folder.write("s.toml", text_of(kSquare + "session.toml"));
  folder.write("tool.toml", "kept");
  const auto told = [&](const std::string& text, int status) {
    folder.write("p.csv", text);
    const ProgramRun run = run_tubesight(
        folder, {"calibrate", "tool", "s.toml", "--points", "p.csv", "--out", "tool.toml"});
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(folder.read("tool.toml"), "kept");
    return run.err;
  };

  EXPECT_EQ(told(replaced(kPoints, "-8.247,-8,", "north,-8,"), 2),
            "p.csv:7: y_mm: 'north', expected a number from -1000 to 1000 with up to 9 decimals\n");
  EXPECT_EQ(told(replaced(kPoints, "291.90", "1291.90"), 2),
            "p.csv:3: u_px: '1291.90', expected a number from -0.5 to 634.5 with up to 9 "
            "decimals\n");
  EXPECT_TRUE(told("x_mm,y_mm,u_px,v_px\n", 2).starts_with("p.csv:1: "));
  EXPECT_EQ(told("x_mm,y_mm,z_mm,u_px,v_px\n1,2,3,4,5\n", 1),
            "p.csv: no calibration: fewer than 6 points, expected 6 or more, so that a wrong one "
            "can be told\n");
  std::string mirrored = kPoints;
  for (const std::string row : {"\n-7.881", "\n-3.846", "\n3.112", "\n7.454"}) {
    const std::string other = row[1] == '-' ? "\n" + row.substr(2) : "\n-" + row.substr(1);
    for (std::size_t at = mirrored.find(row); at != std::string::npos; at = mirrored.find(row)) {
      mirrored.replace(at, row.size(), other);
    }
  }
  EXPECT_TRUE(told(mirrored, 1).starts_with("p.csv: no calibration: the points fit mirrored, "));
}

}  // namespace
}  // namespace tubesight::tests
