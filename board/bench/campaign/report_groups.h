#pragma once

#include <string>
#include <vector>

#include "board/bench/campaign/progress.h"

namespace tubesight::board::campaign {

/// Moves that are told of together.
struct ReportGroup {
  std::string name;  ///< "all", "within_motion", "clear", "fault=stream", or a stratum's name
  Counts counts;
};

/// All moves; "within_motion", those without jumps, and "within_motion steady", without vibration
/// and knocks too; "clear", those without faults; one group for each word of a stratum's name; the
/// strata themselves when `with_strata`.
[[nodiscard]] std::vector<ReportGroup> report_groups(const Progress& progress, bool with_strata);

}  // namespace tubesight::board::campaign
