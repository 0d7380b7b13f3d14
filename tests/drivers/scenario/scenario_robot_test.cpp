#include "drivers/scenario/scenario_robot.h"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/simulated_world.h"
#include "tests/drivers/settings/settings_files.h"

namespace tubesight::drivers {
namespace {

const std::string kPlant =
    "[tool]\n"
    "position_mm = [-3.074, 31.629, 112.789]\n"
    "rotation_deg = [-0.0639, -0.8174, 47.9947]\n"
    "[tubesheet]\n"
    "row_step_mm = [0.0, 25.4]\n"
    "column_step_mm = [25.4, 0.0]\n"
    "bore_mm = 18.6\n"
    "rows = [0, 120]\n"
    "columns = [0, 120]\n"
    "[start]\n"
    "window_px = [40, 36, 595, 330]\n"
    "optimum_px = [318, 190]\n"
    "[path]\n"
    "tube = [40, 60]\n"
    "height_mm = 40\n"
    "[[step]]\n"
    "rest_s = 0.5\n"
    "[[step]]\n"
    "to = [42, 60]\n";

class ScenarioRobot : public testing::Test {
 protected:
  bool load(const std::string& robot) {
    drivers::MemoryFiles files;
    files.texts["plant.toml"] = drivers::kCameraTable + kPlant;
    files.texts["s.toml"] = "include = [\"plant.toml\"]\n" + robot;
    messages_.clear();
    return load_scenario(files, "s.toml", {}, *file_, messages_).has_value();
  }
  /// The only message of a scenario that is refused.
  std::string complaint(const std::string& robot) {
    EXPECT_FALSE(load(robot));
    EXPECT_EQ(messages_.size(), 1u);
    return messages_.empty() ? "" : messages_.front();
  }
  [[nodiscard]] const drivers::SimulatedRobotSettings& robot() const {
    return *file_->scenario.robot;
  }

  std::unique_ptr<ScenarioFile> file_ = std::make_unique<ScenarioFile>();
  drivers::Messages messages_;
};

TEST_F(ScenarioRobot, WithoutItsTableThereIsNone) {
  ASSERT_TRUE(load("[scenario]\nseed = 2\n"));
  EXPECT_FALSE(file_->scenario.robot);
}

TEST_F(ScenarioRobot, IsACobraWithTheErrorsOfACalibratedOne) {
  ASSERT_TRUE(load("[robot]\nbase_mm = [700, 600, -1000]\n"));
  ASSERT_TRUE(file_->scenario.robot);

  EXPECT_EQ(robot().believed.arm.joints(), 6);
  EXPECT_EQ(robot().believed.arm.links()[1].a_mm, 1000.0);
  EXPECT_EQ(robot().believed.T_sheet_base.translation_mm(), Eigen::Vector3d(700.0, 600.0, -1000.0));
  EXPECT_NE(robot().errors.links[1].a_mm, 0.0);
  EXPECT_LT(std::abs(robot().errors.links[1].a_mm), 1.3) << "six standard deviations";
  EXPECT_EQ(robot().claim_period_s, 0.0);
}

TEST_F(ScenarioRobot, CarriesOutThePathWithItsErrorAndClaimsWhatItBelieves) {
  ASSERT_TRUE(
      load("[robot]\nbase_mm = [700, 600, -1000]\nbase_deg = [30, 0, 0]\nerrors = \"none\"\n"
           "base_error_mm = [20, 0, 3]\nclaim_period_s = 0.25\n"));
  const auto world = std::make_unique<drivers::SimulatedWorld>();
  ASSERT_TRUE(world->configure(file_->scenario));
  const auto field = std::make_unique<drivers::SimulatedField>();

  int claims = 0;
  core::TubeAddress last{};
  while (world->next(*field)) {
    for (const core::Event& event : field->events) {
      if (const auto* const claim = core::content_if<core::Claim>(event)) {
        last = claim->tube;
        ++claims;
      }
    }
  }

  // 0.5 s of rest and 0.49 s of way; the last claim is due at 0.75 s, half way to row 42.
  EXPECT_EQ(claims, 3);
  EXPECT_EQ(last, (core::TubeAddress{41, 60}));
  // The error lies in the base's frame, which is turned by 30 degrees.
  const Eigen::Vector3d tip = field->truth.T_sheet_tool.translation_mm();
  EXPECT_NEAR(tip.x(), 1524.0 + 20.0 * 0.8660254037844386, 0.01);
  EXPECT_NEAR(tip.y(), 1066.8 + 20.0 * 0.5, 0.1) << "a field before the end of the way";
  EXPECT_NEAR(tip.z(), -37.0, 0.01);
}

TEST_F(ScenarioRobot, TakesAnArmOfItsOwn) {
  // Two links in a plane and a third that turns the tool: level below the sheet by itself.
  ASSERT_TRUE(
      load("[robot]\nbase_mm = [700, 600, -240]\nerrors = \"none\"\ntool_mm = [0, 0, 200]\n"
           "links = [[600, 0, 0, 0, -170, 170], [600, 0, 0, 0, -170, 170],\n"
           "         [0, 0, 0, 0, -360, 360]]\nnear_deg = [60, -60, 0]\n"));

  EXPECT_EQ(robot().believed.arm.joints(), 3);
  EXPECT_DOUBLE_EQ(robot().near_rad[0], core::radians(60.0));
  EXPECT_EQ(robot().believed.load.tool_mass_kg, 0.0) << "own links are stiff";
}

class ScenarioRobotErrors : public ScenarioRobot {
 protected:
  /// Where the tool truly is at the start, for a robot without other errors.
  Eigen::Vector3d tip(const std::string& keys) {
    EXPECT_TRUE(load("[robot]\nbase_mm = [700, 600, -1000]\nerrors = \"none\"\n" + keys));
    const auto world = std::make_unique<drivers::SimulatedWorld>();
    EXPECT_TRUE(world->configure(file_->scenario));
    const auto field = std::make_unique<drivers::SimulatedField>();
    EXPECT_TRUE(world->next(*field));
    tool_ = field->truth.T_sheet_tool.rotation();
    return field->truth.T_sheet_tool.translation_mm();
  }

