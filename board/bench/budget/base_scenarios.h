#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/kinematics/arm_errors.h"

namespace tubesight::board {

/// How a robot's base is calibrated, for the source's comparison [Fallon fig. 5.20, 5.21].
struct BaseMethod {
  std::string_view name;
  bool vision = false;      ///< else docking: places alone, and the sheet pushes back
  double sigma_mm = 0.0;    ///< one sigma an axis, of a place by vision or of a touch
  std::int32_t places = 3;  ///< 3 to 8
  std::int32_t links = 0;   ///< pairs all over it that calibrate the arm's links, too
  std::int32_t zones = 0;   ///< places all over the generator where vision corrects the base
};

/// The four of the source: its vision is right to 0.25 mm across, which is two axes; touches are
/// assumed. Three touches, as it has them, and eight places by vision: "it is feasible to use more
/// tubes" [Fallon sec. 5.3].
[[nodiscard]] std::array<BaseMethod, 4> source_methods();

/// Distances from the base where the tool's error is looked at, mm.
inline constexpr std::array<double, 6> kScenarioRadii_mm = {400.0,  700.0,  1000.0,
                                                            1300.0, 1600.0, 1850.0};

/// Of many robots, at one distance from the base.
struct RadiusErrors {
  double across_rms_mm = 0.0;
  double across_95_mm = 0.0;  ///< 95 % are within that
  double along_rms_mm = 0.0;
};

/// One method tried on many robots.
struct ScenarioResult {
  std::array<RadiusErrors, kScenarioRadii_mm.size()> radii{};
  /// Of the error across, root mean square over all, as many times what the calibration promises:
  /// its base's uncertainty there and the robot's scatter. Corrections by zones are not promised.
  double of_promised = 0.0;
  std::int32_t refused = 0;  ///< robots whose pairs made no base; they are not in the figures
};

struct ScenarioOptions {
  core::kinematics::ErrorMagnitudes magnitudes = core::kinematics::installed_magnitudes();
  std::int32_t robots = 200;
  std::uint64_t seed = 1;
  double push_n = 50.0;  ///< of a docked tool against the sheet: assumed
};

/// Tries a method on Cobra-like robots with drawn errors, the same robots for all methods of one
/// seed: pairs are made as vision or docking would make them, the base is calibrated from them, and
/// where it says that the tool is is compared with where it truly is, at 40 mm below tubes in three
/// directions at each distance.
[[nodiscard]] ScenarioResult try_method(const BaseMethod& method, const ScenarioOptions& options);

}  // namespace tubesight::board
