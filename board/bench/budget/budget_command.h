#pragma once

#include <cstdint>
#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight budget`.
struct BudgetOptions {
  std::string settings;
  std::int32_t robots = 100;
  std::int64_t seed = 1;
  double height_mm = 40.0;
  std::string plot;
};

/// `tubesight budget`: what each calibrated quantity and each assumption adds to the error of the
/// tool's position, by vision and by the kinematic chain; then the source's four ways to calibrate
/// a base [Fallon fig. 5.20, 5.21] on simulated robots, and how the error grows with that of a
/// touch.
///
/// Tables go to standard output, the curves to `plot`.
[[nodiscard]] ExitStatus run_budget(const BudgetOptions& options);

}  // namespace tubesight::board
