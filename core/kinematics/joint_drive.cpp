#include "core/kinematics/joint_drive.h"

#include <cmath>

namespace tubesight::core::kinematics {

void JointDrive::reset(const JointDriveSettings& settings, const JointVector& shaft_rad) {
  settings_ = settings;
  shafts_rad_ = shaft_rad;
  links_rad_ = shaft_rad;
}

void JointDrive::turn_to(const JointVector& shaft_rad) {
  shafts_rad_ = shaft_rad;
  for (std::size_t i = 0; i < shaft_rad.size(); ++i) {
    const double half = 0.5 * settings_.backlash_rad[i];
    if (links_rad_[i] < shaft_rad[i] - half) {
      links_rad_[i] = shaft_rad[i] - half;
    } else if (links_rad_[i] > shaft_rad[i] + half) {
      links_rad_[i] = shaft_rad[i] + half;
    }
  }
}

JointVector JointDrive::readings_rad() const {
  JointVector readings = shafts_rad_;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double step = settings_.resolution_rad[i];
    if (step > 0.0) {
      readings[i] = step * std::floor(shafts_rad_[i] / step + 0.5);
    }
  }
  return readings;
}

}  // namespace tubesight::core::kinematics
