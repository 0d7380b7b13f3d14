// `tubesight calibrate camera` between pictures and points, on what it must tell or refuse of a
// template, and for a type of camera.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/system/calibrate_views.h"

namespace tubesight::tests {
namespace {

/// A plain camera that is known by its number, and 10 by 10 points 8 mm apart.
std::string target_of(const std::string& more, double dot_mm = 0.0) {
  return kPlainCamera +
         "[camera_quality]\nserial = \"4711\"\nmodel = \"Maker Model\"\n"
         "[target]\nrows = 10\ncolumns = 10\nspacing_mm = 8.0\ndot_mm = " +
         std::to_string(dot_mm) + "\n" + more;
}

double focal_of(const TemporaryFolder& folder, const std::string& name) {
  return number_of(folder.read(name), "focal_length_mm");
}

TEST(CalibratePoints, WrittenFromPicturesGiveTheSameCamera) {
  const TemporaryFolder folder;
  draw_dots(folder, "near.pgm", 82.0);
  draw_dots(folder, "far.pgm", 112.0);
  const ProgramRun pictures =
      calibrate(folder,
                target_of("dots = \"bright\"\n" + view_of("images = [\"near.pgm\"]", "0.0") +
                              view_of("images = [\"far.pgm\"]", "30.0"),
                          4.0),
                {"--out", "a.toml", "--write-points", "points"});
  ASSERT_EQ(pictures.status, 0) << pictures.err;

  const ProgramRun points =
      run_tubesight(folder, {"calibrate", "camera", "points/target.toml", "--out", "b.toml"});

  ASSERT_EQ(points.status, 0) << points.err;
  EXPECT_NEAR(focal_of(folder, "b.toml"), focal_of(folder, "a.toml"), 1e-6);
  EXPECT_EQ(folder.read("points/view-0.csv").substr(0, 20), "x_mm,y_mm,u_px,v_px\n");
  EXPECT_NE(folder.read("b.toml").find("serial = \"4711\""), std::string::npos);
}

TEST(CalibratePoints, OutOfAPlaneTellAllInOneView) {
  const TemporaryFolder folder;
  ComputedPoints points;
  points.depth = 10.0;
  folder.write("p.csv", points.text());

  const ProgramRun run = calibrate(folder, target_of(view_of("points = \"p.csv\"")),
                                   {"--out", "c.toml", "--write-points", "again"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("camera from 1 view, 100 dots\n"), std::string::npos) << run.out;
  EXPECT_NEAR(focal_of(folder, "c.toml"), 5.0, 1e-3);
  EXPECT_EQ(folder.read("again/view-0.csv"), points.text());
}

TEST(CalibratePoints, ThatAreWrongAreNamedByTheirLine) {
  const TemporaryFolder folder;
  folder.write("deep.csv", "x_mm,y_mm,z_mm,u_px,v_px\n1,2,0,3,4\n1,2,x,3,4\n");
  const ProgramRun run = calibrate(folder, target_of(view_of("points = \"deep.csv\"")));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "deep.csv:3: 'x', expected a number with up to 9 decimals\n");
}

TEST(CalibratePoints, CannotBeWrittenOverWhatIsRead) {
  const TemporaryFolder folder;
  folder.write("view-0.csv", ComputedPoints().text());
  const ProgramRun run =
      calibrate(folder, target_of(view_of("points = \"view-0.csv\"")), {"--write-points", "."});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("is also a points file"), std::string::npos) << run.err;
  EXPECT_EQ(folder.read("view-0.csv"), ComputedPoints().text());
}

TEST(CalibratePoints, AreOfACameraAlone) {
  const TemporaryFolder folder;
  const ProgramRun run =
      run_tubesight(folder, {"calibrate", "base", "p.csv", "--write-points", "somewhere"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "--write-points, --residuals, --type: of a camera alone, expected calibrate camera\n");
}

TEST(CalibrateRefusals, EachWithItsReasonAndWithoutSettings) {
  const TemporaryFolder folder;
  ComputedPoints far;
  far.away = 112.0;
  ComputedPoints tilted;
  tilted.lean = 0.5;
  ComputedPoints waves;
  waves.wave = 0.1;
  ComputedPoints far_waves = waves;
  far_waves.away = 112.0;
  ComputedPoints exchanged;
  exchanged.exchanged = true;
  folder.write("near.csv", ComputedPoints().text());
  folder.write("far.csv", far.text());
  folder.write("tilted.csv", tilted.text());
  folder.write("waves.csv", waves.text());
  folder.write("far_waves.csv", far_waves.text());
  folder.write("exchanged.csv", exchanged.text());
  const auto expect_refused = [&](const std::string& views, const std::string& message,
                                  const std::string& told = "") {
    const ProgramRun run = calibrate(folder, target_of(views), {"--out", "c.toml"});
    EXPECT_EQ(run.status, 1) << message;
    EXPECT_NE(run.err.find("t.toml: no calibration: " + message), std::string::npos) << run.err;
    EXPECT_NE(run.out.find(told), std::string::npos) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder.path("c.toml"))) << message;
  };

