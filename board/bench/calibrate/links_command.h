#pragma once

#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate links`.
struct CalibrateLinksOptions {
  std::string pairs;  ///< with joint_1_deg and so on
  std::string arm;    ///< a settings file whose [robot] has the links on paper
  std::string picture;
  std::string out;
};

/// `tubesight calibrate links`: the numbers of an arm's links with its base, from pairs whose joint
/// angles are known. `[robot]` with the links found, and `[base]`, go to `out`, whose former
/// content is kept as `out.bak`; `picture` shows what they are worth over the sheet, and each
/// number beside what was expected. Pairs that do not carry them give one line on standard error
/// and status kJobFailed, and no file.
[[nodiscard]] ExitStatus run_calibrate_links(const CalibrateLinksOptions& options);

}  // namespace tubesight::board
