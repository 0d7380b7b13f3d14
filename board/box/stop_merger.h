#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "board/box/journal_note.h"

namespace tubesight::board {

/// A row of the journal to be, still without its texts.
struct JournalEntry {
  enum class Part : std::uint8_t {
    kFirst,  ///< the first claim of a stop
    kOn,     ///< the stop goes on
    kEnd,    ///< it is over
  };

  JournalNote note;          ///< of claims that are one row, the last
  std::int64_t stop = 0;     ///< of a claim: number of its stop, from 1
  Part part = Part::kFirst;  ///< of a claim
  core::FieldTime first{0};  ///< of a claim: the stop's first one
  core::FieldTime last{0};   ///< of a claim: the last one told by this row
  std::int64_t count = 1;    ///< claims that no row before has told
};

/// Makes rows of notes: equal claims with equal answers during one stop are one row at once and one
/// at its end (docs/journal.md says when a stop ends, and why two).
///
/// Of the thread that writes the journal. Times are of the fields' clock.
class StopMerger {
 public:
  static constexpr core::FieldTime kSilence = std::chrono::seconds(10);
  static constexpr core::FieldTime kTellEvery = std::chrono::minutes(1);

  /// Takes the next note and appends what it brings about, in the order of the journal's rows.
  void take(const JournalNote& note, std::vector<JournalEntry>& rows);

  /// Ends a stop whose last claim is kSilence ago. To be called now and then.
  void look(core::FieldTime now, std::vector<JournalEntry>& rows);

  /// Ends the stop: with the program.
  void end(std::vector<JournalEntry>& rows);

 private:
  void take_claim(const JournalNote& note, std::vector<JournalEntry>& rows);
  void tell(JournalEntry::Part part, std::vector<JournalEntry>& rows);

  std::optional<JournalNote> last_;  ///< the stop's last claim; empty: no stop
  core::FieldTime first_{0};
  core::FieldTime told_{0};  ///< when a row of it was made last
  std::int64_t untold_ = 0;  ///< claims since then
  std::int64_t stop_ = 0;
};

}  // namespace tubesight::board
