#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace tubesight::core::kinematics {

/// How speed rises from rest and falls back to it.
enum class SpeedShape : std::uint8_t {
  kTrapezoid,  ///< constant acceleration, then constant speed, then constant deceleration
  kSCurve,     ///< the same with the acceleration itself rising and falling at constant jerk
};

/// What a move may not exceed. The unit of length is the profile's own: mm, or degrees of a turn.
struct SpeedLimits {
  double speed = 250.0;          ///< per second, above 0; the source's limit [Fallon sec. 6.3]
  double acceleration = 1000.0;  ///< per second², above 0
  double jerk = 10000.0;         ///< per second³, above 0; of the S-curve only
};

/// Where a profile is at an instant.
struct ProfilePoint {
  double distance = 0.0;      ///< 0..length
  double speed = 0.0;         ///< per second, never negative
  double acceleration = 0.0;  ///< per second²
};

/// The fastest way along a length from rest to rest within limits of speed, acceleration and jerk.
///
/// Closed forms, exact but for rounding: polynomials of time in up to seven stretches. The second
/// half mirrors the first, so that the end is met exactly: at(duration_s()) is the length at speed
/// 0. A move too short for the limits reaches neither full speed nor, as an S-curve, full
/// acceleration; a length of 0 takes no time. Only + - x / and square roots: the same bits on every
/// machine.
class SpeedProfile {
 public:
  /// A profile of length 0 and no duration.
  SpeedProfile() = default;

  /// kInvalidArgument: the length is not within 0..1e9, or a limit that counts not within
  /// 1e-9..1e9. A length below 1e-30 takes no time.
  [[nodiscard]] static Result<SpeedProfile> make(double length, SpeedShape shape,
                                                 const SpeedLimits& limits);

  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double duration_s() const { return 2.0 * ramp_s_ + cruise_s_; }

  /// The highest speed reached.
  [[nodiscard]] double peak_speed() const { return peak_speed_; }
  /// The highest acceleration reached.
  [[nodiscard]] double peak_acceleration() const { return peak_acceleration_; }

  /// The state `time_s` after the start. At rest at the start before it and at the end after it; at
  /// an instant where the acceleration jumps, the one that follows.
  [[nodiscard]] ProfilePoint at(double time_s) const;

 private:
  [[nodiscard]] ProfilePoint on_ramp(double time_s) const;

  double length_ = 0.0;
  double peak_speed_ = 0.0;
  double peak_acceleration_ = 0.0;
  double jerk_ = 0.0;      ///< 0 for a trapezoid
  double ramp_s_ = 0.0;    ///< from rest to the peak speed; from there to rest takes as long
  double jerk_s_ = 0.0;    ///< within the ramp: until the peak acceleration; 0 for a trapezoid
  double cruise_s_ = 0.0;  ///< at the peak speed
};

}  // namespace tubesight::core::kinematics
