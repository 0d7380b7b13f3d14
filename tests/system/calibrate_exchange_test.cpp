// `tubesight calibrate camera` with its picture and what it says of itself; cameras exchanged with
// OpenCV and ROS.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

/// Ten lines of ten points seen by a camera of EFL 5 mm and k 0.01 per mm2, in cells of 0.01 mm.
/// Each is off by up to `off_px`, as by chance.
void write_points(const TemporaryFolder& folder, const std::string& name, double away,
                  double off_px = 0.01) {
  std::string text = "x_mm,y_mm,u_px,v_px\n";
  for (int i = 0; i < 100; ++i) {
    const double x = 8.0 * (i % 10);
    const double y = 8.0 * (i / 10);
    const double z = away + 0.005 * (y - 36.0);
    const double ideal_x = 5.0 * (x - 36.0) / z;
    const double ideal_y = 5.0 * (y - 36.0) / z;
    double factor = 1.0;
    for (int k = 0; k < 60; ++k) {
      const double r2 = (ideal_x * ideal_x + ideal_y * ideal_y) / (factor * factor);
      factor = 1.0 + 0.01 * r2;
    }
    const double u = 310.0 + 100.0 * ideal_x / factor + off_px * std::sin(37.0 * i * i + away);
    const double v = 245.0 + 100.0 * ideal_y / factor + off_px * std::cos(53.0 * i * i + away);
    text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(u) + "," +
            std::to_string(v) + "\n";
  }
  folder.write(name, text);
}

void write_target(const TemporaryFolder& folder) {
  write_points(folder, "near.csv", 82.0);
  write_points(folder, "far.csv", 112.0);
  folder.write("t.toml",
               "[camera]\nwidth_px = 640\nheight_px = 480\nscan = \"progressive\"\n"
               "cell_width_mm = 0.01\ncell_height_mm = 0.01\nsensor_columns = 640\n"
               "frame_columns = 640\n[camera_quality]\nserial = \"4711\"\n[target]\nrows = 10\n"
               "columns = 10\nspacing_mm = 8.0\ndot_mm = 0\ndots = \"bright\"\n[[view]]\n"
               "points = \"near.csv\"\nheight_mm = 0\n[[view]]\npoints = \"far.csv\"\n"
               "height_mm = 30\n");
}

double number_of(const std::string& settings, const std::string& key) {
  const std::size_t at = settings.find(key + " = ");
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? 0.0 : std::atof(settings.c_str() + at + key.size() + 3);
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
  run = run_tubesight(folder, {"calibrate", "import", "t.toml", "--picture", "x.png"});
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
