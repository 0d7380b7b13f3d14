#include "core/calibration/link_calibration.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/calibration/base_calibration.h"
#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/inverse_kinematics.h"
#include "tests/core/calibration/base_pairs_drawn.h"

namespace tubesight::core::calibration {
namespace {

using kinematics::JointVector;
using kinematics::Link;
using kinematics::SerialArm;

const Transform<frames::Sheet, frames::Base> kBase{turned_by(20.0, 0.1, -0.1),
                                                   {30.0, -50.0, -1000.0}};

/// The Cobra with errors of its links of this size, in lengths (mm), twists and zeros (rad).
SerialArm wrong_arm(double length_mm, double twist_rad, double zero_rad, std::uint32_t seed) {
  std::mt19937 source(seed);
  std::normal_distribution<double> normal;
  const SerialArm given = kinematics::cobra_arm();
  StaticVector<Link, kinematics::kMaxJoints> links;
  for (Link link : given.links()) {
    link.a_mm += length_mm * normal(source);
    link.d_mm += length_mm * normal(source);
    link.twist_rad += twist_rad * normal(source);
    link.offset_rad += zero_rad * normal(source);
    EXPECT_TRUE(links.try_push_back(link));
  }
  return *SerialArm::make(links.view(), given.T_last_tool());
}

/// Joints that put the given arm's tool somewhere below the sheet, at random.
JointVector joints_at_random(std::mt19937& source) {
  std::uniform_real_distribution<double> radius(500.0, 1750.0);
  std::uniform_real_distribution<double> direction(-70.0, 70.0);
  std::uniform_real_distribution<double> heading(-90.0, 90.0);
  const double at = direction(source) * std::numbers::pi / 180.0;
  const double reach = radius(source);
  const Transform<frames::Base, frames::Tool> goal{
      turned_by(heading(source), 0.0, 0.0), {reach * std::cos(at), reach * std::sin(at), 960.0}};
  JointVector near = kinematics::cobra_ready();
  near[0] = at;
  const auto found = kinematics::inverse(kinematics::cobra_arm(), goal, near);
  EXPECT_TRUE(found.has_value());
  return found.value_or({}).angles_rad;
}

struct Bench {
  BasePairs pairs;
  PairJoints joints;
  BaseCalibration base;
  PairOutcomes outcomes;
  LinkWorkspace workspace;
  LinkCalibration result;

