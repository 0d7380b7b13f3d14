#pragma once

#include <cstdint>
#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight journal`.
struct JournalOptions {
  std::string action;  ///< "check", "export" or "copy"
  std::string journal;
  std::string copy;           ///< where a copy goes; empty: none was named
  std::string key;            ///< file of the box's public key; empty: not known
  std::int64_t at_least = 0;  ///< rows that must be there
  std::string csv;            ///< empty: not wanted
  std::string json_lines;     ///< empty: not wanted
};

/// Runs `tubesight journal`. A check that finds something ends with kJobFailed and tells each row
/// by its number; what is no journal is kWrongInput. The journal itself is never changed.
[[nodiscard]] ExitStatus run_journal(const JournalOptions& options);

}  // namespace tubesight::board
