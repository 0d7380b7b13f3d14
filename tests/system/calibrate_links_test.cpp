// `tubesight calibrate links` on pairs of an arm whose links are not those on paper.

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/math/rotation.h"
#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using core::Transform;
using core::kinematics::JointVector;
using core::kinematics::SerialArm;
using support::TemporaryFolder;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr const char* kArm =
    "[robot]\nlinks = [[0, 250, 90, 0, -175, 175], [1000, 0, 0, 0, -30, 150], "
    "[940, 0, 0, 0, -155, 155], [0, 0, 90, 0, -200, 200], [0, 0, 90, 90, -60, 60], "
    "[0, 150, 0, 90, -270, 270]]\ntool_mm = [0, 0, 180]\n";

/// The Cobra with a shoulder link 0.8 mm longer and an elbow's zero 0.1 degrees off.
SerialArm true_arm() {
  const SerialArm given = core::kinematics::cobra_arm();
  std::vector<core::kinematics::Link> links(given.links().begin(), given.links().end());
  links[1].a_mm += 0.8;
  links[2].offset_rad += 0.1 / kDegrees;
  return *SerialArm::make(links, given.T_last_tool());
}

template <typename To>
std::string cells_of(const Transform<To, core::frames::Tool>& pose) {
  const auto angles = core::math::angles_of(pose.rotation());
  const auto& t = pose.translation_mm();
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%.4f,%.4f,%.4f,%.6f,%.6f,%.6f,", t.x(), t.y(), t.z(),
                angles[0] * kDegrees, angles[1] * kDegrees, angles[2] * kDegrees);
  return text.data();
}

/// Pairs below the sheet, the base a metre below it; those of `truth` as vision sees them.
std::string pairs_text(int count, const SerialArm& truth) {
  std::string text =
      "name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg,"
      "tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,sigma_x_mm,"
      "sigma_y_mm,sigma_z_mm,use,joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,"
      "joint_6_deg\n";
  const Transform<core::frames::Sheet, core::frames::Base> base{Eigen::Matrix3d::Identity(),
                                                                {0.0, 0.0, -1000.0}};
  for (int i = 0; i < count; ++i) {
    const double reach = 500.0 + 1250.0 * std::fmod(0.618 * i, 1.0);
    const double at = -1.2 + 2.4 * std::fmod(0.414 * i, 1.0);
    const double heading = -1.5 + 3.0 * std::fmod(0.732 * i, 1.0);
    JointVector near = core::kinematics::cobra_ready();
    near[0] = at;
    const auto found =
        core::kinematics::inverse(core::kinematics::cobra_arm(),
                                  {core::math::exp_rotation({0.0, 0.0, heading}),
                                   {reach * std::cos(at), reach * std::sin(at), 960.0}},
                                  near);
    EXPECT_TRUE(found.has_value());
    const JointVector joints = found.value_or({}).angles_rad;
    text += "p" + std::to_string(i) + "," +
            cells_of(core::kinematics::cobra_arm().forward(joints)) +
            cells_of(base * truth.forward(joints)) + "0.02,0.02,0.02,1";
    for (std::size_t k = 0; k < 6; ++k) {
      std::array<char, 40> cell{};
      std::snprintf(cell.data(), cell.size(), ",%.7f", joints[k] * kDegrees);
      text += cell.data();
    }
    text += "\n";
  }
  return text;
}

ProgramRun run_links(const TemporaryFolder& folder, const std::string& picture = "links.png") {
  return run_tubesight(folder, {"calibrate", "links", "pairs.csv", "--arm", "arm.toml", "--out",
                                "found.toml", "--picture", picture});
}

TEST(CalibrateLinks, FindsWhatIsNotAsOnPaper) {
  const TemporaryFolder folder;
  folder.write("arm.toml", kArm);
  folder.write("pairs.csv", pairs_text(40, true_arm()));
  folder.write("found.toml", "what stood here");

  const ProgramRun run = run_links(folder);

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("links of 6 joints from 40 pairs\n")) << run.out;
  const std::string found = folder.read("found.toml");
  const std::size_t second = found.find("], [");
  ASSERT_NE(second, std::string::npos) << found;
  double length = 0.0;
  ASSERT_EQ(std::sscanf(found.c_str() + second + 4, "%lf", &length), 1);
  EXPECT_NEAR(length, 1000.8, 0.35);
  EXPECT_NE(found.find("[base]\nposition_mm = ["), std::string::npos);
  EXPECT_EQ(folder.read("found.toml.bak"), "what stood here");
  EXPECT_EQ(folder.read("links.png").substr(1, 3), "PNG");
  // It is read again as an arm.
  folder.write("arm.toml", found);
  const ProgramRun again = run_links(folder);
  EXPECT_EQ(again.status, 0) << again.err;
}

TEST(CalibrateLinks, RefusesPairsThatDoNotCarryThem) {
  const auto refused = [](const std::string& arm, const std::string& pairs, int status,
                          const std::string& why, bool drawn = false) {
    const TemporaryFolder folder;
    folder.write("arm.toml", arm);
    folder.write("pairs.csv", pairs);
    const ProgramRun run = run_links(folder);
    EXPECT_EQ(run.status, status) << why;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("found.toml"))) << why;
    EXPECT_EQ(std::filesystem::exists(folder.path("links.png")), drawn) << why;
  };
  refused(kArm, pairs_text(10, true_arm()), 1, "pairs.csv: no links: 10 pairs are in use");
  refused(kArm, pairs_text(30, core::kinematics::cobra_arm()), 1,
          "pairs.csv: no links: half of the pairs foretell the others", true);
  refused(support::replaced(kArm, "[940, 0, 0, 0,", "[640, 0, 0, 0,"), pairs_text(30, true_arm()),
          1, "pairs.csv: no links: at the joint angles of pair p");
  refused(support::replaced(kArm, ", [0, 150, 0, 90, -270, 270]", ""), pairs_text(30, true_arm()),
          2, "pairs.csv:1: 6 columns joint_1_deg and so on, expected 5");
  refused("[robot]\ntool_mm = [0, 0, 180]\n", pairs_text(30, true_arm()), 2,
          "robot.links: missing");
  refused(kArm, support::replaced(pairs_text(30, true_arm()), "joint_2_deg", "joint_x_deg"), 2,
          "1 columns joint_1_deg");
}

TEST(CalibrateLinks, DrawsOverNothingThatIsRead) {
  const TemporaryFolder folder;
  folder.write("arm.toml", kArm);
  folder.write("pairs.csv", "kept");
  const ProgramRun run = run_links(folder, "pairs.csv");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "--picture: 'pairs.csv' is also the pairs, expected a place of its own\n");
  EXPECT_EQ(folder.read("pairs.csv"), "kept");
}

}  // namespace
}  // namespace tubesight::tests
