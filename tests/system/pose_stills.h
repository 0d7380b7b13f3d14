#pragma once

#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/csv_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {

using support::TemporaryFolder;

inline const std::string kStills = TUBESIGHT_TEST_DATA_DIR "/stills/";
inline const std::string kSquare = kStills + "square_flush/";
/// Places in three tube-ends of the square still.
inline const std::string kThree = "7,41,304,240;7,42,373,192;6,42,310,129";

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string first_line(const std::string& path) {
  const std::string text = text_of(path);
  return text.substr(0, text.find('\n'));
}

inline ProgramRun pose(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"pose", kSquare + "session.toml"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_tubesight(folder, all);
}

/// The cells of a row of a CSV file, by the header's names.
class Row {
 public:
  Row(const std::string& path, int number) {
    const std::string text = text_of(path);
    drivers::CsvReader csv(text, path);
    drivers::Messages messages;
    EXPECT_TRUE(csv.next(messages));
    names_ = csv.cells();
    for (int i = 0; i <= number; ++i) {
      EXPECT_TRUE(csv.next(messages));
    }
    cells_ = csv.cells();
    EXPECT_EQ(cells_.size(), names_.size());
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == name) {
        return cells_[i];
      }
    }
    ADD_FAILURE() << "no column " << name;
    return {};
  }
  [[nodiscard]] double number(const std::string& name) const { return std::stod(text(name)); }

 private:
  std::vector<std::string> names_;
  std::vector<std::string> cells_;
};

/// Expects the pose of a still within the limits of docs/accuracy.md, with room for one frame.
inline void expect_right(const std::string& csv, const std::string& still_folder, double lateral_mm,
                         double height_mm, double angle_deg) {
  const Row told(csv, 0);
  const Row truth(still_folder + "truth.csv", 0);
  for (const char* axis : {"x", "y"}) {
    const std::string name = axis;
    EXPECT_NEAR(told.number("tool_" + name + "_mm"), truth.number("tool_" + name), lateral_mm);
  }
  EXPECT_NEAR(told.number("tool_z_mm"), truth.number("tool_z"), height_mm);
  for (const char* angle : {"alpha", "beta", "gamma"}) {
    const std::string name = angle;
    EXPECT_NEAR(told.number("tool_" + name + "_deg"),
                truth.number("tool_" + name) * 180.0 / 3.14159265358979, angle_deg);
  }
  EXPECT_EQ(told.text("row"), truth.text("near_row"));
  EXPECT_EQ(told.text("column"), truth.text("near_col"));
  EXPECT_NEAR(told.number("offset_mm"), truth.number("offset_mm"), 2.0 * lateral_mm);
}

}  // namespace tubesight::tests
