#include "board/bench/campaign_arguments.h"

#include <cstdint>

#include <CLI/CLI.hpp>

#include "board/bench/number_range.h"

namespace tubesight::board {

CLI::App* add_campaign(CLI::App& app, CampaignOptions& options) {
  CLI::App* const campaign = app.add_subcommand(
      "campaign", "Random plants, cameras, paths and faults: counts what the box says wrong");
  constexpr std::int64_t kMost = std::int64_t{1} << 53U;
  const CLI::Range positive(std::int64_t{1}, kMost);
  const CLI::Range natural(std::int64_t{0}, kMost);
  campaign->add_option("--moves", options.moves, "Run until N moves are done, those resumed too")
      ->option_text("N")
      ->check(positive);
  campaign->add_option("--fields", options.fields, "Run until the box has seen N fields")
      ->option_text("N")
      ->check(positive);
  campaign->add_option("--hours", options.hours, "Run for H hours")
      ->option_text("H")
      ->check(number_between(1e-6, 1e5));
  campaign
      ->add_option("--seed", options.seed,
                   "Seed of all that is drawn; default 1, or that of --resume")
      ->option_text("S")
      ->check(natural);
  campaign
      ->add_option("--first-move", options.first_move,
                   "Number of the first move; default 0, or the first of --resume")
      ->option_text("M")
      ->check(natural);
  campaign->add_option("--jobs", options.jobs, "Moves run at a time; default 1")
      ->option_text("J")
      ->check(CLI::Range(1, 1024));
  campaign
      ->add_option("--resume", options.resume,
                   "Progress file (CSV): continued when it is there, kept up to date")
      ->option_text("FILE");
  campaign->add_option("--report", options.report, "Write counts and bounds of every stratum (CSV)")
      ->option_text("FILE");
  campaign->add_option("--merge", options.merge, "Put progress files together, and report")
      ->option_text("FILE...");
  campaign
      ->add_option("--replay-move", options.one_move,
                   "Run one move and write it as a scenario for tubesight simulate")
      ->option_text("SEED:MOVE");
  campaign
      ->add_option("--out", options.out,
                   "Where the scenario goes; with --merge: the merged progress file")
      ->option_text("FILE");
  campaign->add_flag("--lamps", options.lamps,
                     "In place of moves: runs of a box that rules its lamp, and what goes wrong");
  campaign->add_flag("--sizes", options.sizes,
                     "Pictures of 320x240 to 1920x1200, in fields and whole, 50 to 120 a second");
  campaign->add_flag("--reduce", options.reduce,
                     "With --replay-move: first leave out all that its wrong tube does not need");
  campaign->add_flag("--without-margin-check", options.without_margin_check,
                     "Self-proof: the box rounds to the nearest tube, and must be found out");
  return campaign;
}

}  // namespace tubesight::board
