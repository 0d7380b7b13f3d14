#include "core/kinematics/installed_arm.h"

namespace tubesight::core::kinematics {

Transform<frames::Sheet, frames::Tool> tool_pose(const InstalledArm& installed,
                                                 const JointVector& angles_rad) {
  return installed.T_sheet_base *
         deflected(installed.arm.forward(angles_rad),
                   deflection(installed.arm, angles_rad, installed.flexibility, installed.load));
}

Result<InverseSolution> reach(const InstalledArm& installed,
                              const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
                              const JointVector& start_rad, const InverseOptions& options) {
  const Transform<frames::Base, frames::Tool> goal =
      installed.T_sheet_base.inverse() * T_sheet_tool;
  Transform<frames::Base, frames::Tool> aim = goal;
  InverseSolution solution;
  solution.angles_rad = start_rad;
  constexpr int kRounds = 8;  // each gains two digits: a deflection changes little along itself
  for (int round = 0; round < kRounds; ++round) {
    InverseOptions further = options;
    further.restarts = round == 0 ? options.restarts : 0;
    const auto next = inverse(installed.arm, aim, solution.angles_rad, further);
    if (!next) {
      return next;
    }
    const std::int32_t iterations = solution.iterations + next->iterations;
    const std::int32_t restarts = solution.restarts + next->restarts;
    solution = *next;
    solution.iterations = iterations;
    solution.restarts = restarts;
    const Deflection sag =
        deflection(installed.arm, solution.angles_rad, installed.flexibility, installed.load);
    const Transform<frames::Base, frames::Tool> corrected(
        small_turn(-sag.turn_rad) * goal.rotation(), goal.translation_mm() - sag.shift_mm);
    const double change_mm = (corrected.translation_mm() - aim.translation_mm()).norm();
    const double change_rad = turn_between(aim.rotation(), corrected.rotation()).norm();
    if (change_mm < 1e-4 && change_rad < 1e-7) {
      return solution;
    }
    aim = corrected;
  }
  return Unexpected(Error::kIllConditioned);
}

}  // namespace tubesight::core::kinematics
