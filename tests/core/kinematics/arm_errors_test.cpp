#include "core/kinematics/arm_errors.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/tool_path.h"

namespace tubesight::core::kinematics {
namespace {

InstalledArm cobra_under_a_sheet() {
  InstalledArm installed;
  installed.arm = cobra_arm();
  installed.T_sheet_base = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -1000.0)};
  installed.flexibility = cobra_flexibility();
  installed.load = cobra_load();
  return installed;
}

// The tool's true place less the believed one, for links at the readings, at the ready place.
Eigen::Vector3d off_by(const InstalledArm& believed, const ArmErrors& errors,
                       const JointVector& angles_rad = cobra_ready()) {
  const auto truth = true_arm(believed, errors);
  EXPECT_TRUE(truth);
  return tool_pose(truth.value_or({}), angles_rad).translation_mm() -
         tool_pose(believed, angles_rad).translation_mm();
}

TEST(ArmErrors, WithoutErrorsTheTruthIsWhatIsBelieved) {
  EXPECT_EQ(off_by(cobra_under_a_sheet(), {}).norm(), 0.0);
}

TEST(ArmErrors, EachItemOfTheSourceMovesTheToolAsGeometrySays) {
  // At the ready place the tip is 1072.88 mm out along x and 1075.93 mm above the base; believed
  // and true arm are stiff here.
  InstalledArm believed = cobra_under_a_sheet();
  believed.flexibility = {};
  const double out_mm = 1072.8829248881;
  const double up_mm = 1075.9258262890683;
  const auto off = [&](const std::function<void(ArmErrors&)>& set) {
    ArmErrors errors;
    set(errors);
    return off_by(believed, errors);
  };
  const auto near = [](const Eigen::Vector3d& a, double x, double y, double z) {
    return (a - Eigen::Vector3d(x, y, z)).norm() < 1e-3;
  };
  const double mrad_deg = 180.0 / kPi * 1e-3;

  EXPECT_TRUE(near(off([](auto& e) { e.base.position_mm = {1.0, 2.0, 3.0}; }), 1, 2, 3));
  EXPECT_TRUE(near(off([&](auto& e) {
                     e.base.rotation_deg = {mrad_deg, 0.0, 0.0};
                   }),
                   -0.0005364, 1e-3 * out_mm, 0.0));
  EXPECT_TRUE(near(off([&](auto& e) {
                     e.base.rotation_deg = {0.0, mrad_deg, 0.0};
                   }),
                   1e-3 * up_mm - 0.0005364, 0.0, -1e-3 * out_mm - 0.000538));
  EXPECT_TRUE(near(off([](auto& e) { e.links[2].a_mm = 1.0; }), 0.8660254, 0.0, -0.5))
      << "a longer forearm, at -30 degrees";
  EXPECT_TRUE(near(off([](auto& e) { e.links[5].d_mm = 1.0; }), 0.0, 0.0, 1.0));
  EXPECT_TRUE(
      near(off([](auto& e) { e.links[0].twist_rad = 1e-3; }), 0.0, -1e-3 * (up_mm - 250.0), 0.0))
      << "the shoulder's axis tips sidewards about x";
  EXPECT_TRUE(
      near(off([](auto& e) { e.links[0].offset_rad = 1e-3; }), -0.0005364, 1e-3 * out_mm, 0.0));
  EXPECT_TRUE(near(off([](auto& e) { e.tool.position_mm = {0.1, 0.2, 0.3}; }), 0.1, 0.2, 0.3));
  EXPECT_TRUE(near(off([](auto& e) { e.workpiece.position_mm = {0.0, 0.0, 2.0}; }), 0, 0, 2));
  EXPECT_TRUE(near(off([](auto& e) { e.support.position_mm = {0.0, -2.0, 0.0}; }), 0, -2, 0));
  EXPECT_EQ(off([](auto& e) { e.drive.backlash_rad.fill(0.1); }).norm(), 0.0)
      << "is a matter of the drives";
}

TEST(ArmErrors, AHeavierToolAndSofterJointsLetTheToolDown) {
  const InstalledArm believed = cobra_under_a_sheet();
  ArmErrors heavier;
  heavier.tool_mass_kg = 60.0;  // the 68 kg of the source's Cobra in all
  ArmErrors softer;
  softer.flexibility.joint_rad_per_nm[1] = 2e-6;

  const Eigen::Vector3d down = off_by(believed, heavier);
  EXPECT_LT(down.z(), -1.0);
  EXPECT_GT(down.z(), -20.0);
  EXPECT_LT(off_by(believed, softer).z(), -0.1);
}

TEST(ArmErrors, TheDefaultCobraSagsByMillimetresAtFullReach) {
  const InstalledArm believed = cobra_under_a_sheet();
  const JointVector out = {0.0, 0.0, 0.0, radians(90.0)};

  const Deflection sag = deflection(believed.arm, out, believed.flexibility, believed.load);

  EXPECT_LT(sag.shift_mm.z(), -5.0);
  EXPECT_GT(sag.shift_mm.z(), -9.0);
}

struct Spread {
  double rms_mm = 0.0;
  double worst_mm = 0.0;
};

