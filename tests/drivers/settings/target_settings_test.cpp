#include "drivers/settings/target_settings.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/settings/settings_files.h"

namespace tubesight::drivers {
namespace {

const std::string kTarget =
    "[target]\nrows = 24\ncolumns = 14\nlattice = \"staggered\"\nspacing_mm = 1.2\n"
    "row_spacing_mm = 1.0392\ndot_mm = 1.0\ndots = \"dark\"\n";
const std::string kViews =
    "[[view]]\nimages = [\"near-0.png\", \"near-1.png\"]\nheight_mm = 0.0\n"
    "[[view]]\npoints = \"far.csv\"\n";

class CalibrationTarget : public testing::Test {
 protected:
  Messages load(const std::string& text) {
    MemoryFiles files;
    files.texts["folder/t.toml"] = text;
    Messages messages;
    const auto outcome = load_target(files, "folder/t.toml", file_, messages);
    EXPECT_EQ(outcome.has_value(), messages.empty());
    return messages;
  }
  void expect_wrong(const std::string& text, const std::string& message) {
    const Messages messages = load(text);
    ASSERT_EQ(messages.size(), 1U) << message;
    EXPECT_EQ(messages[0], message);
  }

  TargetFile file_;
};

TEST_F(CalibrationTarget, MaySayWhichCameraItIsAsACalibrationDoes) {
  ASSERT_EQ(load(kCameraTable + "[camera_quality]\nid = \"c1\"\nmade_at = \"then\"\n" +
                 "serial = \"4711\"\nmodel = \"Maker Model\"\nsigma = [1.0]\n" + kTarget + kViews),
            Messages{});
  EXPECT_EQ(file_.device.serial, "4711");
  EXPECT_EQ(file_.device.model, "Maker Model");
}

TEST_F(CalibrationTarget, IsWrittenWithPointsAsItReadsBack) {
  ASSERT_EQ(load(kCameraTable + "[camera_quality]\nserial = \"4711\"\nmodel = \"Maker Model\"\n" +
                 kTarget + "lens_mm = 5.2\n" + kViews),
            Messages{});
  const TargetFile written = file_;

  ASSERT_EQ(load(target_text(written, {"view-0.csv", "view-1.csv"})), Messages{});

  EXPECT_EQ(file_.camera.width_px, 635);
  EXPECT_EQ(file_.camera.cell_height_mm, written.camera.cell_height_mm);
  EXPECT_EQ(file_.camera.scan, written.camera.scan);
  EXPECT_EQ(file_.camera.frame_columns, 635);
  EXPECT_EQ(file_.device.serial, "4711");
  EXPECT_EQ(file_.device.model, "Maker Model");
  EXPECT_EQ(file_.target.lattice, DotLattice::kStaggered);
  EXPECT_EQ(file_.target.row_spacing_mm, 1.0392);
  EXPECT_EQ(file_.target.lens_mm, 5.2);
  EXPECT_FALSE(file_.target.bright);
  ASSERT_EQ(file_.views.size(), 2U);
  EXPECT_EQ(file_.views[0].points, "folder/view-0.csv");
  EXPECT_TRUE(file_.views[0].staged);
  EXPECT_FALSE(file_.views[1].staged);
}

TEST_F(CalibrationTarget, IsReadWithItsViewsFromBesideIt) {
  ASSERT_EQ(load(kCameraTable + kTarget + kViews), Messages{});

  EXPECT_EQ(file_.camera.width_px, 635);
  EXPECT_EQ(file_.camera.sensor_columns, 768);
  EXPECT_EQ(file_.camera.focal_length_mm, 0.0);  // what is to be calibrated is not taken over
  EXPECT_EQ(file_.target.rows, 24);
  EXPECT_EQ(file_.target.columns, 14);
  EXPECT_EQ(file_.target.lattice, DotLattice::kStaggered);
  EXPECT_EQ(file_.target.spacing_mm, 1.2);
  EXPECT_EQ(file_.target.row_spacing_mm, 1.0392);
  EXPECT_EQ(file_.target.dot_mm, 1.0);
  EXPECT_FALSE(file_.target.bright);
  ASSERT_EQ(file_.views.size(), 2U);
  EXPECT_EQ(file_.views[0].images,
            (std::vector<std::string>{"folder/near-0.png", "folder/near-1.png"}));
  EXPECT_TRUE(file_.views[0].staged);
  EXPECT_EQ(file_.views[0].height_mm, 0.0);
  EXPECT_EQ(file_.views[1].points, "folder/far.csv");
  EXPECT_EQ(file_.device.serial, "") << "it is not known";
  EXPECT_FALSE(file_.views[1].staged);
}

TEST_F(CalibrationTarget, HasDefaults) {
  ASSERT_EQ(load(kCameraTable + "[target]\nrows = 10\ncolumns = 8\nspacing_mm = 8\ndot_mm = 4\n" +
                 kViews),
            Messages{});

  EXPECT_EQ(file_.target.lattice, DotLattice::kSquare);
  EXPECT_EQ(file_.target.row_spacing_mm, 8.0);
  EXPECT_TRUE(file_.target.bright);
}

TEST_F(CalibrationTarget, SaysWhatIsWrong) {
  expect_wrong(kCameraTable + kTarget + "[[view]]\nheight_mm = 1\n",
               "folder/t.toml:21: view[0].points: missing, expected images = [\"...\"] or points = "
               "\"...\"");
  expect_wrong(kCameraTable + kTarget + "[[view]]\nimages = [\"a.png\"]\npoints = \"b.csv\"\n",
               "folder/t.toml:22: view[0].images: beside points, expected one of the two");
  expect_wrong(kCameraTable + kTarget + "[[view]]\nimages = []\n",
               "folder/t.toml:22: view[0].images: an empty list, expected pictures");
  expect_wrong(kCameraTable + kTarget + "[[view]]\nimages = [1]\n",
               "folder/t.toml:22: view[0].images[0]: not a file's name, expected \"near-0.png\"");
  expect_wrong(
      kCameraTable + "[target]\nrows = 10\ncolumns = 8\nspacing_mm = 8\ndot_mm = 8\n" + kViews,
      "folder/t.toml:17: target.dot_mm: 8.0, expected less than the 8.0 mm of spacing_mm");
  expect_wrong(
      kCameraTable + "[target]\nrows = 1\ncolumns = 8\nspacing_mm = 8\ndot_mm = 4\n" + kViews,
      "folder/t.toml:14: target.rows: 1, expected an integer from 2 to 64");
}

}  // namespace
}  // namespace tubesight::drivers
