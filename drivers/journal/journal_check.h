#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tubesight::drivers {

/// What a journal is compared with beside itself.
struct JournalCheckOptions {
  std::string key;            ///< the box's public key, 64 hexadecimal digits; empty: not known
  std::int64_t at_least = 0;  ///< rows that it must have: what the box told to be safe
};

/// Something that is wrong with one row, checkpoint or picture.
struct JournalProblem {
  std::int64_t number = 0;  ///< the row's
  std::string what;         ///< in words, beginning with "row 17: "
};

/// What a check has come to.
struct JournalCheck {
  std::int64_t rows = 0;
  std::int64_t last = 0;  ///< number of the last row
  std::string chain;      ///< of the last row
  std::int64_t checkpoints = 0;
  std::int64_t signed_through = 0;       ///< the last row that a good signature covers; 0: none
  std::string key;                       ///< that signed; empty: none
  std::int64_t pictures = 0;             ///< that are there, and looked at
  std::int64_t pictures_dropped = 0;     ///< of rows that had one: their digests alone are left
  std::int64_t wrong = 0;                ///< problems found
  std::vector<JournalProblem> problems;  ///< the first hundred of them
};

/// Checks the whole of a journal: the chain from row to row, the signatures of its checkpoints and
/// the pictures against their digests. It may be open elsewhere. A million rows take some seconds.
///
/// What no check can see in the file alone: rows cut off at its end together with the checkpoints
/// behind them. `at_least` is against that.
///
/// Errors: kIo the file cannot be read, kDataLoss it is no journal, or so damaged that its rows
/// cannot be read; `message` says why, in one line.
[[nodiscard]] core::Result<JournalCheck> check_journal(const std::string& path,
                                                       const JournalCheckOptions& options,
                                                       std::string& message);

}  // namespace tubesight::drivers
