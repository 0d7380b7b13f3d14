#include "drivers/scenario/scenario_robot.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "core/base/trigonometry.h"
#include "core/kinematics/arm_errors.h"
#include "core/kinematics/cobra_arm.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/table_reader.h"
#include "drivers/simulated/simulated_robot.h"

namespace tubesight::drivers {
namespace {

using core::radians;
using core::kinematics::ErrorMagnitudes;
using core::kinematics::Link;
using core::kinematics::SerialArm;
using drivers::NumberRange;
using drivers::SimulatedRobotSettings;
using drivers::TableReader;

constexpr NumberRange kPlace{-10000.0, 10000.0, " mm"};
constexpr NumberRange kAngle{-360.0, 360.0, " degrees"};
constexpr NumberRange kError_mm{-500.0, 500.0, " mm"};
constexpr NumberRange kError_deg{-10.0, 10.0, " degrees"};
constexpr NumberRange kMassError{-100.0, 100.0, " kg"};
constexpr NumberRange kShareError{-1.0, 10.0, ""};  // -1: the true arm is stiff
constexpr NumberRange kPeriod{0.0, 3600.0, " s"};
constexpr drivers::WholeRange kSeed{0, std::numeric_limits<std::int32_t>::max()};
constexpr std::array<std::string_view, 3> kErrors = {"none", "calibrated", "installed"};
constexpr const char* kLinkExpected =
    "1 to 8 times [a_mm, d_mm, twist_deg, offset_deg, lowest_deg, highest_deg]";

/// One entry of `links`; false when it is none.
bool read_link(const toml::node& node, Link& link) {
  const toml::array* const numbers = node.as_array();
  std::array<double, 6> values{};
  if (numbers == nullptr || numbers->size() != values.size()) {
    return false;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = (*numbers)[i].value<double>();
    const double limit = i < 2 ? 5000.0 : 720.0;
    if (!value || !(std::abs(*value) <= limit)) {
      return false;
    }
    values[i] = *value;
  }
  link = {values[0],          values[1],          radians(values[2]),
          radians(values[3]), radians(values[4]), radians(values[5])};
  return link.lowest_rad <= link.highest_rad;
}

/// The arm: a Cobra-like one, or `links` and `tool_mm`. Own links are stiff.
void read_arm(TableReader& table, SimulatedRobotSettings& robot) {
  robot.believed.arm = core::kinematics::cobra_arm();
  robot.believed.flexibility = core::kinematics::cobra_flexibility();
  robot.believed.load = core::kinematics::cobra_load();
  robot.near_rad = core::kinematics::cobra_ready();
  std::array<double, 3> tool_mm{0.0, 0.0, 180.0};
  table.optional_numbers("tool_mm", kPlace, tool_mm);
  const core::Transform<core::kinematics::LinkFrame, core::frames::Tool> T_last_tool(
      Eigen::Matrix3d::Identity(), Eigen::Vector3d(tool_mm[0], tool_mm[1], tool_mm[2]));
  std::vector<Link> links(robot.believed.arm.links().begin(), robot.believed.arm.links().end());
  if (const toml::array* const list = table.list("links", false, kLinkExpected)) {
    robot.believed.flexibility = {};
    robot.believed.load = {};
    robot.near_rad = {};
    links.assign(list->size(), Link{});
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (!read_link((*list)[i], links[i])) {
        table.complain_entry("links", i, (*list)[i],
                             drivers::describe((*list)[i]) + ", expected " + kLinkExpected);
      }
    }
  }
  const auto arm = SerialArm::make(links, T_last_tool);
  if (!arm) {
    table.complain("links", std::string("no arm, expected ") + kLinkExpected);
    return;
  }
  robot.believed.arm = *arm;
  std::vector<double> near_deg(links.size());
  if (table.has("near_deg") && table.optional_numbers("near_deg", kAngle, near_deg)) {
    robot.near_rad = {};
    for (std::size_t i = 0; i < near_deg.size(); ++i) {
      robot.near_rad[i] = radians(near_deg[i]);
    }
  }
  table.ignore("near_deg");
}

ErrorMagnitudes magnitudes(std::size_t word) {
  return word == 1   ? core::kinematics::calibrated_magnitudes()
         : word == 2 ? core::kinematics::installed_magnitudes()
                     : ErrorMagnitudes{};
}

void read_errors(TableReader& table, std::uint64_t scenario_seed, SimulatedRobotSettings& robot) {
  std::size_t word = 1;
  auto seed = static_cast<std::int32_t>(scenario_seed & 0x7FFFFFFFU);
  std::array<double, 3> base_mm{};
  std::array<double, 3> base_deg{};
  table.optional_word("errors", kErrors, word);
  table.optional_whole("seed", kSeed, seed);
  table.optional_numbers("base_error_mm", kError_mm, base_mm);
  table.optional_numbers("base_error_deg", kError_deg, base_deg);
  robot.errors = core::kinematics::draw_errors(magnitudes(word), robot.believed,
                                               static_cast<std::uint64_t>(seed));
  for (std::size_t i = 0; i < 3; ++i) {
    robot.errors.base.position_mm[i] += base_mm[i];
    robot.errors.base.rotation_deg[i] += base_deg[i];
  }
}

/// Errors of single parts, on top of those drawn; believed arm and links are read before.
void read_single_errors(TableReader& table, SimulatedRobotSettings& robot) {
  const auto joints = static_cast<std::size_t>(robot.believed.arm.joints());
  core::kinematics::ArmErrors& errors = robot.errors;
  std::array<double, 3> tool_mm{};
  std::array<double, 3> tool_deg{};
  std::vector<double> zeros_deg(joints);
  std::vector<double> lengths_mm(joints);
  double share = 0.0;
  double mass_kg = 0.0;
  table.optional_numbers("tool_error_mm", kError_mm, tool_mm);
  table.optional_numbers("tool_error_deg", kError_deg, tool_deg);
  table.optional_numbers("zero_error_deg", kError_deg, zeros_deg);
  table.optional_numbers("length_error_mm", kError_mm, lengths_mm);
  table.optional_number("flexibility_error", kShareError, share);
  table.optional_number("tool_mass_error_kg", kMassError, mass_kg);
  for (std::size_t i = 0; i < 3; ++i) {
    errors.tool.position_mm[i] += tool_mm[i];
    errors.tool.rotation_deg[i] += tool_deg[i];
  }
  for (std::size_t i = 0; i < joints; ++i) {
    errors.links[i].offset_rad += radians(zeros_deg[i]);
    errors.links[i].a_mm += lengths_mm[i];
  }
  const core::kinematics::Flexibility& believed = robot.believed.flexibility;
  errors.flexibility.support_rad_per_nm += share * believed.support_rad_per_nm;
  for (std::size_t i = 0; i < joints; ++i) {
    errors.flexibility.joint_rad_per_nm[i] += share * believed.joint_rad_per_nm[i];
    errors.flexibility.connection_rad_per_nm[i] += share * believed.connection_rad_per_nm[i];
    errors.flexibility.link_bend_per_nm2[i] += share * believed.link_bend_per_nm2[i];
    errors.flexibility.link_twist_per_nm2[i] += share * believed.link_twist_per_nm2[i];
  }
  errors.tool_mass_kg += mass_kg;
}

void read_robot_table(TableReader& table, std::uint64_t seed, SimulatedRobotSettings& robot) {
  std::array<double, 3> base_mm{};
  std::array<double, 3> base_deg{};
  table.numbers("base_mm", kPlace, base_mm);
  table.optional_numbers("base_deg", kAngle, base_deg);
  robot.believed.T_sheet_base = {core::rotation_from_degrees(base_deg),
                                 Eigen::Vector3d(base_mm[0], base_mm[1], base_mm[2])};
  read_arm(table, robot);
  read_errors(table, seed, robot);
  read_single_errors(table, robot);
  robot.claim_period_s = 0.0;
  table.optional_number("claim_period_s", kPeriod, robot.claim_period_s);
}

std::string place_text(const core::kinematics::ToolPlace& place) {
  const auto whole = [](double mm) { return std::to_string(std::lround(mm)); };
  return "(" + whole(place.x_mm) + ", " + whole(place.y_mm) + ") mm at a height of " +
         whole(place.height_mm) + " mm";
}

}  // namespace

