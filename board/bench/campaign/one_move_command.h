#pragma once

#include "board/bench/campaign/campaign_options.h"
#include "board/bench/output/exit_status.h"

namespace tubesight::board::campaign {

/// `tubesight campaign --replay-move`: runs one move, says what came of it and writes it as a
/// scenario file, on request without what its wrong tube does not need.
[[nodiscard]] ExitStatus run_one_move(const CampaignOptions& options);

}  // namespace tubesight::board::campaign
