// How many lattice steps a box is off that nothing told of a jump: part of SimulatedWorld.

#include <algorithm>
#include <array>

#include "drivers/simulated/simulated_world.h"
#include "drivers/simulated/steps_like.h"

namespace tubesight::drivers {

// How far what was left out of the path just now looks like a jump by lattice steps.
std::array<std::int32_t, 2> SimulatedWorld::steps_of_skip(const SimulatedField& field) {
  FieldFaults unskipped = field.faults;
  unskipped.skipped_s = skipped_s_;
  const double time_s = seconds_of(field.field.mid_exposure);
  const Eigen::Vector3d way =
      pose_at(time_s, field.faults).translation_mm() - pose_at(time_s, unskipped).translation_mm();
  return steps_like(scenario_->scene.sheet, scenario_->told.motion, seconds_of(slot_time(1)),
                    {way.x(), way.y()});
}

void SimulatedWorld::follow_slip(SimulatedField& out) {
  if (out.faults.skipped_s > skipped_s_) {
    const auto [rows, columns] = steps_of_skip(out);
    skip_ = {skip_[0] + rows, skip_[1] + columns};
    skipped_s_ = out.faults.skipped_s;
  }
  const std::array<std::int32_t, 2> jump{out.faults.jump[0] + skip_[0],
                                         out.faults.jump[1] + skip_[1]};
  if (!out.lost) {
    const bool anew = std::any_of(out.events.begin(), out.events.end(), [](const core::Event& one) {
      return core::content_if<core::Start>(one) != nullptr;
    });
    for (std::size_t i = 0; i < jump_.size(); ++i) {
      if (anew) {
        told_[i] = jump[i];
      } else if (gap_) {
        told_[i] += jump[i] - jump_[i];
      }
    }
    jump_ = jump;
  }
  gap_ = out.lost;
  out.truth.slip = {jump_[0] - told_[0], jump_[1] - told_[1]};
}

}  // namespace tubesight::drivers
