#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "board/bench/campaign/campaign_run.h"
#include "board/bench/campaign/lamp_run.h"

namespace tubesight::board::campaign {

/// What came of a campaign of lamps.
struct LampProgress {
  std::uint64_t seed = 1;
  std::int64_t first = 0;
  std::int64_t end = 0;  ///< behind the last run
  std::array<LampCounts, static_cast<std::size_t>(kLampKinds)> kinds{};

  [[nodiscard]] LampCounts total() const;
};

/// A run in which the box vouched for a wrong tube, called a sound lamp faulty, or left a fault
/// without its name.
struct LampFinding {
  std::int64_t run = 0;
  std::int32_t kind = 0;
  std::string what;
};

/// What is told meanwhile; called by one thread at a time.
struct LampWatcher {
  std::function<void(const LampFinding&)> found;
  std::function<void(const LampProgress&)> done_run;
};

/// Why runs could not be made; empty when all went well. From `plan.first_move` on, in their order,
/// whatever the number of jobs; of `plan.run` nothing counts.
[[nodiscard]] std::string run_lamp_campaign(const CampaignPlan& plan, LampProgress& progress,
                                            const LampWatcher& watcher);

/// For a person; `box` says which.
[[nodiscard]] std::string lamp_report_text(const LampProgress& progress, const std::string& box);

/// A row a kind, and one of all.
[[nodiscard]] std::string lamp_report_csv(const LampProgress& progress);

}  // namespace tubesight::board::campaign
