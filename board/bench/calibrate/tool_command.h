#pragma once

#include <string>
#include <vector>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate tool`.
struct CalibrateToolOptions {
  std::string session;
  std::vector<std::string> docks;   ///< "ROW,COLUMN" and its pictures, one docking after the other
  std::vector<std::string> checks;  ///< the same, compared and not used
  std::vector<std::string> starts;  ///< "R,C,U,V;…" for all, or for each docking and check
  double height_mm = 0.0;
  std::string offset_mm;  ///< "X,Y" of the tip from the tube's centre; empty: not known
  double heading_deg = 0.0;
  bool free_focal = false;  ///< the EFL is found, too
  bool ignore_scan_flag = false;
  std::string points;     ///< points file of a target on the guidetube, in place of dockings
  std::string guidetube;  ///< "DIAMETER,LENGTH" of the guidetube; empty: no silhouette
  std::string picture;    ///< what is drawn; empty: nothing
  std::string out;
};

/// `tubesight calibrate tool`: the guidetube's tip and axis in the camera frame, from pictures
/// taken with it docked on known tubes, or from points on it.
///
/// Pose, uncertainty and checks go to standard output; the settings to `out`, whose former content
/// is kept as `out.bak`. Dockings that contradict each other, or a picture without a pose, give one
/// line on standard error and status kJobFailed, and no file.
[[nodiscard]] ExitStatus run_calibrate_tool(const CalibrateToolOptions& options);

}  // namespace tubesight::board
