// `tubesight calibrate camera` on drawn templates and on points, and what it must refuse.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/system/calibrate_views.h"

namespace tubesight::tests {
namespace {

std::string target(const std::string& dot_mm = "4.0") {
  return "[target]\nrows = 10\ncolumns = 10\nspacing_mm = 8.0\ndot_mm = " + dot_mm +
         "\ndots = \"bright\"\n";
}

/// The template of draw_dots() without pixels: a points file.
void write_points(const TemporaryFolder& folder, const std::string& name, double away,
                  double lean = 0.005) {
  ComputedPoints points;
  points.away = away;
  points.lean = lean;
  folder.write(name, points.text());
}

TEST(CalibrateCamera, FromPicturesOfTwoHeightsIsRight) {
  const TemporaryFolder folder;
  draw_dots(folder, "near.pgm", 82.0);
  draw_dots(folder, "far.pgm", 112.0);

  const ProgramRun run =
      calibrate(folder,
                kPlainCamera + target() + view_of("images = [\"near.pgm\"]", "0.0") +
                    view_of("images = [\"far.pgm\"]", "30.0"),
                {"--out", "c.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("camera from 2 views, 200 dots\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("two heights alone do not show one that moved"), std::string::npos);
  EXPECT_NE(run.out.find("good for"), std::string::npos);
  const std::string settings = folder.read("c.toml");
  EXPECT_NEAR(number_of(settings, "focal_length_mm"), 5.0, 0.002);
  EXPECT_NEAR(number_of(settings, "horizontal_scale"), 1.0, 0.0002);
  EXPECT_NEAR(number_of(settings, "distortion_per_mm2"), 0.01, 0.0001);
  const std::size_t center = settings.find("center_px = [");
  EXPECT_NEAR(std::atof(settings.c_str() + center + 13), 319.5, 0.3);
  EXPECT_NE(settings.find("[camera_quality]\nid = \""), std::string::npos);
}

TEST(CalibrateCamera, WritesSettingsThatPoseReadsWithTheirUncertainty) {
  const TemporaryFolder folder;
  write_points(folder, "near.csv", 82.0);
  write_points(folder, "far.csv", 112.0);
  const std::string settings =
      kPlainCamera + "[camera_quality]\nserial = \"4711\"\nmodel = \"Maker Model\"\n" +
      target("0") + view_of("points = \"near.csv\"", "0") + view_of("points = \"far.csv\"", "30");
  folder.write("c.toml", "what stood here");

  const ProgramRun run = calibrate(folder, settings, {"--out", "c.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(number_of(folder.read("c.toml"), "focal_length_mm"), 5.0, 1e-4);
  EXPECT_EQ(folder.read("c.toml.bak"), "what stood here");
  EXPECT_NE(folder.read("c.toml").find("serial = \"4711\"\nmodel = \"Maker Model\"\n"),
            std::string::npos)
      << "which camera it is";
  folder.write(
      "s.toml",
      "include = [\"c.toml\"]\n[tool]\nposition_mm = [0, 30, 110]\nrotation_deg = [0, 0, 48]\n"
      "[tubesheet]\nrow_step_mm = [0.0, 25.4]\ncolumn_step_mm = [25.4, 0.0]\nbore_mm = 18.6\n"
      "rows = [0, 9]\ncolumns = [0, 9]\n");
  const ProgramRun pose = run_tubesight(
      folder, {"pose", "s.toml", "absent.png", "--total", "--start", "1,1,5,5;1,2,50,5;2,1,5,50"});
  // The settings are good, --total finds its sigmas, and the picture is what is missing.
  EXPECT_EQ(pose.err, "absent.png: cannot be read: No such file or directory\n");
}

TEST(CalibrateCamera, RefusesWhatLeavesTheCameraOpenAndWritesNothing) {
  const TemporaryFolder folder;
  write_points(folder, "near.csv", 82.0);
  write_points(folder, "far.csv", 112.0);
  const auto expect_refused = [&](const std::string& views, const std::string& message) {
    const ProgramRun run =
        calibrate(folder, kPlainCamera + target("0") + views, {"--out", "c.toml"});
    EXPECT_EQ(run.status, 1) << message;
    EXPECT_NE(run.err.find("t.toml: no calibration: " + message), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("c.toml")));
  };
  const std::string near = "points = \"near.csv\"";
  const std::string far = "points = \"far.csv\"";

  expect_refused(view_of(near, "0"), "one view leaves EFL and distance open");
  expect_refused(view_of(near, "5") + view_of(far, "5"), "all height_mm are equal");
  expect_refused(view_of(near, "30") + view_of(far, "0"), "EFL or a distance comes out negative");
  write_points(folder, "flat.csv", 82.0, 0.0);
  write_points(folder, "flat_far.csv", 112.0, 0.0);
  expect_refused(view_of("points = \"flat.csv\"") + view_of("points = \"flat_far.csv\""),
                 "the views don't determine the camera");
}

TEST(CalibrateCamera, SaysWhichPictureShowsNoSuchTemplate) {
  const TemporaryFolder folder;
  draw_dots(folder, "near.pgm", 82.0);
  folder.write("grey.pgm", "P5\n640 480\n255\n" + std::string(640UL * 480UL, '\x60'));
  folder.write("small.pgm", "P5\n64 48\n255\n" + std::string(64UL * 48UL, '\x60'));
  const auto expect = [&](const std::string& settings, int status, const std::string& message) {
    const ProgramRun run = calibrate(folder, kPlainCamera + settings);
    EXPECT_EQ(run.status, status) << message;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
  };
  const std::string near = view_of("images = [\"near.pgm\"]", "0");
  std::string nine = target();
  nine.replace(nine.find("rows = 10"), 9, "rows = 9");
  std::string dark = target();
  dark.replace(dark.find("bright"), 6, "dark");

  expect(target() + view_of("images = [\"grey.pgm\"]", "0"), 1,
         "grey.pgm: no template: no lattice of dots is found");
  expect(nine + near, 1,
         "near.pgm: no template: 100 dots in 10 rows and 10 columns, expected 9 lines of 10");
  expect(dark + near, 1, "near.pgm: no template: bright dots on dark");
  expect(target("2.0") + near, 1, "near.pgm: no template: dots that stand 1.9");
  expect(target() + view_of("images = [\"small.pgm\"]", "0"), 2, "small.pgm: 64 x 48 pixels");
  expect(target() + view_of("images = [\"near.pgm\", \"absent.pgm\"]", "0"), 2,
         "absent.pgm: cannot be read");
}

TEST(CalibrateCamera, SaysWhatIsWrongWithItsFiles) {
  const TemporaryFolder folder;
  folder.write("bad.csv", "x_mm,y_mm,u_px,v_px\n1,2,3,4\n1,2,x,4\n");
  folder.write("few.csv", "x_mm,y_mm,u_px,v_px\n1,2,3,4\n");
  folder.write("head.csv", "x,y,u,v\n1,2,3,4\n");
  const auto expect = [&](const std::string& settings, const std::string& message) {
    const ProgramRun run = calibrate(folder, settings, {"--out", "c.toml"});
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  };
  const std::string start = kPlainCamera + target("0");

  expect(start + view_of("points = \"bad.csv\""),
         "bad.csv:3: 'x', expected a number with up to 9 decimals");
  expect(start + view_of("points = \"few.csv\""), "few.csv: 1 points, expected at least 12");
  expect(start + view_of("points = \"head.csv\""), "head.csv:1: ");
  expect(start + view_of("points = \"absent.csv\""),
         "absent.csv: cannot be read: No such file or directory");
  expect(start, "view: the tables are missing, expected a [[view]]");
  expect(kPlainCamera + view_of("points = \"bad.csv\""), "target: the table is missing");
  expect(target() + view_of("points = \"bad.csv\""), "camera: the table is missing");
  const ProgramRun clash =
      calibrate(folder, start + view_of("points = \"bad.csv\""), {"--out", "bad.csv"});
  EXPECT_NE(clash.err.find("--out: 'bad.csv' is also a points file"), std::string::npos);
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "lens", "t.toml"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path("c.toml")));
}

TEST(CalibrateCamera, SaysThatTheDiskIsFull) {
  const TemporaryFolder folder;
  write_points(folder, "near.csv", 82.0);
  write_points(folder, "far.csv", 112.0);

  const ProgramRun run =
      calibrate(folder,
                kPlainCamera + target("0") + view_of("points = \"near.csv\"", "0") +
                    view_of("points = \"far.csv\"", "30"),
                {"--out", "/dev/full"});

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "/dev/full: cannot be written: No space left on device\n");
}

}  // namespace
}  // namespace tubesight::tests
