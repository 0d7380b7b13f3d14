#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "board/box/stop_merger.h"
#include "hal/journal.h"

namespace tubesight::board {

/// A row of the journal that owns its texts and its picture.
struct JournalLine {
  hal::JournalKind kind = hal::JournalKind::kBoot;
  std::chrono::microseconds monotonic{0};  ///< since the machine's start
  std::string origin = "box";
  std::optional<std::int64_t> event_id;
  std::optional<core::TubeAddress> claimed;
  std::string verdict;
  std::string reason;
  hal::JournalSighting seen;  ///< but for its digest
  std::string digest;
  std::optional<std::chrono::microseconds> first;
  std::optional<std::chrono::microseconds> last;
  std::int64_t count = 1;
  std::string detail;
  std::string picture;  ///< JPEG; empty: none
};

/// One word `key=value` of a row's detail. What would not be one word, or no text, is escaped.
[[nodiscard]] std::string detail_word(std::string_view key, std::string_view value);

/// The row of what the tracking thread told. `shift`: from the fields' clock to the time since the
/// machine's start; `who`: the person who started, empty: it was none of the page's.
[[nodiscard]] JournalLine line_of(const JournalEntry& entry, core::FieldTime shift,
                                  const std::string& who);

}  // namespace tubesight::board
