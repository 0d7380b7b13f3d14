// Cameras of other sizes through the program as a user starts it: drawn, tracked, marked, measured.

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"
#include "tests/system/scenario_text.h"

namespace tubesight::tests {
namespace {

using support::replaced;
using support::TemporaryFolder;

struct Camera {
  std::int32_t width_px;
  std::int32_t height_px;
  const char* scan;
  const char* rate_hz;
  const char* rest_s;              ///< of six fields
  std::int32_t overlay_height_px;  ///< with the readout below
};

std::ostream& operator<<(std::ostream& out, const Camera& camera) {
  return out << camera.width_px << " x " << camera.height_px << " " << camera.scan;
}

/// The small scenario, sound, through the same lens with other columns and lines.
std::string scenario_of(const Camera& camera) {
  const double columns = camera.width_px / 635.0;
  const double lines = camera.height_px / 480.0;
  const auto whole = [](double value) { return std::to_string(static_cast<int>(value)); };
  std::string text = small_scenario_text();
  text = text.substr(0, text.find("[[fault]]"));
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"width_px = 635", "width_px = " + std::to_string(camera.width_px)},
           {"height_px = 480", "height_px = " + std::to_string(camera.height_px)},
           {"even-first", camera.scan},
           {"rest_s = 0.1", std::string("rest_s = ") + camera.rest_s},
           {"cell_width_mm = 0.0084", "cell_width_mm = " + std::to_string(0.0084 / columns)},
           {"cell_height_mm = 0.0098", "cell_height_mm = " + std::to_string(0.0098 / lines)},
           {"[324.3, 233.8]",
            "[" + std::to_string(324.3 * columns) + ", " + std::to_string(233.8 * lines) + "]"},
           {"[40, 36, 595, 330]", "[" + whole(40 * columns) + ", " + whole(36 * lines) + ", " +
                                      whole(595 * columns) + ", " + whole(330 * lines) + "]"}}) {
    text = replaced(text, from, to);
  }
  return text + "[video]\nrate_hz = " + camera.rate_hz + "\n";
}

/// Width and height by a PNG's header.
std::pair<std::int32_t, std::int32_t> size_of_png(const std::string& bytes) {
  const auto number = [&bytes](std::size_t at) {
    std::int32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value * 256 + static_cast<unsigned char>(bytes.at(at + i));
    }
    return value;
  };
  return {number(16), number(20)};
}

class Cameras : public testing::TestWithParam<Camera> {};

TEST_P(Cameras, AreDrawnTrackedMarkedAndMeasured) {
  const TemporaryFolder folder;
  folder.write("s.toml", scenario_of(GetParam()));
  const ProgramRun simulated = run_tubesight(folder, {"simulate", "s.toml", "--out", "r"});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const ProgramRun first = run_tubesight(
      folder, {"replay", "r.session.toml", "r.y4m", "--fields", "f.csv", "--overlay", "marks/"});
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(
      run_tubesight(folder, {"replay", "r.session.toml", "r.y4m", "--fields", "again.csv"}).status,
      0);
  const ProgramRun posed =
      run_tubesight(folder, {"pose", "r.session.toml", "r.y4m", "--csv", "p.csv"});
  ASSERT_EQ(posed.status, 0) << posed.err;

  EXPECT_EQ(folder.read("again.csv"), folder.read("f.csv"));
  const std::vector<Row> fields = read_rows(folder.read("f.csv"));
  const std::vector<Row> truth = read_rows(folder.read("r.truth.csv"));
  ASSERT_EQ(fields.size(), 6U);
  for (const Row& field : fields) {
    EXPECT_EQ(field.at("state"), "tracking");
    EXPECT_EQ(field.at("aligned"), "1");
    EXPECT_EQ(field.at("tool_row"), "40");
    EXPECT_EQ(field.at("tool_column"), "60");
  }
  EXPECT_EQ(size_of_png(folder.read("marks/field-000000.png")),
            (std::pair{GetParam().width_px, GetParam().overlay_height_px}));
  const std::vector<Row> poses = read_rows(folder.read("p.csv"));
  ASSERT_FALSE(poses.empty());
  for (const char* axis : {"x", "y", "z"}) {
    EXPECT_NEAR(number(poses[0], std::string("tool_") + axis + "_mm"),
                number(truth[0], std::string("tool_") + axis),
                GetParam().width_px < 640 ? 0.1 : 0.02)
        << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Cameras,
                         testing::Values(Camera{320, 240, "odd-first", "30", "0.1", 320},
                                         Camera{1920, 1200, "progressive", "120", "0.05", 1560}));

TEST(CameraSizes, OutsideTheRangeAreRefusedWithTheRange) {
  const TemporaryFolder folder;
  folder.write("wide.toml", scenario_of({2049, 1200, "progressive", "60", "0.1", 0}));
  folder.write("small.toml", scenario_of({63, 48, "progressive", "60", "0.1", 0}));

  const ProgramRun wide = run_tubesight(folder, {"simulate", "wide.toml", "--out", "r"});
  const ProgramRun small = run_tubesight(folder, {"simulate", "small.toml", "--out", "r"});

  EXPECT_EQ(wide.status, 2);
  EXPECT_NE(wide.err.find("expected at most 2048 in a scenario, which is drawn"), std::string::npos)
      << wide.err;
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("camera.width_px: 63, expected an integer from 64 to 4096"),
            std::string::npos)
      << small.err;
}

}  // namespace
}  // namespace tubesight::tests
