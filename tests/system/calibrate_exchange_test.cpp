// `tubesight calibrate camera` with its picture and what it says of itself; cameras exchanged with
// OpenCV and ROS.

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/system/calibrate_views.h"

namespace tubesight::tests {
namespace {

void write_target(const TemporaryFolder& folder) {
  ComputedPoints points;
  points.off_px = 0.01;
  folder.write("near.csv", points.text());
  points.away = 112.0;
  folder.write("far.csv", points.text());
  folder.write("t.toml", kPlainCamera +
                             "[camera_quality]\nserial = \"4711\"\n[target]\nrows = 10\n"
                             "columns = 10\nspacing_mm = 8.0\ndot_mm = 0\ndots = \"bright\"\n" +
                             view_of("points = \"near.csv\"", "0") +
                             view_of("points = \"far.csv\"", "30"));
}

TEST(CalibrateCamera, SaysHowFarItsHalvesAgreeAndWhatThatIsOfTheTip) {
  const TemporaryFolder folder;
  write_target(folder);

  const ProgramRun run = run_tubesight(folder, {"calibrate", "camera", "t.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  const std::size_t halves = run.out.find("  halves agree          ");
  const std::size_t tip = run.out.find("  guidetube's tip      one sigma across and along");
  const std::size_t verdict = run.out.find("  good for  ");
  EXPECT_LT(halves, tip) << run.out;
  EXPECT_LT(tip, verdict);
  EXPECT_NE(run.out.find("    90 mm below a sheet  0.0"), std::string::npos) << run.out;
}

/// One side of the template in a points file comes nearer, by a share at its edge.
void bend(const TemporaryFolder& folder, const std::string& name, double share) {
  const std::string flat = folder.read(name);
  std::string text = "x_mm,y_mm,u_px,v_px\n";
  for (std::size_t at = flat.find('\n') + 1; at < flat.size(); at = flat.find('\n', at) + 1) {
    double x = 0.0;
    double y = 0.0;
    double u = 0.0;
    double v = 0.0;
    ASSERT_EQ(std::sscanf(flat.c_str() + at, "%lf,%lf,%lf,%lf", &x, &y, &u, &v), 4);
    const double nearer = x > 36.0 ? 1.0 + share * (x - 36.0) / 36.0 : 1.0;
    text += std::to_string(x) + "," + std::to_string(y) + "," +
            std::to_string(310.0 + (u - 310.0) * nearer) + "," +
            std::to_string(245.0 + (v - 245.0) * nearer) + "\n";
  }
  folder.write(name, text);
}

TEST(CalibrateCamera, OfABentTemplateIsForTrackingAndSaysWhatWouldHelp) {
  const TemporaryFolder folder;
  write_target(folder);
  bend(folder, "near.csv", 0.0005);  // 0.04 mm

  const ProgramRun run = run_tubesight(folder, {"calibrate", "camera", "t.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("  they hang together: 0.01"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("  good for             tracking and position correction only\n"
                         "  next                 a view tilted by 30 deg, the template's "),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("    the map is known least around (639, 0): have dots there\n"),
            std::string::npos)
      << run.out;
}

TEST(CalibrateCamera, OfATemplateThatIsBentMoreIsRefusedAndWantsNoFurtherView) {
  const TemporaryFolder folder;
  write_target(folder);
  bend(folder, "near.csv", 0.004);  // 0.3 mm

  const ProgramRun run = run_tubesight(folder, {"calibrate", "camera", "t.toml"});

  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("no calibration: the dots' errors hang together"), std::string::npos);
  EXPECT_NE(run.out.find("  halves "), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("  next  "), std::string::npos) << run.out;
}

TEST(CalibrateCamera, DrawsWhatItFoundAlsoOfWhatIsRefused) {
  const TemporaryFolder folder;
  write_target(folder);

  ProgramRun run = run_tubesight(folder, {"calibrate", "camera", "t.toml", "--picture", "p.png"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.read("p.png").substr(1, 3), "PNG");

  folder.write("t.toml",
               support::replaced(folder.read("t.toml"), "height_mm = 30", "height_mm = -30"));
  run = run_tubesight(folder, {"calibrate", "camera", "t.toml", "--picture", "refused.png"});
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_EQ(folder.read("refused.png").substr(1, 3), "PNG");

  run = run_tubesight(folder, {"calibrate", "camera", "t.toml", "--picture", "near.csv"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "--picture: 'near.csv' is also a points file, expected a place of its own\n");
  folder.write("c.yaml", "image_width: 640\n");
  run = run_tubesight(folder, {"calibrate", "import", "c.yaml", "--picture", "x.png"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "--picture: of a camera, a tool, a base, zones or links, expected one of these\n");
}

TEST(CalibrateCamera, GoesToOpencvAndRosAndComesBack) {
  const TemporaryFolder folder;
  write_target(folder);
  for (const bool opencv : {false, true}) {
    std::vector<std::string> arguments = {"calibrate", "camera",   "t.toml", "--out",
                                          "c.toml",    "--export", "c.yaml"};
    if (opencv) {
      arguments.emplace_back("--opencv");
    }
    ProgramRun run = run_tubesight(folder, arguments);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("  exported             k1, k2, k3 follow this lens to 0.0"),
              std::string::npos)
        << run.out;
    EXPECT_EQ(folder.read("c.yaml").starts_with("%YAML:1.0\n---\n"), opencv);
    EXPECT_NE(folder.read("c.yaml").find("camera_name: \"4711\""), std::string::npos);

    run = run_tubesight(folder, {"calibrate", "import", "c.yaml", "--out", "back.toml"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("camera imported, 640 x 480 px: k and k2 follow its distortion to 0.0"),
              std::string::npos)
        << run.out;
    const std::string there = folder.read("c.toml");
    const std::string back = folder.read("back.toml");
    EXPECT_NEAR(number_of(back, "focal_length_mm"), number_of(there, "focal_length_mm"), 1e-9);
    EXPECT_NEAR(number_of(back, "horizontal_scale"), number_of(there, "horizontal_scale"), 1e-9);
    EXPECT_NEAR(number_of(back, "distortion_per_mm2"), number_of(there, "distortion_per_mm2"),
                2e-4);
    EXPECT_EQ(back.find("[camera_quality]"), std::string::npos) << "nothing is known of it";
  }
  const ProgramRun clash =
      run_tubesight(folder, {"calibrate", "camera", "t.toml", "--out", "x", "--export", "x"});
  EXPECT_EQ(clash.status, 2) << clash.err;
}

TEST(CalibrateImport, RefusesWhatIsNoSuchCamera) {
  const TemporaryFolder folder;
  const std::string good =
      "image_width: 640\nimage_height: 480\ndistortion_model: plumb_bob\n"
      "K: [500, 0, 320, 0, 500, 240, 0, 0, 1]\nD: [0, 0, 0, 0, 0]\n";
  const auto expect = [&](const std::string& from, const std::string& to, int status,
                          const std::string& said) {
    folder.write("c.yaml", support::replaced(good, from, to));
    const ProgramRun run =
        run_tubesight(folder, {"calibrate", "import", "c.yaml", "--out", "c.toml"});
    EXPECT_EQ(run.status, status) << said;
    EXPECT_EQ(run.err, said);
    EXPECT_FALSE(std::filesystem::exists(folder.path("c.toml")));
  };
  expect("plumb_bob", "equidistant", 2,
         "c.yaml:3: distortion_model: 'equidistant', a fisheye's, expected plumb_bob or "
         "rational_polynomial\n");
  expect("D: [0", "D: [-1", 1,
         "c.yaml: no camera: its distortion folds within the picture, expected a pixel's ray to be "
         "one\n");
  expect("0, 0, 0]\n", "0.02, 0, 0]\n", 1,
         "c.yaml: no camera: that is more than 1 px, expected a lens that k and k2 follow; "
         "calibrate it with calibrate camera\n");
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "import", "absent.yaml"}).status, 2);
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "import", "c.yaml", "--out", "c.yaml"}).status, 2);
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "import", "c.yaml", "--export", "d.yaml"}).err,
            "--export: of a camera alone, expected calibrate camera\n");
}

}  // namespace
}  // namespace tubesight::tests
