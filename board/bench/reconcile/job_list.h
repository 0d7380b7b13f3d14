#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "board/bench/reconcile/utc_time.h"
#include "core/base/tube_address.h"
#include "drivers/files/messages.h"

namespace tubesight::board {

/// The two ends of a tube stand in two sheets.
enum class Leg : std::uint8_t { kHot, kCold };
inline constexpr std::array<std::string_view, 2> kLegWords = {"hot", "cold"};

/// Something that was done, or is to be done, at one tube-end.
struct Job {
  std::int64_t line = 0;  ///< of the file
  std::string kind;       ///< "plug", "sleeve", "inspect": the plant's word
  Leg leg = Leg::kHot;
  core::TubeAddress tube;          ///< as that leg's sheet is numbered
  std::optional<UtcTime> done_at;  ///< empty: it is still to be done
};

/// Reads JOBS.csv: `job,leg,row,column,time_utc` (docs/journal.md). False, and a line in `messages`
/// for each bad row, which says where and what: nothing of the file is then to be used.
[[nodiscard]] bool read_jobs(std::string_view text, const std::string& name, std::vector<Job>& jobs,
                             drivers::Messages& messages);

}  // namespace tubesight::board
