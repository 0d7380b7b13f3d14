// The program on the recording that comes with the project: results to the byte on every machine,
// and right against the truth.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

const std::string kFolder = std::string(TUBESIGHT_TEST_DATA_DIR) + "/recordings/square_flush/";

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// The first line in which two texts differ, for a failure that can be read; empty when they agree.
std::string first_difference(const std::string& expected, const std::string& actual) {
  std::istringstream a(expected);
  std::istringstream b(actual);
  std::string line_a;
  std::string line_b;
  for (int number = 1;; ++number) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) {
      return expected == actual ? std::string() : std::string("the ends differ");
    }
    if (more_a != more_b || line_a != line_b) {
      return "line " + std::to_string(number) + ": expected '" + (more_a ? line_a : "(end)") +
             "', got '" + (more_b ? line_b : "(end)") + "'";
    }
  }
}

struct Results {
  std::string fields;
  std::string centers;
};

Results replay(const std::string& scalar) {
  const support::TemporaryFolder folder;
  const ProgramRun run = run_tubesight(
      folder, {"replay", kFolder + "session.toml", kFolder + "recording.y4m.xz", "--fields",
               "fields.csv", "--centers", "centers.csv", "--scalar", scalar});
  EXPECT_EQ(run.status, 0) << run.err;
  return {read_file(folder.path("fields.csv")), read_file(folder.path("centers.csv"))};
}

TEST(ShippedRecording, GivesTheSameBytesOnEveryMachine) {
  const Results results = replay("fixed");

  // These files were written on x86-64. After an intended change of results:
  //   tubesight replay session.toml recording.y4m.xz --fields expected_fields.csv
  //   --centers expected_centers.csv
  EXPECT_EQ(first_difference(read_file(kFolder + "expected_fields.csv"), results.fields), "");
  EXPECT_EQ(first_difference(read_file(kFolder + "expected_centers.csv"), results.centers), "");
}

TEST(ShippedRecording, ComparisonNoticesOneChangedDigit) {
  const std::string expected = read_file(kFolder + "expected_centers.csv");
  std::string damaged = expected;
  damaged[damaged.size() - 2] = damaged[damaged.size() - 2] == '5' ? '6' : '5';

  EXPECT_NE(first_difference(expected, damaged), "");
  EXPECT_NE(first_difference(expected, expected + "\n"), "");
}

class ShippedRecordingIn : public testing::TestWithParam<std::string> {};

// The figures for good light, against the truth of the ray tracer.
TEST_P(ShippedRecordingIn, IsRightInEveryField) {
  const std::vector<Row> rows = read_rows(replay(GetParam()).fields);
  const std::vector<Row> truth = read_rows(read_file(kFolder + "truth.csv"));

  ASSERT_EQ(rows.size(), truth.size());
  ASSERT_EQ(rows.size(), 52U);
  double offset_squares = 0.0;
  double height_squares = 0.0;
  int named = 0;
  int changes = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    EXPECT_EQ(row.at("state"), "tracking") << i;
    const double true_offset = number(truth[i], "offset_mm");
    if (std::abs(true_offset - 2.5) > 0.05) {  // the gate's own limit is as sharp as the offset
      EXPECT_EQ(row.at("aligned"), true_offset < 2.5 ? "1" : "0") << i;
    }
    height_squares += std::pow(number(row, "tool_height_mm") + number(truth[i], "tool_z"), 2);
    changes += i > 0 && truth[i].at("near_col") != truth[i - 1].at("near_col") ? 1 : 0;
    if (row.at("tool_row").empty()) {
      EXPECT_GT(true_offset, 12.7 - 1.5) << i;
      continue;
    }
    ++named;
    if (true_offset < 12.7 - 0.05) {
      EXPECT_EQ(row.at("tool_row"), truth[i].at("near_row")) << i;
      EXPECT_EQ(row.at("tool_column"), truth[i].at("near_col")) << i;
      offset_squares += std::pow(number(row, "tool_offset_mm") - true_offset, 2);
    }
  }
  EXPECT_EQ(changes, 3);  // the move crosses three limits between tubes
  EXPECT_GE(named, 46);
  EXPECT_LT(std::sqrt(offset_squares / named), 0.08);
  EXPECT_LT(std::sqrt(height_squares / static_cast<double>(rows.size())), 0.15);
}

TEST_P(ShippedRecordingIn, MeasuresTheCentresOfTubeEndsAndMissesNone) {
  const std::vector<Row> rows = read_rows(replay(GetParam()).centers);
  const std::vector<Row> truth = read_rows(read_file(kFolder + "centers.csv"));

  std::map<std::string, Row> measured;
  for (const Row& row : rows) {
    measured[row.at("field") + "/" + row.at("row") + "/" + row.at("column")] = row;
  }
  double squares = 0.0;
  int compared = 0;
  for (const Row& t : truth) {
    const double u = number(t, "x_f");
    const double v = number(t, "y_f");
    const double w = number(t, "half_w");
    const double h = number(t, "half_h");
    // The window of the session; what lies wholly in it and unhidden must be measured.
    if (u - w < 40 || u + w > 595 || v - h < 36 || v + h > 330 || h < 8 ||
        number(t, "occluded") > 0) {
      continue;
    }
    const int field = 2 * std::atoi(t.at("frame").c_str()) + std::atoi(t.at("field").c_str());
    const auto found = measured.find(std::to_string(field) + "/" + t.at("row") + "/" + t.at("col"));
    ASSERT_NE(found, measured.end()) << field << ": " << t.at("row") << ", " << t.at("col");
    EXPECT_GT(number(found->second, "quality"), 0.0);
    squares += std::pow(number(found->second, "u_px") - u, 2) +
               std::pow(number(found->second, "v_px") - v, 2);
    ++compared;
  }
  EXPECT_GT(compared, 100);
  EXPECT_LT(std::sqrt(squares / compared), 0.13);
}

INSTANTIATE_TEST_SUITE_P(Scalars, ShippedRecordingIn, testing::Values("fixed", "float", "double"));

}  // namespace
}  // namespace tubesight::tests
