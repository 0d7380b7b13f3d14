// Prints what each kind of error does to the tip of a Cobra-like robot: the table of
// docs/kinematics.md. Usage: robot_errors [ROBOTS], 1000 by default.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/kinematics/arm_errors.h"
#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/tool_path.h"

namespace tubesight::tests {
namespace {

using core::kinematics::ErrorMagnitudes;
using core::kinematics::InstalledArm;
using core::kinematics::JointVector;

InstalledArm believed_arm() {
  InstalledArm believed;
  believed.arm = core::kinematics::cobra_arm();
  believed.T_sheet_base = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, -1000.0)};
  believed.flexibility = core::kinematics::cobra_flexibility();
  believed.load = core::kinematics::cobra_load();
  return believed;
}

// The tip's true place less the believed one, mm, where the believed arm holds the tool level at
// this distance from the base.
Eigen::Vector3d off_by(const InstalledArm& believed, const ErrorMagnitudes& magnitudes,
                       std::uint64_t seed, double reach_mm) {
  const auto errors = core::kinematics::draw_errors(magnitudes, believed, seed);
  const auto truth = core::kinematics::true_arm(believed, errors);
  const auto shafts = core::kinematics::reach(
      believed, core::kinematics::transform_of({reach_mm, 0.0, 40.0, 0.0, 0.0, 0.0}),
      core::kinematics::cobra_ready());
  if (!truth || !shafts) {
    std::fprintf(stderr, "robot_errors: %g mm is out of reach\n", reach_mm);
    std::exit(1);
  }
  // The drives come from one side or the other, by the seed.
  core::kinematics::JointDrive drive;
  JointVector before = shafts->angles_rad;
  for (std::size_t i = 0; i < before.size(); ++i) {
    before[i] += (seed + i) % 2 == 0 ? 0.01 : -0.01;
  }
  drive.reset(errors.drive, before);
  drive.turn_to(shafts->angles_rad);
  return tool_pose(*truth, drive.links_rad()).translation_mm() -
         tool_pose(believed, drive.readings_rad()).translation_mm();
}

void print_row(const char* name, const ErrorMagnitudes& magnitudes, std::uint64_t robots) {
  const InstalledArm believed = believed_arm();
  std::vector<double> lateral;
  double squares = 0.0;
  double height_squares = 0.0;
  for (std::uint64_t seed = 1; seed <= robots; ++seed) {
    for (const double reach_mm : {500.0, 1000.0, 1500.0, 1850.0}) {
      const Eigen::Vector3d off = off_by(believed, magnitudes, seed, reach_mm);
      lateral.push_back(std::hypot(off.x(), off.y()));
      squares += off.head<2>().squaredNorm();
      height_squares += off.z() * off.z();
    }
  }
  std::sort(lateral.begin(), lateral.end());
  const auto count = static_cast<double>(lateral.size());
  std::printf("%-20s %8.2f %8.2f %8.2f %8.2f\n", name, std::sqrt(squares / count),
              lateral[lateral.size() * 95 / 100], lateral.back(),
              std::sqrt(height_squares / count));
}

void print_table(std::uint64_t robots) {
  const ErrorMagnitudes all = core::kinematics::calibrated_magnitudes();
  const ErrorMagnitudes installed = core::kinematics::installed_magnitudes();
  std::printf("%-20s %8s %8s %8s %8s\n", "tip, mm", "rms", "95 %", "worst", "z rms");
  const auto row = [&](const char* name, auto set) {
    ErrorMagnitudes alone;
    set(alone);
    print_row(name, alone, robots);
  };
  row("1 base", [&](auto& m) {
    m.base_mm = all.base_mm;
    m.base_deg = all.base_deg;
  });
  row("1 base, installed", [&](auto& m) {
    m.base_mm = installed.base_mm;
    m.base_deg = installed.base_deg;
  });
  row("2 lengths", [&](auto& m) { m.length_mm = all.length_mm; });
  row("2 twists", [&](auto& m) { m.twist_deg = all.twist_deg; });
  row("3 zeros", [&](auto& m) { m.zero_deg = all.zero_deg; });
  row("3 resolution", [&](auto& m) { m.resolution_deg = all.resolution_deg; });
  row("3 backlash", [&](auto& m) { m.backlash_deg = all.backlash_deg; });
  row("4 tool", [&](auto& m) {
    m.tool_mm = all.tool_mm;
    m.tool_deg = all.tool_deg;
  });
  row("5 workpiece", [&](auto& m) {
    m.workpiece_mm = all.workpiece_mm;
    m.workpiece_deg = all.workpiece_deg;
  });
  row("6 support", [&](auto& m) {
    m.support_mm = all.support_mm;
    m.support_deg = all.support_deg;
  });
  row("7 deflection", [&](auto& m) {
    m.flexibility_share = all.flexibility_share;
    m.tool_mass_share = all.tool_mass_share;
  });
  print_row("all, calibrated", all, robots);
  print_row("all, installed", installed, robots);
}

}  // namespace
}  // namespace tubesight::tests

int main(int argc, char** argv) {
  const long long robots = argc > 1 ? std::atoll(argv[1]) : 1000;
  if (argc > 2 || robots < 1) {
    std::fprintf(stderr, "usage: robot_errors [ROBOTS], 1 or more\n");
    return 2;
  }
  tubesight::tests::print_table(static_cast<std::uint64_t>(robots));
  return 0;
}
