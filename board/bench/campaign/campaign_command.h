#pragma once

#include <string>

#include "board/bench/campaign/campaign_options.h"
#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// `tubesight campaign`: runs random moves in memory, counts what the box says wrong, and keeps the
/// progress in a file; or merges such files, or plays and reduces one move.
///
/// `version` is the program's. Results go to standard output, messages to standard error.
[[nodiscard]] ExitStatus run_campaign(const CampaignOptions& options, const std::string& version);

}  // namespace tubesight::board
