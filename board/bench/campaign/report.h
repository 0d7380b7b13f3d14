#pragma once

#include <string>

#include "board/bench/campaign/progress.h"

namespace tubesight::board::campaign {

/// What a campaign found, for a person: totals with bounds, then a table by kind of fault, by the
/// other parts of a stratum, and what became of the strata.
[[nodiscard]] std::string report_text(const Progress& progress);

/// The same as CSV: one row for each group of report_groups(); docs/campaign.md has the columns.
[[nodiscard]] std::string report_csv(const Progress& progress);

}  // namespace tubesight::board::campaign
