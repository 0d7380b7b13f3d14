#pragma once

#include <memory>

#include "board/bench/campaign/counts.h"
#include "board/bench/campaign/move_judge.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board::campaign {

/// How a scenario is run.
struct RunOptions {
  /// False: the self-proof, played by the box of board/bench/self_proof. Its tracker rounds to the
  /// nearest tube without asking whether it can.
  bool margin_check = true;
  bool stop_at_wrong = false;  ///< ends with the first wrong tube vouched for
};

/// What came of a scenario.
struct MoveResult {
  bool runs = false;  ///< false: the scenario cannot be played or tracked; nothing else is valid
  Counts counts;
  std::int64_t first_wrong_field = -1;  ///< slot of the camera; -1: no wrong tube vouched for
  std::uint64_t digest = 0;             ///< of all that the box said
};

/// What of a world's truth a judge wants to know. `scenario`: what the box was told.
[[nodiscard]] FieldTruth judged_truth(const drivers::Scenario& scenario,
                                      const drivers::FieldTruth& field);

/// Runs scenarios in memory: simulated world, session in fixed point, judge. Some MB, kept from
/// scenario to scenario; one thread.
class MoveRunner {
 public:
  [[nodiscard]] MoveResult run(const drivers::Scenario& scenario, const RunOptions& options);

 private:
  template <typename Margin>
  [[nodiscard]] MoveResult play(const drivers::Scenario& scenario, bool stop_at_wrong);

  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

}  // namespace tubesight::board::campaign
