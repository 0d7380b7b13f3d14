#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "board/visionbox/box_report.h"

namespace tubesight::board {

// What the answers to `status` and to `self-test` say alike, for a person.

[[nodiscard]] std::string_view name_of(SourceState state);

[[nodiscard]] std::string rate_text(double per_s);

[[nodiscard]] bool there_is_link(const BoxReport& report);
/// Requests that came damaged, or in pieces, or found no room.
[[nodiscard]] std::uint32_t link_errors(const drivers::LinkCounters& counters);
[[nodiscard]] std::string link_text(const BoxReport& report);

/// Empty: none are written.
[[nodiscard]] std::string journal_text(const JournalReport& journal);
[[nodiscard]] std::string pairs_text(const PairsReport& pairs);

[[nodiscard]] bool there_is_recorder(const BoxReport& report);
[[nodiscard]] std::string recorder_text(const BoxReport& report);

/// What the picture shows of the lamp; empty where the box does not rule it.
[[nodiscard]] std::string picture_text(const TrackingStatus& tracking);

/// Who watches over the box.
[[nodiscard]] std::string watchdog_text(const SupervisionReport& watched);

[[nodiscard]] std::string latency_text(const LatencyHistogram& histogram);

}  // namespace tubesight::board
