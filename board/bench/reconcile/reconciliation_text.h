#pragma once

#include <span>
#include <string>
#include <string_view>

#include "board/bench/reconcile/reconciliation.h"

namespace tubesight::board {

/// First line of `journal reconcile --csv`, without the line feed.
inline constexpr std::string_view kReconciledHeader =
    "job,row,column,finding,hot,hot_time_utc,hot_seen_row,hot_seen_column,hot_journal_row,cold,"
    "cold_time_utc,cold_seen_row,cold_seen_column,cold_journal_row,other_half_row,"
    "other_half_column";

/// The words of the tables' columns `finding`, and `hot` and `cold`.
[[nodiscard]] std::string_view name_of(TubeFinding finding);
[[nodiscard]] std::string_view name_of(JobFinding finding);

/// For a person: what is wrong or open, one by one, then how many are closed.
[[nodiscard]] std::string reconciliation_text(std::span<const ReconciledTube> tubes);

/// One row a job and tube, in the order given. Of several entries at an end the worst is told.
[[nodiscard]] std::string reconciliation_rows(std::span<const ReconciledTube> tubes);

}  // namespace tubesight::board
