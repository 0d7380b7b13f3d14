// `tubesight pose` on the stills that come with their truth, and on what it must refuse.

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/picture_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/pose_stills.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

TEST(Pose, OfASquareStillIsRight) {
  const TemporaryFolder folder;

  const ProgramRun run =
      pose(folder, {kSquare + "still-0-0.png", "--start", first_line(kSquare + "start.txt"),
                    "--csv", "p.csv", "--covariance", "v.csv", "--overlay", "o.png"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("under tube (7, 41): offset 0.36"), std::string::npos) << run.out;
  expect_right(folder.path("p.csv"), kSquare, 0.010, 0.010, 0.010);
  const Row row(folder.path("p.csv"), 0);
  EXPECT_EQ(row.text("image"), kSquare + "still-0-0.png");
  EXPECT_GT(row.number("tubes"), 50);
  // The covariance's diagonal is the square of the sigmas.
  const Row covariance(folder.path("v.csv"), 0);
  EXPECT_NEAR(std::sqrt(covariance.number("x_x_mm2")), row.number("sigma_x_mm"), 6e-5);
  EXPECT_NEAR(std::sqrt(covariance.number("z_z_mm2")), row.number("sigma_z_mm"), 6e-5);
  drivers::GreyPicture overlay;
  std::string message;
  ASSERT_TRUE(drivers::read_grey_picture(folder.path("o.png"), overlay, message).has_value());
  EXPECT_EQ(overlay.width_px, 635);
}

TEST(Pose, OfATriangularStillWithUnlistedPlugsIsRight) {
  const TemporaryFolder folder;
  const std::string still = kStills + "triangular/";

  const ProgramRun run = run_tubesight(
      folder, {"pose", still + "session.toml", still + "still-0-0.png", "--csv", "p.csv"});

  EXPECT_EQ(run.status, 0) << run.err;
  expect_right(folder.path("p.csv"), still, 0.012, 0.012, 0.012);
}

TEST(Pose, OnlyOfTheTubesNamedUsesNoOthers) {
  const TemporaryFolder folder;

  const ProgramRun run =
      pose(folder, {kSquare + "still-0-0.png", "--start", first_line(kSquare + "start9.txt"),
                    "--only-start", "--csv", "p.csv"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Row(folder.path("p.csv"), 0).text("tubes"), "9");
  expect_right(folder.path("p.csv"), kSquare, 0.05, 0.05, 0.05);
}

TEST(Pose, WithoutAToolLeavesTheToolsCellsEmpty) {
  const TemporaryFolder folder;
  std::string session = text_of(kSquare + "session.toml");
  const std::size_t tool = session.find("[tool]");
  session.erase(tool, session.find("[tubesheet]") - tool);
  folder.write("s.toml", session);

  const ProgramRun run = run_tubesight(
      folder, {"pose", "s.toml", kSquare + "still-0-0.png", "--start", kThree, "--csv", "p.csv"});

  EXPECT_EQ(run.status, 0) << run.err;
  const Row row(folder.path("p.csv"), 0);
  for (const char* name :
       {"tool_x_mm", "tool_gamma_deg", "sigma_x_mm", "row", "offset_mm", "sigma_gamma_deg"}) {
    EXPECT_EQ(row.text(name), "") << name;
  }
  // T_camera_sheet of truth: its origin is the sensor plane there, EFL = 5.06 mm behind ours.
  EXPECT_NEAR(row.number("camera_x_mm"), -871.8762, 0.02);
  EXPECT_NEAR(row.number("camera_z_mm"), 585.98093 - 5.06, 0.05);
}

TEST(Pose, CorrectionTellsTheMoveInTheToolsOwnAxes) {
  const TemporaryFolder folder;

  const ProgramRun run = pose(folder, {kSquare + "still-0-0.png", "--start", kThree, "--correct",
                                       "7,41", "--limit-mm", "0.5"});

  // 0.2 mm and 0.3 mm off in the sheet, the tool turned by 45 degrees: -0.5/sqrt 2, -0.1/sqrt 2.
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("to tube (7, 41): move the tool by x -0.35"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("meets the limit of 0.500 mm"), std::string::npos) << run.out;
}

TEST(Pose, TotalNeedsTheCalibrationsUncertaintiesAndAddsThem) {
  const TemporaryFolder folder;
  folder.write("s.toml", text_of(kSquare + "session.toml") +
                             "\n[tool_quality]\nid = \"t\"\n"
                             "sigma = [0.03, 0.04, 0.05, 0.0, 0.0, 0.0]\n");
  const std::vector<std::string> arguments = {
      kSquare + "still-0-0.png", "--start", kThree, "--total", "--csv", "p.csv"};

  const ProgramRun without = pose(folder, arguments);
  std::vector<std::string> all = {"pose", "s.toml"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const ProgramRun with = run_tubesight(folder, all);

  EXPECT_EQ(without.status, 2);
  EXPECT_EQ(with.status, 0) << with.err;
  const Row row(folder.path("p.csv"), 0);
  const double squares = std::pow(row.number("sigma_x_mm"), 2) +
                         std::pow(row.number("sigma_y_mm"), 2) +
                         std::pow(row.number("sigma_z_mm"), 2);
  EXPECT_NEAR(std::sqrt(squares), std::sqrt(0.03 * 0.03 + 0.04 * 0.04 + 0.05 * 0.05), 0.001);
}

/// A recording of the same frame twice.
std::string two_frames(const drivers::GreyPicture& still) {
  const std::string frame = "FRAME\n" + std::string(still.pixels.begin(), still.pixels.end());
  return "YUV4MPEG2 W635 H480 F30:1 It Cmono\n" + frame + frame;
}

TEST(Pose, OfARecordingTakesItsFramesAsPictures) {
  const TemporaryFolder folder;
  drivers::GreyPicture still;
  std::string message;
  ASSERT_TRUE(drivers::read_grey_picture(kSquare + "still-0-0.png", still, message).has_value());
  folder.write("two.y4m", two_frames(still));

  const ProgramRun each =
      pose(folder, {"two.y4m", "--frames", "0-1", "--start", kThree, "--csv", "each.csv"});
  const ProgramRun first = pose(folder, {"two.y4m", "--start", kThree, "--csv", "first.csv"});
  const ProgramRun mean = pose(
      folder, {"two.y4m", "--frames", "0-1", "--average", "--start", kThree, "--csv", "mean.csv"});

  EXPECT_EQ(each.status, 0) << each.err;
  EXPECT_EQ(Row(folder.path("each.csv"), 0).text("image"), "two.y4m frame 0");
  EXPECT_EQ(Row(folder.path("each.csv"), 1).text("image"), "two.y4m frame 1");
  expect_right(folder.path("each.csv"), kSquare, 0.010, 0.010, 0.010);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out.find("frame 1"), std::string::npos) << first.out;
  EXPECT_NE(mean.out.find("two.y4m frame 0: average of 2 pictures"), std::string::npos) << mean.out;
}

struct Refusal {
  const char* name;
  std::vector<std::string> arguments;  ///< behind the session
  int status;
  const char* message;  ///< a part of the one line
};

class PoseRefusals : public ::testing::TestWithParam<Refusal> {
 protected:
  /// Pictures made from the still: flat, moved as a whole, fields moved apart, of another size.
  void SetUp() override {
    drivers::GreyPicture still;
    std::string message;
    ASSERT_TRUE(drivers::read_grey_picture(kSquare + "still-0-0.png", still, message).has_value());
    const auto width = static_cast<std::size_t>(still.width_px);
    std::string flat(still.pixels.size(), '\x60');
    std::string moved = flat;
    std::string torn(still.pixels.begin(), still.pixels.end());
    for (std::size_t i = 0; i < still.pixels.size(); ++i) {
      moved[i] = static_cast<char>(still.pixels[i >= 5 ? i - 5 : i]);
      if (i / width % 2 == 1 && i >= 5) {
        torn[i] = static_cast<char>(still.pixels[i - 5]);
      }
    }
    const std::string header = "P5\n635 480\n255\n";
    folder_.write("flat.pgm", header + flat);
    folder_.write("moved.pgm", header + moved);
    folder_.write("torn.pgm", header + torn);
    folder_.write("two.y4m", two_frames(still));
    folder_.write("small.pgm", "P5\n320 240\n255\n" + std::string(320 * 240, '\x60'));
  }

  TemporaryFolder folder_;
};

TEST_P(PoseRefusals, AreOneLineWithTheReasonAndLeaveNothing) {
  const auto before = folder_.names().size();
  std::vector<std::string> arguments;
  for (const std::string& argument : GetParam().arguments) {
    arguments.push_back(argument == "STILL" ? kSquare + "still-0-0.png" : argument);
  }
  arguments.insert(arguments.end(), {"--csv", "p.csv", "--covariance", "v.csv"});

  const ProgramRun run = pose(folder_, arguments);

  EXPECT_EQ(run.status, GetParam().status);
  EXPECT_NE(run.err.find(GetParam().message), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << "more than one line: " << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder_.names().size(), before);
}

std::vector<std::string> more_than_32() {
  std::vector<std::string> arguments(33, "STILL");
  arguments.insert(arguments.end(), {"--average", "--start", kThree});
  return arguments;
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, PoseRefusals,
    ::testing::Values(
        Refusal{"TooFewTubes",
                {"STILL", "--only-start", "--start", "7,41,304,240;7,42,373,192"},
                2,
                "--only-start: 2 tube-ends are named, expected three at least"},
        Refusal{"Collinear",
                {"STILL", "--only-start", "--start", "7,41,309,234;7,42,390,197;7,40,260,286"},
                1,
                "no pose: the tube-ends lie in one line, which leaves the tilt open"},
        Refusal{"OnTheSheet",
                {"STILL", "--start", "7,41,304,240;7,42,345,165;6,42,310,129"},
                1,
                "no pose: the place of tube (7, 42) at "},
        Refusal{"SameTubeTwice",
                {"STILL", "--start", "7,41,304,240;7,42,310,240;6,42,310,129"},
                1,
                "is in the tube-end that another place names"},
        Refusal{"Addresses",
                {"STILL", "--start", "7,42,304,240;7,41,373,192;6,42,310,129"},
                1,
                "no pose: "},
        Refusal{"NoTubes", {"flat.pgm", "--start", kThree}, 1, "flat.pgm: no pose: "},
        Refusal{"MovedBetween",
                {"STILL", "moved.pgm", "--average", "--start", kThree},
                1,
                "the camera moved: the picture shifts by"},
        Refusal{"MovedBetweenFields",
                {"torn.pgm", "--start", kThree},
                1,
                "between the two fields of a frame, expected a camera at rest"},
        Refusal{"NoPicture", {"none.png", "--start", kThree}, 2, "none.png: cannot be read: "},
        Refusal{"AnotherSize",
                {"small.pgm", "--start", kThree},
                2,
                "small.pgm: 320 x 240 pixels, expected 635 x 480 as [camera] of the settings says"},
        Refusal{"FrameBehindTheEnd",
                {"two.y4m", "--frames", "1-2", "--start", kThree},
                2,
                "two.y4m: has no frame 2, expected --frames within its 2, counted from 0"},
        Refusal{"FramesNotInOrder",
                {"two.y4m", "--frames", "1-0", "--start", kThree},
                2,
                "--frames: '1-0', expected A-B or A: frames of a recording, counted from 0 to "
                "99999, A not "
                "behind B"},
        Refusal{"FramesEmpty",
                {"two.y4m", "--frames", "", "--start", kThree},
                2,
                "--frames: names no frame, expected A-B or A"},
        Refusal{"FramesOfAPicture",
                {"STILL", "--frames", "1", "--start", kThree},
                2,
                "--frames: no recording is given, expected a file that ends in .y4m, .y4m.xz, .mp4 "
                "or as "
                "another video"},
        Refusal{"NoRecording", {"none.y4m", "--start", kThree}, 2, "none.y4m: cannot be read: "},
        Refusal{"StartNoNumbers",
                {"STILL", "--start", "7,41,304;7,42,373,192"},
                2,
                "--start: '7,41,304', expected R,C,U,V;R,C,U,V"},
        Refusal{"StartEmpty",
                {"STILL", "--start", ""},
                2,
                "--start: names no tube-end, expected R,C,U,V;R,C,U,V;..."},
        Refusal{"MoreThan32", more_than_32(), 2,
                "more than 32 pictures, expected at most that many with --average"},
        Refusal{"StartOutside",
                {"STILL", "--start", "7,41,904,240;7,42,373,192;6,42,310,129"},
                2,
                "--start: tube (7, 41) is at "},
        Refusal{"StartNoTube",
                {"STILL", "--start", "7,941,304,240;7,42,373,192;6,42,310,129"},
                2,
                "--start: tube (7, 941) is outside the tubesheet"},
        Refusal{"NamedTwice",
                {"STILL", "--start", "7,41,304,240;7,41,373,192;6,42,310,129"},
                2,
                "--start: tube (7, 41) is named twice, expected different tubes"},
        Refusal{"CorrectNoAddress",
                {"STILL", "--start", kThree, "--correct", "7"},
                2,
                "--correct: '7', expected ROW,COLUMN of a tube that stands"},
        Refusal{"OverlayOfTwo",
                {"STILL", "STILL", "--start", kThree, "--overlay", "o.png"},
                2,
                "--overlay: one picture for 2 poses, expected one still or --average"},
        Refusal{"OutputIsInput",
                {"torn.pgm", "--start", kThree, "--overlay", "torn.pgm"},
                2,
                "--overlay: 'torn.pgm' is also a picture, expected a place of its own"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Pose, OfSeveralStillsKeepsTheRowOfARefusedOne) {
  const TemporaryFolder folder;
  folder.write("flat.pgm", "P5\n635 480\n255\n" + std::string(635 * 480, '\x60'));

  const ProgramRun run =
      pose(folder, {"flat.pgm", kSquare + "still-0-0.png", "--start", kThree, "--csv", "p.csv"});

  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("flat.pgm: no pose: "), std::string::npos);
  const Row refused(folder.path("p.csv"), 0);
  EXPECT_EQ(refused.text("image"), "flat.pgm");
  EXPECT_EQ(refused.text("tool_x_mm"), "");
  EXPECT_EQ(refused.text("tubes"), "");
  EXPECT_NEAR(Row(folder.path("p.csv"), 1).number("tool_x_mm"), 1041.6, 0.01);
}

TEST(Pose, WithoutAStartAnywhereNamesNoTube) {
  const TemporaryFolder folder;
  std::string session = text_of(kSquare + "session.toml");
  const std::size_t start = session.find("[start]");
  session.erase(start, session.find("[verification]") - start);
  folder.write("s.toml", session);

  const ProgramRun run =
      run_tubesight(folder, {"pose", "s.toml", kSquare + "still-0-0.png", "--csv", "p.csv"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Row(folder.path("p.csv"), 0).text("row"), "");
  EXPECT_EQ(Row(folder.path("p.csv"), 0).text("column"), "");
}

}  // namespace
}  // namespace tubesight::tests
