#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "board/bench/campaign/move_run.h"
#include "board/bench/campaign/progress.h"
#include "board/bench/campaign/random_move.h"

namespace tubesight::board::campaign {

/// When a campaign ends, counted over all that its progress holds; zero: no such limit.
struct CampaignLimits {
  std::int64_t moves = 0;
  std::int64_t fields = 0;
  double hours = 0.0;  ///< of this run alone

  [[nodiscard]] bool reached(std::int64_t done_moves, std::int64_t done_fields,
                             std::chrono::nanoseconds for_so_long) const;
};

/// What a campaign runs.
struct CampaignPlan {
  std::uint64_t seed = 1;
  std::int64_t first_move = 0;
  CampaignLimits limits;
  std::int32_t jobs = 1;
  RunOptions run;
  DrawOptions draw;
};

/// A move in which the box vouched for a wrong tube.
struct WrongMove {
  std::uint64_t seed = 0;
  std::int64_t move = 0;
  std::int64_t field = 0;  ///< the first wrong one
};

/// What is told while a campaign runs; called by one thread at a time.
struct CampaignWatcher {
  std::function<void(const WrongMove&)> found_wrong;
  /// After every move; false ends the campaign (what is done stays).
  std::function<bool(const Progress&)> done_move;
};

/// Why moves could not be run; empty when all went well.
///
/// Runs moves from `plan.first_move` on that `progress` does not hold yet and adds them in their
/// order, whatever the number of jobs: the same moves leave the same counts.
[[nodiscard]] std::string run_campaign(const CampaignPlan& plan, Progress& progress,
                                       const CampaignWatcher& watcher);

/// Version and digest of the running program's file: only runs of the very same program are put
/// together. Where the file cannot be read, the digest of nothing.
[[nodiscard]] std::string box_identity(const std::string& version);

/// What is drawn, and how it is run.
[[nodiscard]] std::string configuration_name(const RunOptions& run, const DrawOptions& draw = {});

/// Whether a name of configuration_name() is that of a self-proof: without the margin check.
[[nodiscard]] bool is_self_proof(const std::string& configuration);

}  // namespace tubesight::board::campaign
