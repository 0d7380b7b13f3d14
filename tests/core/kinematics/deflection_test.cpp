#include "core/kinematics/deflection.h"

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "core/kinematics/installed_arm.h"

namespace tubesight::core::kinematics {
namespace {

// A beam of a metre along x, on a joint whose axis lies across it (along -y).
SerialArm beam(double tool_mm) {
  const Link links[] = {{0.0, 0.0, radians(90.0), 0.0, -3.0, 3.0},
                        {1000.0, 0.0, 0.0, 0.0, -3.0, 3.0}};
  const auto arm =
      SerialArm::make(links, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(tool_mm, 0.0, 0.0)});
  EXPECT_TRUE(arm);
  return arm.value_or({});
}

Load pushed_down(double newton) {
  Load load;
  load.tip_force_n = {0.0, 0.0, -newton};
  return load;
}

TEST(Deflection, NothingBendsWhereAllIsStiff) {
  const Deflection d = deflection(beam(0.0), {}, {}, pushed_down(1000.0));

  EXPECT_EQ(d.shift_mm.norm(), 0.0);
  EXPECT_EQ(d.turn_rad.norm(), 0.0);
}

TEST(Deflection, AJointGivesWayByItsMoment) {
  // 100 N at a metre: 100 N m, 1e-5 rad each: a milliradian, 1 mm down at a metre.
  Flexibility flexibility;
  flexibility.joint_rad_per_nm[1] = 1e-5;

  const Deflection d = deflection(beam(0.0), {}, flexibility, pushed_down(100.0));

  EXPECT_NEAR(d.shift_mm.z(), -1.0, 1e-12);
  EXPECT_NEAR(d.shift_mm.x(), 0.0, 1e-12);
  EXPECT_NEAR(d.turn_rad.y(), 1e-3, 1e-15) << "nose down is positive about y";
}

TEST(Deflection, AJointFeelsNothingAlongTheForce) {
  // The first joint's axis is vertical: gravity has no moment about it, but across it.
  Flexibility flexibility;
  flexibility.joint_rad_per_nm[0] = 1e-5;
  EXPECT_EQ(deflection(beam(0.0), {}, flexibility, pushed_down(100.0)).shift_mm.norm(), 0.0);
  flexibility = {};
  flexibility.connection_rad_per_nm[0] = 1e-5;
  EXPECT_NEAR(deflection(beam(0.0), {}, flexibility, pushed_down(100.0)).shift_mm.z(), -1.0, 1e-12);
  flexibility = {};
  flexibility.support_rad_per_nm = 1e-5;
  EXPECT_NEAR(deflection(beam(0.0), {}, flexibility, pushed_down(100.0)).shift_mm.z(), -1.0, 1e-12);
}

TEST(Deflection, ALinkBendsLikeACantilever) {
  // F l³ / 3 EI with 100 N, 1 m, 1e4 N m²: 3.333 mm; slope F l² / 2 EI: 5 mrad.
  Flexibility flexibility;
  flexibility.link_bend_per_nm2[1] = 1e-4;

  const Deflection d = deflection(beam(0.0), {}, flexibility, pushed_down(100.0));

  EXPECT_NEAR(d.shift_mm.z(), -10.0 / 3.0, 1e-12);
  EXPECT_NEAR(d.turn_rad.y(), 5e-3, 1e-15);
}

TEST(Deflection, ALinkBendsUnderWhatItsToolAddsAsMoment) {
  // A stiff tool of 0.5 m more: the moment of 50 N m sags M l² / 2 EI = 2.5 mm and slopes M l / EI
  // = 5 mrad; with the force's 5 mrad the tool adds 0.5 m of 10 mrad.
  Flexibility flexibility;
  flexibility.link_bend_per_nm2[1] = 1e-4;

  const Deflection d = deflection(beam(500.0), {}, flexibility, pushed_down(100.0));

  EXPECT_NEAR(d.shift_mm.z(), -(10.0 / 3.0 + 2.5 + 5.0), 1e-12);
  EXPECT_NEAR(d.turn_rad.y(), 10e-3, 1e-15);
}

TEST(Deflection, ALinkTwistsUnderASidewardsTool) {
  // The tool sticks out sidewards by 200 mm (along -y, the joint's z): 100 N twist the link by 20 N
  // m about x, 1e-4 each: 2 mrad, which let the tip down by 0.4 mm.
  const Link links[] = {{0.0, 0.0, radians(90.0), 0.0, -3.0, 3.0},
                        {1000.0, 0.0, 0.0, 0.0, -3.0, 3.0}};
  const auto arm =
      SerialArm::make(links, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, 200.0)});
  ASSERT_TRUE(arm);
  Flexibility flexibility;
  flexibility.link_twist_per_nm2[1] = 1e-4;

  const Deflection d = deflection(*arm, {}, flexibility, pushed_down(100.0));

  EXPECT_NEAR(d.turn_rad.x(), 2e-3, 1e-15);
  EXPECT_NEAR(d.shift_mm.z(), -0.4, 1e-12);
}

TEST(Deflection, WeightsActWhereTheyHang) {
  // 10 kg in the beam's middle and 5 kg 100 mm beyond its end: 49.05 + 53.955 N m.
  Flexibility flexibility;
  flexibility.joint_rad_per_nm[1] = 1e-5;
  Load load;
  load.link_mass_kg[1] = 10.0;
  load.tool_mass_kg = 5.0;
  load.tool_center_mm = {100.0, 0.0, 0.0};

  const Deflection d = deflection(beam(0.0), {}, flexibility, load);

  EXPECT_NEAR(d.shift_mm.z(), -1.03005, 1e-10);
}

TEST(Deflected, TurnsAndShiftsThePose) {
  const Transform<frames::Base, frames::Tool> straight(Eigen::Matrix3d::Identity(),
                                                       Eigen::Vector3d(1.0, 2.0, 3.0));
  Deflection d;
  d.shift_mm = {0.5, 0.0, 0.0};
  d.turn_rad = {0.0, 0.02, 0.0};

  const auto bent = deflected(straight, d);

  EXPECT_NEAR(bent.translation_mm().x(), 1.5, 1e-15);
  EXPECT_NEAR(bent.rotation()(0, 2), 0.01999866669333308, 1e-6) << "sin 0.02";
  EXPECT_LT((bent.rotation() * bent.rotation().transpose() - Eigen::Matrix3d::Identity()).norm(),
            1e-15);
}

}  // namespace
}  // namespace tubesight::core::kinematics
