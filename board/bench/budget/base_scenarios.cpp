#include "board/bench/budget/base_scenarios.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "core/base/assert.h"
#include "core/calibration/base_calibration.h"
#include "core/calibration/link_calibration.h"
#include "core/calibration/zone_field.h"
#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/tool_path.h"
#include "core/math/rotation.h"

namespace tubesight::board {
namespace {

namespace calibration = core::calibration;
namespace kinematics = core::kinematics;
using kinematics::InstalledArm;

constexpr double kHeight_mm = 40.0;
constexpr double kVisionTurn_rad = 3e-4;  // 0.02 degrees, of tubes 0.04 px off
constexpr double kServiceHeading_deg = 15.0;
constexpr double kRepeat_mm = 0.15;  // the arm's play, roughly
constexpr double kDegree = std::numbers::pi / 180.0;

/// Distance from the base, direction, heading of the tool. Three touches are in different parts of
/// the generator.
struct Stand {
  double reach_mm;
  double direction_deg;
  double heading_deg;
};
constexpr std::array<Stand, 8> kStands = {{{1700.0, 0.0, 0.0},
                                           {1300.0, -70.0, 40.0},
                                           {1300.0, 70.0, -35.0},
                                           {500.0, 0.0, 90.0},
                                           {900.0, -35.0, 20.0},
                                           {900.0, 35.0, -60.0},
                                           {1700.0, -40.0, -90.0},
                                           {1700.0, 40.0, 60.0}}};
constexpr std::array<double, 3> kDirections_deg = {-50.0, 5.0, 60.0};

/// Place i of so many all over the generator: a sunflower's pattern within reach.
Stand spread_out(std::int32_t i, std::int32_t count, double heading_deg) {
  const double share = (i + 0.5) / count;
  const double golden = 0.618034 * i;
  return {std::sqrt(400.0 * 400.0 + share * (1850.0 * 1850.0 - 400.0 * 400.0)),
          150.0 * (golden - std::floor(golden)) - 75.0, heading_deg};
}

InstalledArm believed_arm() {
  InstalledArm believed;
  believed.arm = kinematics::cobra_arm();
  believed.T_sheet_base = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -1000.0)};
  believed.flexibility = kinematics::cobra_flexibility();
  believed.load = kinematics::cobra_load();
  return believed;
}

/// A robot at rest: its tool as its kinematics tell it, in its own base, and as it is.
struct Rest {
  core::Transform<core::frames::Base, core::frames::Tool> T_base_tool;
  core::Transform<core::frames::Sheet, core::frames::Tool> T_sheet_tool;
  kinematics::JointVector joints_rad{};  ///< as they read
};

class Robot {
 public:
  Robot(const ScenarioOptions& options, std::uint64_t seed) : believed_(believed_arm()) {
    errors_ = kinematics::draw_errors(options.magnitudes, believed_, seed);
    const auto truth = kinematics::true_arm(believed_, errors_);
    TUBESIGHT_ASSERT(truth.has_value());  // what is drawn is finite
    truth_ = *truth;
    docked_ = truth_;
    docked_.load.tip_force_n = {0.0, 0.0, -options.push_n};
  }

  [[nodiscard]] Rest stand(const Stand& at, bool docked) const {
    const double direction = at.direction_deg * kDegree;
    const auto goal = kinematics::transform_of(
        {at.reach_mm * std::cos(direction), at.reach_mm * std::sin(direction),
         docked ? 0.0 : kHeight_mm, at.heading_deg, 0.0, 0.0});
    kinematics::JointVector near = kinematics::cobra_ready();
    near[0] = direction;
    const auto shafts = kinematics::reach(believed_, goal, near);
    TUBESIGHT_ASSERT(shafts.has_value());  // all stands are within the arm's reach
    kinematics::JointDrive drive;
    kinematics::JointVector before = shafts->angles_rad;
    for (std::size_t i = 0; i < before.size(); ++i) {
      // It comes from one side or the other, by the place.
      before[i] += std::sin(at.reach_mm + 50.0 * at.direction_deg + static_cast<double>(i)) > 0.0
                       ? 0.01
                       : -0.01;
    }
    drive.reset(errors_.drive, before);
    drive.turn_to(shafts->angles_rad);
    return {believed_.T_sheet_base.inverse() * tool_pose(believed_, drive.readings_rad()),
            tool_pose(docked ? docked_ : truth_, drive.links_rad()), drive.readings_rad()};
  }