  LinkRefusal run() {
    const auto places = generator_places();
    calibrate_base(pairs, {}, places, base, outcomes);
    EXPECT_EQ(base.refusal, BaseRefusal::kNone);
    calibrate_links(kinematics::cobra_arm(), pairs, joints, base.good.view(), base.fit.pose, {},
                    workspace, result);
    return result.refusal;
  }
};

std::unique_ptr<Bench> drawn(const SerialArm& truth, int count, double noise_mm,
                             std::uint32_t seed) {
  auto bench = std::make_unique<Bench>();
  std::mt19937 source(seed);
  std::normal_distribution<double> normal(0.0, noise_mm);
  for (int i = 0; i < count; ++i) {
    const JointVector joints = joints_at_random(source);
    BasePair pair;
    pair.T_base_tool = kinematics::cobra_arm().forward(joints);
    const auto there = kBase * truth.forward(joints);
    pair.T_sheet_tool = {
        there.rotation(),
        there.translation_mm() + Eigen::Vector3d(normal(source), normal(source), normal(source))};
    EXPECT_TRUE(bench->pairs.try_push_back(pair));
    EXPECT_TRUE(bench->joints.try_push_back(joints));
  }
  return bench;
}

TEST(LinkCalibration, TellsPlacesThatItHasNotSeen) {
  const SerialArm truth = wrong_arm(0.3, 2e-4, 5e-4, 3);
  const auto bench = drawn(truth, 40, 0.05, 1);

  ASSERT_EQ(bench->run(), LinkRefusal::kNone);

  std::mt19937 source(99);
  double base2 = 0.0;
  double links2 = 0.0;
  for (int i = 0; i < 50; ++i) {
    const JointVector joints = joints_at_random(source);
    const Eigen::Vector3d there = kBase * truth.forward(joints).translation_mm();
    base2 += (bench->base.fit.pose.T_sheet_base *
                  kinematics::cobra_arm().forward(joints).translation_mm() -
              there)
                 .squaredNorm();
    links2 +=
        (bench->result.pose.T_sheet_base * bench->result.arm.forward(joints).translation_mm() -
         there)
            .squaredNorm();
  }
  EXPECT_LT(std::sqrt(links2), 0.35 * std::sqrt(base2));
  EXPECT_LT(bench->result.with_links_mm, 0.6 * bench->result.base_alone_mm);
  EXPECT_TRUE(bench->result.standing[4]) << "the wrist keeps the tool square";
  EXPECT_FALSE(bench->result.standing[1]);
}

TEST(LinkCalibration, SaysHowFarEachPairIsFromWhereTheOtherHalfForetellsIt) {
  const auto bench = drawn(wrong_arm(0.3, 2e-4, 5e-4, 3), 40, 0.05, 1);

  ASSERT_EQ(bench->run(), LinkRefusal::kNone);

  const LinkMisses& misses = bench->workspace.misses;
  ASSERT_EQ(misses.size(), bench->base.good.size());
  double alone = 0.0;
  double with_links = 0.0;
  int nearer = 0;
  for (std::int32_t i = 0; i < misses.size(); ++i) {
    EXPECT_EQ(misses[i].pair, bench->base.good[i]);
    alone += misses[i].base_alone_mm.squaredNorm();
    with_links += misses[i].with_links_mm.squaredNorm();
    nearer += misses[i].with_links_mm.norm() < misses[i].base_alone_mm.norm() ? 1 : 0;
  }
  EXPECT_NEAR(std::sqrt(alone / misses.size()), bench->result.base_alone_mm, 1e-12);
  EXPECT_NEAR(std::sqrt(with_links / misses.size()), bench->result.with_links_mm, 1e-12);
  EXPECT_GT(nearer, 30);

  bench->joints[5][1] += 0.5;
  ASSERT_EQ(bench->run(), LinkRefusal::kForeignJoints);
  EXPECT_TRUE(misses.empty()) << "nothing was fitted";
}

TEST(LinkCalibration, PromisesTheErrorOfItsNumbers) {
  double nees = 0.0;
  int count = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const SerialArm truth = wrong_arm(0.4, 4e-4, 7e-4, seed);
    const auto bench = drawn(truth, 40, 0.2, seed + 100);
    ASSERT_EQ(bench->run(), LinkRefusal::kNone) << seed;
    for (std::size_t i = 0; i < truth.links().size(); ++i) {
      const Link& is = truth.links()[i];
      const Link& found = bench->result.arm.links()[i];
      const std::size_t at = kLinkNumbers * i;
      const auto add = [&](double off, std::size_t number) {
        nees += std::pow(off / bench->result.sigmas[number], 2);
        ++count;
      };
      add(is.a_mm - found.a_mm, at);
      add(is.d_mm - found.d_mm, at + 1);
      add(is.twist_rad - found.twist_rad, at + 2);
      add(is.offset_rad - found.offset_rad, at + 3);
    }
  }
  EXPECT_GT(nees / count, 0.5);
  EXPECT_LT(nees / count, 1.5);
}

TEST(LinkCalibration, IsRefusedWhereThePairsDoNotCarryIt) {
  const SerialArm given = kinematics::cobra_arm();
  EXPECT_EQ(drawn(wrong_arm(0.3, 2e-4, 5e-4, 3), 11, 0.05, 1)->run(), LinkRefusal::kTooFew);
  EXPECT_EQ(drawn(given, 40, 0.3, 1)->run(), LinkRefusal::kNoBetter) << "noise alone";
}

TEST(LinkCalibration, RefusesTheJointsOfAnotherArm) {
  const auto bench = drawn(wrong_arm(0.3, 2e-4, 5e-4, 3), 20, 0.05, 1);
  bench->joints[7][1] += 0.2;
  EXPECT_EQ(bench->run(), LinkRefusal::kForeignJoints);
  EXPECT_EQ(bench->result.pair, 7);
}

}  // namespace
}  // namespace tubesight::core::calibration
