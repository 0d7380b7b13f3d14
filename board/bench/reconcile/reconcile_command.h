#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight journal reconcile`.
struct ReconcileOptions {
  std::string hot;                           ///< journal of the hot leg
  std::string cold;                          ///< and of the cold one
  std::string hot_key;                       ///< files of the boxes' public keys; empty: not known
  std::string cold_key;                      ///<
  std::string jobs;                          ///< JOBS.csv
  std::string csv;                           ///< empty: not wanted
  std::optional<std::int32_t> mirrored_sum;  ///< LegNumbering's, of the cold leg
  double hold_s = 10.0;  ///< how long behind its last confirmation a tube-end is vouched for
  std::optional<double> clock_doubt_s;  ///< of a wall clock whose doubt a row does not know
  bool accept_unsigned = false;         ///< rows that no signature covers vouch, too
  bool accept_broken = false;           ///< so do journals that are not what was written
};

/// Puts both ends of each tube together and tells what is wrong or open, the worst first. kDone:
/// every job is closed; kJobFailed: one is not (the table is written all the same).
///
/// Unless it is asked for, a journal that is broken closes nothing, nor do rows that no signature
/// covers; they accuse all the same.
[[nodiscard]] ExitStatus run_reconcile(const ReconcileOptions& options);

}  // namespace tubesight::board