 private:
  InstalledArm believed_;
  kinematics::ArmErrors errors_;
  InstalledArm truth_;
  InstalledArm docked_;
};

class Noise {
 public:
  explicit Noise(std::uint64_t seed) : source_(seed) {}
  /// A normal number each, by sums of twelve uniform ones: the same on every machine.
  Eigen::Vector3d three(double sigma) {
    Eigen::Vector3d values;
    for (int i = 0; i < 3; ++i) {
      double sum = -6.0;
      for (int k = 0; k < 12; ++k) {
        sum += static_cast<double>(source_() >> 11U) * 0x1p-53;
      }
      values(i) = sigma * sum;
    }
    return values;
  }

 private:
  std::mt19937_64 source_;
};

/// What a calibration works in: too large for a stack.
struct Desk {
  calibration::BasePairs pairs;
  calibration::BaseCalibration base;
  calibration::PairOutcomes outcomes;
  calibration::ZoneField field;
  calibration::PairJoints joints;
  calibration::LinkWorkspace workspace;
  calibration::LinkCalibration links;
  bool with_links = false;
};

std::vector<Eigen::Vector2d> tested_places() {
  std::vector<Eigen::Vector2d> places;
  for (const double radius : kScenarioRadii_mm) {
    for (const double direction : kDirections_deg) {
      places.emplace_back(radius * std::cos(direction * kDegree),
                          radius * std::sin(direction * kDegree));
    }
  }
  return places;
}

bool calibrate(const BaseMethod& method, const Robot& robot, std::uint64_t seed, Desk& desk) {
  Noise noise(seed);
  desk.pairs.clear();
  desk.joints.clear();
  const std::int32_t count = std::max(method.places, method.links);
  for (std::int32_t i = 0; i < count; ++i) {
    const Stand at = method.links > 0 ? spread_out(i, count, 70.0 * (i % 4) - 105.0)
                                      : kStands[static_cast<std::size_t>(i)];
    const Rest rest = robot.stand(at, !method.vision);
    static_cast<void>(desk.joints.try_push_back(rest.joints_rad));
    calibration::BasePair pair;
    pair.turned = method.vision;
    pair.T_base_tool = rest.T_base_tool;
    const Eigen::Vector3d off = noise.three(method.sigma_mm);
    const Eigen::Matrix3d turn =
        core::math::exp_rotation(noise.three(method.sigma_mm > 0.0 ? kVisionTurn_rad : 0.0));
    pair.T_sheet_tool = {turn * rest.T_sheet_tool.rotation(),
                         rest.T_sheet_tool.translation_mm() + off};
    pair.sigma_mm.setConstant(method.sigma_mm);
    static_cast<void>(desk.pairs.try_push_back(pair));
  }
  calibration::calibrate_base(desk.pairs, {}, tested_places(), desk.base, desk.outcomes);
  if (desk.base.refusal != calibration::BaseRefusal::kNone) {
    return false;
  }
  desk.with_links = false;
  if (method.links > 0) {
    calibration::calibrate_links(kinematics::cobra_arm(), desk.pairs, desk.joints,
                                 desk.base.good.view(), desk.base.fit.pose, {}, desk.workspace,
                                 desk.links);
    desk.with_links = desk.links.refusal == calibration::LinkRefusal::kNone;
  }
  return true;
}

