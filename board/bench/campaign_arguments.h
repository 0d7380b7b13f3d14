#pragma once

#include "board/bench/campaign/campaign_options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace tubesight::board {

/// Adds `tubesight campaign` to the command line; what is given goes to `options`.
CLI::App* add_campaign(CLI::App& app, CampaignOptions& options);

}  // namespace tubesight::board
