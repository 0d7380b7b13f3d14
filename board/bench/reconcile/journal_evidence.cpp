#include "board/bench/reconcile/journal_evidence.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace tubesight::board {
namespace {

using drivers::JournalEntry;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// What a journal's clock can say: docs/journal.md counts from 1970, and no text goes beyond 9999.
constexpr UtcTime kEarliest{};
constexpr UtcTime kLatest = std::chrono::sys_days(std::chrono::year(9999) / 12 / 31);

milliseconds rounded_up(std::int64_t time_us) {
  return std::chrono::ceil<milliseconds>(microseconds(time_us));
}

std::optional<Evidence::Kind> kind_of_claim(const JournalEntry& entry) {
  if (!entry.claimed) {
    return Evidence::Kind::kUnknown;
  }
  if (entry.verdict == "confirmed") {
    // It says itself which tube it saw; a row that contradicts itself vouches for nothing.
    return entry.tube == entry.claimed ? Evidence::Kind::kConfirmed : Evidence::Kind::kUnknown;
  }
  return entry.verdict == "contradicted" ? Evidence::Kind::kContradicted : Evidence::Kind::kUnknown;
}

/// Empty: the row says nothing of where the tool is.
std::optional<Evidence::Kind> kind_of(const JournalEntry& entry) {
  const std::string_view kind = entry.kind;
  if (kind == "verification") {
    return kind_of_claim(entry);
  }
  if (kind == "pose" || kind == "acknowledgement" ||
      (kind == "start" && entry.verdict == "refused")) {
    return {};
  }
  // Also of what nobody has thought of yet: what was confirmed before does not hold behind it.
  return Evidence::Kind::kBroken;
}

/// How long before a row was made something was; nothing where the row does not say.
milliseconds age(const JournalEntry& entry, const std::optional<std::int64_t>& at_us) {
  if (!at_us || !entry.monotonic_us || *at_us > *entry.monotonic_us) {
    return milliseconds(0);
  }
  return std::chrono::floor<milliseconds>(microseconds(*entry.monotonic_us - *at_us));
}

Evidence bare_evidence(const JournalEntry& entry, Evidence::Kind kind) {
  Evidence evidence;
  evidence.kind = kind;
  evidence.claimed = entry.claimed.value_or(core::TubeAddress());
  evidence.tube = entry.tube.value_or(evidence.claimed);
  evidence.tube_known = entry.tube.has_value();
  evidence.row = entry.number;
  return evidence;
}

}  // namespace

std::optional<UtcTime> wall_time(const JournalEntry& entry,
                                 std::optional<std::int64_t> monotonic_us) {
  if (!entry.wall_us || !entry.monotonic_us || !monotonic_us) {
    return {};
  }
  const UtcTime time{std::chrono::floor<milliseconds>(
      microseconds(*entry.wall_us - *entry.monotonic_us + *monotonic_us))};
  return time >= kEarliest && time < kLatest ? std::optional(time) : std::nullopt;
}

void JournalEvidence::add(const JournalEntry& entry) {
  Noted noted;
  noted.boots = noted_.empty() || entry.boot_id != boot_id_;
  boot_id_ = entry.boot_id;
  const auto made = wall_time(entry, entry.monotonic_us);
  const std::optional<milliseconds> told =
      entry.wall_doubt_us ? std::optional(rounded_up(*entry.wall_doubt_us)) : assumed_doubt_;
  noted.time_known = made.has_value() && told.has_value();
  if (noted.time_known) {
    // A millisecond more: what is finer was cut off.
    const milliseconds doubt = *told + milliseconds(1);
    noted.earliest = *made - doubt;
    noted.latest = *made + doubt;
  }
  noted.first_ago = age(entry, entry.first_us);
  noted.last_ago = age(entry, entry.last_us);
  const auto kind = kind_of(entry);
  noted.tells = kind.has_value();
  noted.evidence = bare_evidence(entry, kind.value_or(Evidence::Kind::kUnknown));
  noted_.push_back(noted);
}

void JournalEvidence::bound_unknown_times() {
  UtcTime earliest = kEarliest;
  for (Noted& noted : noted_) {
    if (!noted.time_known) {
      noted.earliest = earliest;
    }
    earliest = noted.earliest;
  }
  UtcTime latest = kLatest;
  for (auto noted = noted_.rbegin(); noted != noted_.rend(); ++noted) {
    if (!noted->time_known) {
      noted->latest = std::max(latest, noted->earliest);
    }
    latest = noted->latest;
  }
}

void JournalEvidence::set_times(Noted& noted) {
  const milliseconds width = noted.latest - noted.earliest;
  const UtcTime middle = noted.earliest + width / 2;
  noted.evidence.doubt = width - width / 2;
  noted.evidence.last = middle - noted.last_ago;
  noted.evidence.first = std::min(middle - noted.first_ago, noted.evidence.last);
}

std::vector<Evidence> JournalEvidence::take(std::int64_t trusted_through) {
  bound_unknown_times();
  std::vector<Evidence> all;
  std::size_t boot = 0;
  const auto put_boot_in_order = [&] {
    std::stable_sort(
        all.begin() + static_cast<std::ptrdiff_t>(boot), all.end(),
        [](const Evidence& one, const Evidence& other) { return one.first < other.first; });
    boot = all.size();
  };
  const Noted* before = nullptr;
  for (Noted& noted : noted_) {
    // Where known and unknown times meet, their middles do not tell which was first.
    if (noted.boots || (before != nullptr && before->time_known != noted.time_known)) {
      put_boot_in_order();
    }
    before = &noted;
    if (noted.tells) {
      set_times(noted);
      noted.evidence.trusted = noted.evidence.row <= trusted_through;
      all.push_back(noted.evidence);
    }
  }
  put_boot_in_order();
  noted_.clear();
  return all;
}

}  // namespace tubesight::board