/// Where the tool is, by the calibrated base, or by base and links.
Eigen::Vector3d told_by(const Desk& desk, const Rest& rest) {
  if (desk.with_links) {
    const auto given = kinematics::cobra_arm().forward(rest.joints_rad);
    const auto corrected =
        rest.T_base_tool * (given.inverse() * desk.links.arm.forward(rest.joints_rad));
    return desk.links.pose.T_sheet_base * corrected.translation_mm();
  }
  return desk.base.fit.pose.T_sheet_base * rest.T_base_tool.translation_mm();
}

/// Corrections seen at places all over the generator, under the heading of the service.
void take_zones(const BaseMethod& method, const Robot& robot, std::uint64_t seed, Desk& desk) {
  Noise noise(seed + 0x5eedU);
  calibration::ZonePoints points;
  for (std::int32_t i = 0; i < method.zones; ++i) {
    const Rest rest = robot.stand(spread_out(i, method.zones, kServiceHeading_deg), false);
    calibration::ZonePoint point;
    const Eigen::Vector3d seen = rest.T_sheet_tool.translation_mm() + noise.three(method.sigma_mm);
    point.at_mm = seen.head<2>();
    point.off_mm = seen - told_by(desk, rest);
    point.sigma_mm = std::hypot(kRepeat_mm, method.sigma_mm);
    static_cast<void>(points.try_push_back(point));
  }
  desk.field.choose(points);
}

}  // namespace

std::array<BaseMethod, 4> source_methods() {
  return {{{"vision", true, 0.25 / std::numbers::sqrt2, 8, 0, 0},
           {"touch, skilled, special tool", false, 0.25, 3, 0, 0},
           {"touch, skilled, standard tool", false, 0.5, 3, 0, 0},
           {"touch, average, standard tool", false, 1.0, 3, 0, 0}}};
}

ScenarioResult try_method(const BaseMethod& method, const ScenarioOptions& options) {
  TUBESIGHT_ASSERT(method.places >= 3 && method.places <= static_cast<int>(kStands.size()));
  ScenarioResult result;
  const auto desk = std::make_unique<Desk>();
  std::array<std::vector<Eigen::Vector3d>, kScenarioRadii_mm.size()> errors;
  double promised2 = 0.0;
  double all2 = 0.0;
  for (std::int32_t i = 0; i < options.robots; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const Robot robot(options, seed);
    if (!calibrate(method, robot, seed, *desk)) {
      ++result.refused;
      continue;
    }
    if (method.zones > 0) {
      take_zones(method, robot, seed, *desk);
    }
    for (std::size_t r = 0; r < kScenarioRadii_mm.size(); ++r) {
      for (const double direction : kDirections_deg) {
        const Rest rest =
            robot.stand({kScenarioRadii_mm[r], direction, kServiceHeading_deg}, false);
        Eigen::Vector3d told = told_by(*desk, rest);
        if (method.zones > 0) {
          told += desk->field.at(told.head<2>()).off_mm;
        }
        const Eigen::Vector2d at = told.head<2>();
        const double scatter = desk->base.fit.scatter.across_mm;
        promised2 += std::pow(calibration::deviation_at(desk->base, at).across_mm, 2) +
                     2.0 * scatter * scatter;
        errors[r].push_back(told - rest.T_sheet_tool.translation_mm());
      }
    }
  }
  for (std::size_t r = 0; r < kScenarioRadii_mm.size() && !errors[r].empty(); ++r) {
    std::vector<double> across;
    double along2 = 0.0;
    double across2 = 0.0;
    for (const Eigen::Vector3d& error : errors[r]) {
      across.push_back(error.head<2>().norm());
      across2 += error.head<2>().squaredNorm();
      along2 += error.z() * error.z();
    }
    all2 += across2;
    std::sort(across.begin(), across.end());
    const auto count = static_cast<double>(across.size());
    result.radii[r] = {std::sqrt(across2 / count), across[across.size() * 95 / 100],
                       std::sqrt(along2 / count)};
  }
  result.of_promised = promised2 > 0.0 ? std::sqrt(all2 / promised2) : 0.0;
  return result;
}

}  // namespace tubesight::board
