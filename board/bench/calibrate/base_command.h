#pragma once

#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate base`.
struct CalibrateBaseOptions {
  std::string pairs;
  bool level = false;
  bool tool_known = false;
  std::string sheet;    ///< a session whose tubesheet is the generator; empty: a disc of 3 m
  std::string touches;  ///< pairs made by docking, for comparison
  std::string picture;
  std::string out;
};

/// `tubesight calibrate base`: where the robot's base stands in the sheet frame, from poses of the
/// tool by the robot's kinematics and by vision.
///
/// Base, uncertainties, pairs and the next place go to standard output; the settings to `out`,
/// whose former content is kept as `out.bak`; a plan of the sheet to `picture`. Pairs that make no
/// base give one line on standard error and status kJobFailed, and no file.
[[nodiscard]] ExitStatus run_calibrate_base(const CalibrateBaseOptions& options);

}  // namespace tubesight::board
