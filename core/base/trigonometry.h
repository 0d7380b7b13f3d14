#pragma once

namespace tubesight::core {

inline constexpr double kPi = 3.14159265358979323846;

/// The sine and cosine of one angle.
struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Sine and cosine from + - x / alone, so that every processor gives the same bits.
///
/// For |angle_rad| up to 1000; within 3e-16 of the true value. libm's last bit differs between
/// processors, and settings must become the same fixed-point numbers everywhere.
[[nodiscard]] SineCosine sine_cosine(double angle_rad);

/// Degrees as radians.
[[nodiscard]] constexpr double radians(double angle_deg) { return angle_deg * (kPi / 180.0); }

}  // namespace tubesight::core
