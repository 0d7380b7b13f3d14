#pragma once

#include "board/bench/output/exit_status.h"
#include "board/bench/pose/pose_options.h"

namespace tubesight::board {

/// `tubesight pose`: the tool's pose from a still at rest, or from the average of several.
///
/// The poses go to standard output, messages to standard error. A refused picture gives one line
/// there and status kJobFailed; in the files of a job with several pictures its row is there, with
/// empty cells, and when no picture gives a pose no file is written.
[[nodiscard]] ExitStatus run_pose(const PoseCommandOptions& options);

}  // namespace tubesight::board
