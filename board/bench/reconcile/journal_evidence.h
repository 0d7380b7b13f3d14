#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "board/bench/reconcile/reconciliation.h"
#include "board/bench/reconcile/utc_time.h"
#include "drivers/journal/journal_reader.h"

namespace tubesight::board {

/// When, by the wall clock, it was `monotonic_us` in the boot of a row; empty where the row does
/// not tell. The wall clock's doubt is not in it.
[[nodiscard]] std::optional<UtcTime> wall_time(const drivers::JournalEntry& entry,
                                               std::optional<std::int64_t> monotonic_us);

/// Gathers what the rows of a journal, in their order, say of stretches of time.
///
/// A row whose wall clock is in unknown doubt lies somewhere between the last row before it and the
/// first one behind it whose time is known. Of one boot rows are put in the order of what they tell
/// of: a row of several claims is written when the last of them came.
class JournalEvidence {
 public:
  /// `assumed_doubt`: by which the wall clock may have been off where a row does not know it;
  /// empty: nobody knows.
  explicit JournalEvidence(std::optional<std::chrono::milliseconds> assumed_doubt = {})
      : assumed_doubt_(assumed_doubt) {}

  void add(const drivers::JournalEntry& entry);

  /// All of it, once. Rows behind `trusted_through` accuse and do not vouch; 0: none vouches.
  [[nodiscard]] std::vector<Evidence> take(std::int64_t trusted_through);

 private:
  /// Between which instants a row was made, and what it says.
  struct Noted {
    UtcTime earliest;
    UtcTime latest;
    bool time_known = false;
    bool boots = false;  ///< the first row of a boot
    bool tells = false;  ///< where the tool is, or that it is not known any more
    std::chrono::milliseconds first_ago{0};  ///< before the row was made
    std::chrono::milliseconds last_ago{0};
    Evidence evidence;  ///< but for its times
  };

  void bound_unknown_times();
  static void set_times(Noted& noted);

  std::optional<std::chrono::milliseconds> assumed_doubt_;
  std::vector<Noted> noted_;
  std::string boot_id_;
};

}  // namespace tubesight::board
