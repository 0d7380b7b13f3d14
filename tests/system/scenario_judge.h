#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "core/base/sighting.h"
#include "drivers/scenario/scenario_file.h"

namespace tubesight::tests {

/// What the box made of a scenario, judged against the truth by the rules of the recordings' score.
struct ScenarioVerdict {
  bool played = false;  ///< the session took the settings and the world the scenario
  std::int64_t fields = 0;
  std::int64_t answered = 0;       ///< tracking or degraded
  std::int64_t truly_aligned = 0;  ///< at least 0.3 mm within the gate, and a tube stands there
  std::int64_t missed = 0;         ///< of these, not vouched for
  std::int64_t wrong_tube = 0;     ///< vouched for, and another tube or none is there
  std::int64_t false_aligned = 0;  ///< vouched for more than 0.3 mm outside the gate
  std::int64_t wrong_nearest = 0;  ///< named wrongly, 1.5 mm clear of half the pitch
  std::int64_t undetectable = 0;   ///< another tube named, off by just the silent jumps' steps
  std::int64_t claims = 0;
  std::int64_t contradicted = 0;
  std::int64_t confirmed = 0;
  std::set<std::pair<std::int32_t, std::int32_t>> tubes;  ///< rightly vouched for: row, column
  std::set<core::Reason> lost;
  std::set<core::Reason> degraded;
  core::TrackState end = core::TrackState::kWaiting;

  [[nodiscard]] double answered_share() const;
  [[nodiscard]] double missed_share() const;
  /// All of it in a line, for messages.
  [[nodiscard]] std::string text() const;
};

/// Plays a scenario in memory through the session in fixed point.
[[nodiscard]] ScenarioVerdict judge_scenario(const drivers::ScenarioFile& file);

}  // namespace tubesight::tests
