#include "core/kinematics/speed_profile.h"

#include "core/base/scalar.h"

namespace tubesight::core::kinematics {
namespace {

bool in_range(double limit) { return limit >= 1e-9 && limit <= 1e9; }

// Newton's steps fall monotonically onto the root from above, by a third at least while far off.
// libm's cbrt differs between machines.
double cube_root(double value) {
  double x = value > 1.0 ? value : 1.0;
  for (int i = 0; i < 200; ++i) {
    const double next = (2.0 * x + value / (x * x)) / 3.0;
    if (!(next < x)) {
      break;
    }
    x = next;
  }
  return x;
}

// The speed at which accelerating to it and braking again, without cruising, uses up the length:
// v (v / a + a / j) = length where the full acceleration a is reached, 2 j t³ = length with v = j
// t² where it is not.
double peak_without_cruise(double length, double acceleration, double jerk) {
  const double lost = acceleration * acceleration / jerk;  // speed gained in rising to a and back
  if (length * jerk * jerk >= 2.0 * acceleration * acceleration * acceleration) {
    // (-lost + sqrt(lost² + 4 a length)) / 2, written so that nothing cancels.
    return 2.0 * acceleration * length /
           (lost + square_root(lost * lost + 4.0 * acceleration * length));
  }
  const double rise_s = cube_root(length / (2.0 * jerk));
  return jerk * rise_s * rise_s;
}

}  // namespace

Result<SpeedProfile> SpeedProfile::make(double length, SpeedShape shape,
                                        const SpeedLimits& limits) {
  const bool s_curve = shape == SpeedShape::kSCurve;
  if (!(length >= 0.0) || !(length <= 1e9) || !in_range(limits.speed) ||
      !in_range(limits.acceleration) || (s_curve && !in_range(limits.jerk))) {
    return Unexpected(Error::kInvalidArgument);
  }
  SpeedProfile profile;
  profile.length_ = length;
  if (length < 1e-30) {
    return profile;
  }
  double peak = 0.0;
  if (s_curve) {
    profile.jerk_ = limits.jerk;
    peak = peak_without_cruise(length, limits.acceleration, limits.jerk);
    peak = peak < limits.speed ? peak : limits.speed;
    const double rise_to_full_s = limits.acceleration / limits.jerk;
    const bool full = peak >= limits.acceleration * rise_to_full_s;
    profile.jerk_s_ = full ? rise_to_full_s : square_root(peak / limits.jerk);
    profile.peak_acceleration_ = full ? limits.acceleration : limits.jerk * profile.jerk_s_;
    profile.ramp_s_ = full ? rise_to_full_s + peak / limits.acceleration : 2.0 * profile.jerk_s_;
  } else {
    peak = square_root(length * limits.acceleration);
    peak = peak < limits.speed ? peak : limits.speed;
    profile.peak_acceleration_ = limits.acceleration;
    profile.ramp_s_ = peak / limits.acceleration;
  }
  // Each ramp covers half its time at the peak speed; what rounding leaves is no cruise.
  const double cruise_s = length / peak - profile.ramp_s_;
  profile.cruise_s_ = cruise_s > 0.0 ? cruise_s : 0.0;
  profile.peak_speed_ = peak;
  return profile;
}

ProfilePoint SpeedProfile::on_ramp(double time_s) const {
  if (time_s < jerk_s_) {
    const double acceleration = jerk_ * time_s;
    const double speed = 0.5 * acceleration * time_s;
    return {speed * time_s / 3.0, speed, acceleration};
  }
  const double left_s = ramp_s_ - time_s;
  if (left_s < jerk_s_) {
    // Seen from the ramp's end: the distance there less what is left of it.
    const double acceleration = jerk_ * left_s;
    const double missing = 0.5 * acceleration * left_s;
    const double distance =
        0.5 * peak_speed_ * ramp_s_ - peak_speed_ * left_s + missing * left_s / 3.0;
    return {distance, peak_speed_ - missing, acceleration};
  }
  const double even_s = time_s - jerk_s_;
  const double speed = 0.5 * peak_acceleration_ * jerk_s_;
  return {speed * jerk_s_ / 3.0 + (speed + 0.5 * peak_acceleration_ * even_s) * even_s,
          speed + peak_acceleration_ * even_s, peak_acceleration_};
}

ProfilePoint SpeedProfile::at(double time_s) const {
  const double left_s = duration_s() - time_s;
  if (!(left_s > 0.0)) {
    return {length_, 0.0, 0.0};
  }
  if (!(time_s >= 0.0)) {
    return {};
  }
  if (time_s < ramp_s_) {
    return on_ramp(time_s);
  }
  if (time_s < ramp_s_ + cruise_s_) {
    return {0.5 * peak_speed_ * ramp_s_ + peak_speed_ * (time_s - ramp_s_), peak_speed_, 0.0};
  }
  const ProfilePoint mirrored = on_ramp(left_s);
  return {length_ - mirrored.distance, mirrored.speed, -mirrored.acceleration};
}

}  // namespace tubesight::core::kinematics
