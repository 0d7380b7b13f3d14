#pragma once

#include <string>
#include <vector>

#include "core/picture/arc_edge.h"
#include "core/pose/pose_estimate.h"
#include "core/verification/position_correction.h"

namespace tubesight::board {

/// The arguments of `tubesight pose`; an empty path is one that was not given.
struct PoseCommandOptions {
  std::string session;
  std::vector<std::string> images;
  std::string frames;  ///< "A-B" or "A" of each recording; empty: its first frame
  std::string start;   ///< "R,C,U,V;…"; empty: [start] of the session
  bool only_start = false;
  bool average = false;
  bool ignore_scan_flag = false;
  std::string csv;
  std::string covariance;
  std::string overlay;
  bool total = false;
  std::string correct;  ///< "ROW,COLUMN"; empty: no correction asked for
  double limit_mm = core::verification::kProbeLimit_mm;  ///< of the insertion
  core::pose::PoseMethod method = core::pose::PoseMethod::kRims;
  core::picture::EdgeMethod edge = core::picture::EdgeMethod::kBlurredStep;
};

/// Says in one line why the outputs of a pose cannot go where they are told to, as find_clash()
/// does. Empty when they can.
[[nodiscard]] std::string find_output_conflict(const PoseCommandOptions& options);

}  // namespace tubesight::board