// Lateral error of the tool over the generator, over many robots.
Spread lateral_spread(const ErrorMagnitudes& magnitudes) {
  const InstalledArm believed = cobra_under_a_sheet();
  Spread spread;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ArmErrors errors = draw_errors(magnitudes, believed, seed);
    for (const double reach_mm : {500.0, 1000.0, 1500.0, 1850.0}) {
      const auto angles = reach(
          believed, transform_of(ToolPlace{reach_mm, 0.0, 40.0, 0.0, 0.0, 0.0}), cobra_ready());
      EXPECT_TRUE(angles);
      const Eigen::Vector3d off = off_by(believed, errors, angles->angles_rad);
      const double square = off.head<2>().squaredNorm();
      spread.rms_mm += square;
      spread.worst_mm = std::max(spread.worst_mm, std::sqrt(square));
      ++count;
    }
  }
  spread.rms_mm = std::sqrt(spread.rms_mm / count);
  return spread;
}

TEST(ArmErrors, ACalibratedCobraIsTypicallyWithinFiveMillimetres) {
  // [Fallon sec. 5.3]: "typically, positioning errors are less than 5 mm over the entire
  // generator".
  const Spread spread = lateral_spread(calibrated_magnitudes());

  EXPECT_GT(spread.rms_mm, 0.5);
  EXPECT_LT(spread.rms_mm, 2.5);
  EXPECT_LT(spread.worst_mm, 8.0);
}

TEST(ArmErrors, AnInstalledCobraIsOffByMore) {
  const Spread spread = lateral_spread(installed_magnitudes());

  EXPECT_GT(spread.rms_mm, 5.0);
  EXPECT_LT(spread.rms_mm, 25.0);
}

TEST(ArmErrors, TheSameSeedDrawsTheSameErrors) {
  const InstalledArm believed = cobra_under_a_sheet();
  const auto drawn = [&](std::uint64_t seed) {
    return off_by(believed, draw_errors(calibrated_magnitudes(), believed, seed));
  };

  EXPECT_EQ(drawn(5), drawn(5));
  EXPECT_NE(drawn(5), drawn(6));
}

TEST(ArmErrors, DrawnNumbersHaveTheirStandardDeviation) {
  ErrorMagnitudes magnitudes;
  magnitudes.length_mm = 2.0;
  const InstalledArm believed = cobra_under_a_sheet();
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (const LinkError& link : draw_errors(magnitudes, believed, seed).links) {
      sum += link.a_mm;
      squares += link.a_mm * link.a_mm;
    }
  }
  // 8000 draws: one standard deviation of the mean is 0.022, of the root 0.016.
  EXPECT_NEAR(sum / 8000.0, 0.0, 0.09);
  EXPECT_NEAR(std::sqrt(squares / 8000.0), 2.0, 0.07);
}

TEST(ArmErrors, RefusesWhatIsNoNumber) {
  ArmErrors errors;
  errors.base.position_mm[1] = std::numeric_limits<double>::quiet_NaN();

  EXPECT_FALSE(true_arm(cobra_under_a_sheet(), errors));
}

TEST(Reach, PutsTheSaggingToolWhereItIsWanted) {
  const InstalledArm installed = cobra_under_a_sheet();
  const auto wanted = transform_of(ToolPlace{1200.0, -700.0, 40.0, 30.0, 0.5, -0.5});

  const auto solution = reach(installed, wanted, cobra_ready());

  ASSERT_TRUE(solution);
  const auto there = tool_pose(installed, solution->angles_rad);
  EXPECT_LT((there.translation_mm() - wanted.translation_mm()).norm(), 2e-4);
  EXPECT_LT((there.rotation() - wanted.rotation()).norm(), 1e-6);
  // The same angles without sag would stand higher.
  InstalledArm stiff = installed;
  stiff.flexibility = {};
  EXPECT_GT(tool_pose(stiff, solution->angles_rad).translation_mm().z(), -39.0);
}

TEST(JointDrive, ReadsInStepsAndFollowsWithPlay) {
  JointDriveSettings settings;
  settings.resolution_rad[0] = 0.01;
  settings.backlash_rad[0] = 0.004;
  JointDrive drive;
  drive.reset(settings, {0.1, 0.5});

  drive.turn_to({0.1015, 0.6});
  EXPECT_NEAR(drive.links_rad()[0], 0.1, 1e-15) << "half the play is not used up";
  EXPECT_NEAR(drive.readings_rad()[0], 0.10, 1e-15);
  EXPECT_NEAR(drive.links_rad()[1], 0.6, 1e-15) << "no play here";
  EXPECT_NEAR(drive.readings_rad()[1], 0.6, 1e-15) << "no steps here";
  drive.turn_to({0.126});
  EXPECT_NEAR(drive.links_rad()[0], 0.124, 1e-15) << "follows half the play behind";
  EXPECT_NEAR(drive.readings_rad()[0], 0.13, 1e-15);
  drive.turn_to({0.123});
  EXPECT_NEAR(drive.links_rad()[0], 0.124, 1e-15) << "coming back, stays";
  drive.turn_to({0.100});
  EXPECT_NEAR(drive.links_rad()[0], 0.102, 1e-15) << "now from the other side";
  drive.turn_to({-0.126});
  EXPECT_NEAR(drive.readings_rad()[0], -0.13, 1e-15);
}

}  // namespace
}  // namespace tubesight::core::kinematics
