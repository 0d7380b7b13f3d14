#pragma once

#include <cstdint>

#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// What stands between a joint's reading and its link.
struct JointDriveSettings {
  JointVector resolution_rad{};  ///< step of the reading; 0: none
  JointVector backlash_rad{};    ///< how far the shaft turns before the link follows; 0: none
};

/// The joints' shafts, readings and links: the shaft is where the controller drives it, the reading
/// is that in whole steps, and the link follows with play.
///
/// Play: the link stays where it is until the shaft has taken up half the backlash to one side.
class JointDrive {
 public:
  /// Link and shaft begin at the same angles.
  void reset(const JointDriveSettings& settings, const JointVector& shaft_rad);

  /// Turns the shafts.
  void turn_to(const JointVector& shaft_rad);

  /// What the controller reads: the shafts' angles rounded to whole steps.
  [[nodiscard]] JointVector readings_rad() const;

  /// Where the links stand.
  [[nodiscard]] const JointVector& links_rad() const { return links_rad_; }

 private:
  JointDriveSettings settings_{};
  JointVector shafts_rad_{};
  JointVector links_rad_{};
};

}  // namespace tubesight::core::kinematics