  Eigen::Matrix3d tool_;
};

TEST_F(ScenarioRobotErrors, WithoutAnyTheToolIsWhereItIsBelieved) {
  const Eigen::Vector3d off = tip("") - Eigen::Vector3d(1524.0, 1016.0, -40.0);
  EXPECT_LT(off.norm(), 1e-3);
}

TEST_F(ScenarioRobotErrors, OfTheToolMoveAndTurnIt) {
  const Eigen::Vector3d none = tip("");
  const Eigen::Vector3d moved = tip("tool_error_mm = [2, 0, 0]\n") - none;
  EXPECT_NEAR(std::hypot(moved.x(), moved.y()), 2.0, 0.01) << "square to the guidetube";

  tip("tool_error_deg = [0, 1, 0]\n");
  EXPECT_NEAR(tool_(2, 2), 0.99984770, 1e-6) << "cos 1 degree: it leans";
}

TEST_F(ScenarioRobotErrors, OfAJointsZeroTurnTheArmAboutIt) {
  // Joint 1 is upright at (700, 600); the tip is 824 and 416 mm off it. 0.1 degrees are 0.00174533.
  const Eigen::Vector3d off = tip("zero_error_deg = [0.1, 0, 0, 0, 0, 0]\n") - tip("");
  EXPECT_NEAR(off.x(), -416.0 * 0.00174533, 0.01);
  EXPECT_NEAR(off.y(), 824.0 * 0.00174533, 0.01);
  EXPECT_NEAR(off.z(), 0.0, 0.01);
}

TEST_F(ScenarioRobotErrors, OfALinksLengthMoveTheTipAlongIt) {
  const Eigen::Vector3d off = tip("length_error_mm = [0, 1.5, 0, 0, 0, 0]\n") - tip("");
  EXPECT_NEAR(off.norm(), 1.5, 0.01);
}

TEST_F(ScenarioRobotErrors, OfWhatGivesWayLetItSink) {
  // The arm sinks by 1.2 mm at 0.5 m and by 6.4 mm at 1.85 m (kinematics.md); here at 0.92 m.
  const double none = tip("").z();
  const double half_more = tip("flexibility_error = 0.5\n").z();
  EXPECT_LT(half_more, none - 0.6);
  EXPECT_GT(half_more, none - 3.2);
  EXPECT_GT(tip("flexibility_error = -0.5\n").z(), none + 0.6);
  EXPECT_LT(tip("tool_mass_error_kg = 4\n").z(), none - 0.1);
}

TEST_F(ScenarioRobot, SaysWhatIsWrongInOneLine) {
  const std::string base = "[robot]\nbase_mm = [700, 600, -1000]\n";
  EXPECT_EQ(complaint("[robot]\nerrors = \"none\"\n"),
            "s.toml:2: robot.base_mm: missing, expected 3 times a number from -10000 to 10000 mm");
  EXPECT_NE(complaint(base + "errors = \"some\"\n").find("s.toml:4: robot.errors"),
            std::string::npos);
  EXPECT_NE(complaint(base + "lenght = 3\n").find("robot.lenght"), std::string::npos);
  EXPECT_EQ(complaint(base + "zero_error_deg = [1, 2]\n"),
            "s.toml:4: robot.zero_error_deg: a list of 2, expected 6 times a number from -10 to 10 "
            "degrees");
  EXPECT_EQ(complaint(base + "flexibility_error = 20\n"),
            "s.toml:4: robot.flexibility_error: 20, expected a number from -1 to 10");
  EXPECT_EQ(complaint(base + "tool_error_mm = 3\n"),
            "s.toml:4: robot.tool_error_mm: 3, expected 3 times a number from -500 to 500 mm");
  EXPECT_NE(complaint(base + "links = [[1, 2, 3]]\n").find("robot.links[0]"), std::string::npos);
  EXPECT_EQ(
      complaint("[robot]\nbase_mm = [-2000, 600, -1000]\n"),
      "s.toml:2: robot: the start at (1524, 1016) mm at a height of 40 mm is out of the arm's "
      "reach, expected a path within it");
  EXPECT_EQ(
      complaint("[robot]\nbase_mm = [1524, -880, -1000]\n"),
      "s.toml:2: robot: (1524, 1067) mm at a height of 40 mm, or the way there, is out of the "
      "arm's reach, expected a path within it");
}

}  // namespace
}  // namespace tubesight::drivers