bool read_robot(drivers::SettingsDocument& document, drivers::Scenario& scenario) {
  scenario.robot.reset();
  if (document.find("robot") == nullptr) {
    return true;
  }
  SimulatedRobotSettings robot;
  const bool good = drivers::read_table(document, "robot", false, [&](TableReader& table) {
    read_robot_table(table, scenario.seed, robot);
  });
  if (good) {
    scenario.robot = robot;
  }
  return good;
}

std::string why_robot_cannot(const drivers::Scenario& scenario) {
  if (!scenario.robot) {
    return {};
  }
  constexpr const char* kExpected = " is out of the arm's reach, expected a path within it";
  SimulatedRobotSettings settings = *scenario.robot;
  settings.home = scenario.from;
  const auto robot = std::make_unique<drivers::SimulatedRobot>();
  if (!robot->configure(settings, scenario.told.tubesheet)) {
    return "robot: the start at " + place_text(scenario.from) + kExpected;
  }
  core::kinematics::ToolPlace place = scenario.from;
  for (const core::kinematics::PathSegment& segment : scenario.path) {
    place = core::kinematics::end_of(segment, place);
    if (!robot->add(segment)) {
      return "robot: " + place_text(place) + ", or the way there," + kExpected;
    }
  }
  return {};
}

core::Result<void> load_arm(const std::string& path, core::kinematics::SerialArm& arm,
                            drivers::Messages& messages) {
  constexpr std::array<std::string_view, 3> kArmTables = {"robot", "base", "base_quality"};
  drivers::DiskFiles files;
  drivers::SettingsDocument document;
  document.load(files, path, kArmTables);
  read_table(document, "robot", true, [&](TableReader& table) {
    if (!table.has("links")) {
      table.list("links", true, kLinkExpected);  // says that it is missing
      table.ignore("tool_mm");
      table.ignore("near_deg");
      return;
    }
    const auto robot = std::make_unique<SimulatedRobotSettings>();
    read_arm(table, *robot);
    arm = robot->believed.arm;
  });
  return document.report(messages);
}

}  // namespace tubesight::drivers