  expect_refused(view_of("points = \"tilted.csv\""),
                 "one view leaves EFL and distance open, or centre and scale",
                 "not known            c_u, c_v, h_sx");
  expect_refused(
      view_of("points = \"waves.csv\"", "0") + view_of("points = \"far_waves.csv\"", "30"),
      "the dots' errors hang together", "they hang together");
  expect_refused("lens_mm = 5.0\n" + view_of("points = \"near.csv\"", "0") +
                     view_of("points = \"far.csv\"", "300"),
                 "EFL is not that of lens_mm", "EFL                  50.");
  expect_refused(view_of("points = \"exchanged.csv\"", "0") + view_of("points = \"far.csv\"", "30"),
                 "EFL or a distance comes out negative");
}

TEST(CalibratePoints, ThatLeaveHalfThePictureEmptySayHowWellItIsKnownThere) {
  const TemporaryFolder folder;
  ComputedPoints half;
  half.half = true;
  folder.write("near.csv", half.text());
  half.away = 112.0;
  folder.write("far.csv", half.text());

  const ProgramRun run = calibrate(folder, target_of(view_of("points = \"near.csv\"", "0") +
                                                     view_of("points = \"far.csv\"", "30")));

  EXPECT_NE(run.out.find("  without a dot        "), std::string::npos) << run.out << run.err;
  EXPECT_NE(run.out.find("the model alone tells the map there, to 0."), std::string::npos)
      << run.out;
}

TEST(CalibrateRefusals, NameThePictureOfACameraThatMoved) {
  const TemporaryFolder folder;
  draw_dots(folder, "a.pgm", 82.0);
  draw_dots(folder, "b.pgm", 82.6);
  const ProgramRun run = calibrate(
      folder,
      target_of("dots = \"bright\"\n" + view_of("images = [\"a.pgm\", \"b.pgm\"]", "0.0"), 4.0));
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("the camera moved"), std::string::npos) << run.err;
}

TEST(CalibrateRefusals, NameThePictureOfDotsThatAreSmearedOrCutOff) {
  const TemporaryFolder folder;
  draw_dots(folder, "near.pgm", 82.0);
  DrawnFaults faults;
  faults.moved_px = 6;
  draw_dots(folder, "smeared.pgm", 112.0, faults);
  faults = {};
  faults.inside = 330.0;
  draw_dots(folder, "white.pgm", 112.0, faults);
  const auto told = [&](const std::string& name) {
    const ProgramRun run =
        calibrate(folder,
                  target_of("dots = \"bright\"\n" + view_of("images = [\"near.pgm\"]", "0.0") +
                                view_of("images = [\"" + name + "\"]", "30.0"),
                            4.0),
                  {"--out", "c.toml"});
    EXPECT_EQ(run.status, 1) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder.path("c.toml"))) << name;
    return run.err;
  };

  EXPECT_TRUE(told("smeared.pgm").starts_with("smeared.pgm: the dots are smeared by "));
  EXPECT_TRUE(told("white.pgm").starts_with("white.pgm: the light is cut off: at 100 of 100 dots"));
}

TEST(CalibrateResiduals, AreWrittenADotARowAlsoOfWhatIsRefused) {
  const TemporaryFolder folder;
  ComputedPoints far;
  far.away = 112.0;
  folder.write("near.csv", ComputedPoints().text());
  folder.write("far.csv", far.text());
  const std::string views =
      view_of("points = \"near.csv\"", "0") + view_of("points = \"far.csv\"", "30");

  ASSERT_EQ(calibrate(folder, target_of(views), {"--residuals", "r.csv"}).status, 0);

  const std::string rows = folder.read("r.csv");
  EXPECT_TRUE(rows.starts_with("view,x_mm,y_mm,z_mm,u_px,v_px,du_px,dv_px,used\n0,0.0000,0.0000,"))
      << rows.substr(0, 100);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 201);
  EXPECT_NE(rows.find("\n1,72.0000,72.0000,0.0000,"), std::string::npos);

  ComputedPoints waves;
  waves.wave = 0.1;
  folder.write("near.csv", waves.text());
  ASSERT_EQ(calibrate(folder, target_of(views), {"--residuals", "bad.csv"}).status, 1);
  EXPECT_NE(folder.read("bad.csv").find(",0.0000,0.0000,0.0000,"), std::string::npos);
  const ProgramRun clash = calibrate(folder, target_of(views), {"--residuals", "near.csv"});
  EXPECT_EQ(clash.status, 2);
  EXPECT_NE(clash.err.find("--residuals: 'near.csv' is also a points file"), std::string::npos);
}

TEST(CalibrateType, IsForTrackingAndHasNoSerialNumber) {
  const TemporaryFolder folder;
  ComputedPoints far;
  far.away = 112.0;
  folder.write("near.csv", ComputedPoints().text());
  folder.write("far.csv", far.text());

  const ProgramRun run = calibrate(
      folder,
      target_of(view_of("points = \"near.csv\"", "0") + view_of("points = \"far.csv\"", "30")),
      {"--type", "--out", "type.toml"});

  ASSERT_EQ(run.status, 0) << run.err;
  const std::string settings = folder.read("type.toml");
  EXPECT_EQ(settings.find("serial"), std::string::npos);
  EXPECT_NE(settings.find("model = \"Maker Model\""), std::string::npos);
  EXPECT_NE(settings.find("verdict = \"tracking and position correction only"), std::string::npos);
  EXPECT_NE(settings.find("sigma = [0.05"), std::string::npos) << settings;
}

}  // namespace
}  // namespace tubesight::tests
