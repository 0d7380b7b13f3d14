#pragma once

#include <cstdint>
#include <string>

#include "board/bench/output/exit_status.h"
#include "board/bench/reconcile/reconcile_command.h"

namespace tubesight::board {

/// The arguments of `tubesight journal`.
struct JournalOptions {
  std::string action;  ///< "check", "export", "copy" or "reconcile"
  std::string journal;
  std::string other;  ///< where a copy goes, or the cold leg's journal; empty: none was named
  std::string key;    ///< file of the box's public key; empty: not known
  std::int64_t at_least = 0;   ///< rows that must be there
  std::string csv;             ///< empty: not wanted
  std::string json_lines;      ///< empty: not wanted
  ReconcileOptions reconcile;  ///< what it alone has
};

/// Runs `tubesight journal`. A check that finds something ends with kJobFailed and tells each row
/// by its number; what is no journal is kWrongInput. The journal itself is never changed.
[[nodiscard]] ExitStatus run_journal(const JournalOptions& options);

}  // namespace tubesight::board
