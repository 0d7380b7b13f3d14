#include "board/bench/calibrate/base_pairs_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "board/bench/calibrate/calibration_file.h"
#include "core/base/trigonometry.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/files/pairs_file.h"

namespace tubesight::board {
namespace {

using core::calibration::BasePair;

constexpr double kFarthest_mm = 100000.0;
constexpr double kDeepest_mm = 500.0;  // a docked tip in its tube, as --dock-height-mm has it
constexpr double kLargestTurn_deg = 360.0;
constexpr double kLargestSigma_mm = 100.0;

constexpr std::size_t kRobot = 1;
constexpr std::size_t kTool = 7;
constexpr std::size_t kSigma = 13;
constexpr std::size_t kUse = 16;

/// Reads the cells of one row; the first mistake is kept.
class RowReader {
 public:
  explicit RowReader(const std::vector<std::string>& cells) : cells_(cells) {}

  [[nodiscard]] BasePair pair() {
    BasePair pair;
    const std::array<double, 3> robot = three(kRobot, kFarthest_mm, false);
    const std::array<double, 3> tool = three(kTool, kFarthest_mm, false);
    // Either pose without its angles makes the pair one of places.
    pair.turned = has_angles(kRobot + 3) && has_angles(kTool + 3);
    const std::array<double, 3> robot_deg = three(kRobot + 3, kLargestTurn_deg, true);
    const std::array<double, 3> tool_deg = three(kTool + 3, kLargestTurn_deg, true);
    const std::array<double, 3> sigma = three(kSigma, kLargestSigma_mm, true);
    pair.T_base_tool = {core::rotation_from_degrees(robot_deg),
                        Eigen::Vector3d(robot[0], robot[1], robot[2])};
    pair.T_sheet_tool = {core::rotation_from_degrees(tool_deg),
                         Eigen::Vector3d(tool[0], tool[1], tool[2])};
    pair.sigma_mm << sigma[0], sigma[1], sigma[2];
    if (tool[2] > kDeepest_mm) {
      fail(kTool + 2,
           "expected the tool below the sheet, at negative z, or at most 500 mm in a "
           "tube; the robot's columns and vision's exchanged?");
    }
    for (std::size_t k = 0; k < sigma.size(); ++k) {
      if (sigma[k] < 0.0) {
        fail(kSigma + k, "expected a standard deviation, 0 or more");
      }
    }
    const std::string& use = cells_[kUse];
    if (!use.empty() && use != "0" && use != "1") {
      fail(kUse, "expected 1, or 0 for a pair that is only compared");
    }
    pair.use = use != "0";
    return pair;
  }

  /// The joints' angles in these columns.
  [[nodiscard]] core::kinematics::JointVector joints(const std::vector<std::size_t>& columns) {
    core::kinematics::JointVector angles_rad{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      constexpr std::int32_t kDigits = 9;
      constexpr double kLargestAngle_deg = 720.0;
      std::int64_t value = 0;
      const std::string& cell = cells_[columns[i]];
      const bool number = drivers::parse_decimal(cell, kDigits, value);
      const double angle_deg = 1e-9 * static_cast<double>(value);
      if ((!number || std::abs(angle_deg) > kLargestAngle_deg) && problem_.empty()) {
        problem_ = "joint_" + std::to_string(i + 1) + "_deg: " + drivers::in_quotes(cell) +
                   ", expected a number within 720 with at most 9 decimals";
      }
      angles_rad[i] = core::radians(angle_deg);
    }
    return angles_rad;
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  [[nodiscard]] bool has_angles(std::size_t at) const {
    return !cells_[at].empty() || !cells_[at + 1].empty() || !cells_[at + 2].empty();
  }

  std::array<double, 3> three(std::size_t at, double most, bool may_be_empty) {
    std::array<double, 3> values{};
    if (may_be_empty && !has_angles(at)) {
      return values;
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      constexpr std::int32_t kDigits = 9;
      std::int64_t value = 0;
      if (!drivers::parse_decimal(cells_[at + k], kDigits, value)) {
        fail(at + k, "expected a number with at most 9 decimals");
      } else if (values[k] = 1e-9 * static_cast<double>(value); std::abs(values[k]) > most) {
        fail(at + k, "expected at most " + drivers::number_text(most));
      }
    }
    return values;
  }

  void fail(std::size_t at, const std::string& why) {
    if (problem_.empty()) {
      problem_ = std::string(drivers::pair_columns()[at]) + ": " + drivers::in_quotes(cells_[at]) +
                 ", " + why;
    }
  }

  const std::vector<std::string>& cells_;
  std::string problem_;
};

/// Where joint_1_deg, joint_2_deg and so on are, as far as they go.
std::vector<std::size_t> joint_columns_of(const drivers::CsvReader& reader) {
  std::vector<std::size_t> columns;
  while (columns.size() < static_cast<std::size_t>(core::kinematics::kMaxJoints)) {
    const auto at = reader.find_column("joint_" + std::to_string(columns.size() + 1) + "_deg");
    if (!at) {
      break;
    }
    columns.push_back(*at);
  }
  return columns;
}

}  // namespace

bool read_base_pairs(const std::string& path, NamedPairs& pairs,
                     std::vector<std::string>& messages) {
  pairs.pairs.clear();
  pairs.names.clear();
  pairs.joints.clear();
  std::string text;
  if (!read_whole(path, text, messages)) {
    return false;
  }
  drivers::CsvReader reader(text, path);
  if (!reader.read_header(drivers::pair_columns(), messages)) {
    return false;
  }
  const std::vector<std::size_t> joint_columns = joint_columns_of(reader);
  pairs.joint_columns = static_cast<std::int32_t>(joint_columns.size());
  while (reader.next(messages) && messages.size() < drivers::CsvReader::kMostMessages) {
    RowReader row(reader.cells());
    const BasePair pair = row.pair();
    const core::kinematics::JointVector joints = row.joints(joint_columns);
    if (!row.problem().empty()) {
      messages.push_back(reader.place() + row.problem());
    } else if (!pairs.pairs.try_push_back(pair)) {
      messages.push_back(reader.place() + "more than " +
                         std::to_string(core::calibration::kMaxPairs) +
                         " pairs, expected at most that many");
      return false;
    }
    static_cast<void>(pairs.joints.try_push_back(joints));
    pairs.names.push_back(drivers::printable(reader.cells()[0]));
  }
  return messages.empty();
}

}  // namespace tubesight::board
