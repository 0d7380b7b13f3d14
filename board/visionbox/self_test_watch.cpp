#include "board/visionbox/self_test_watch.h"

#include <chrono>
#include <cstdint>

namespace tubesight::board {
namespace {

using Verdict = SelfTestRow::Verdict;

constexpr MonotonicTime kLookEvery = std::chrono::seconds(1);
constexpr std::int32_t kAllBits =
    (2 << static_cast<std::int32_t>(drivers::SelfTestBit::kJournal)) - 1;

bool pattern_is_to_come(const BoxReport& report) {
  return report.pattern_wanted && report.tracking.sighting.liveness == core::Liveness::kUnknown;
}

}  // namespace

void SelfTestWatch::look(const BoxReport& report) {
  if (report.up < next_) {
    return;
  }
  next_ = report.up + kLookEvery;
  const std::vector<SelfTestRow> rows = self_test(report);
  if (!finished_) {
    finished_ = report.up >= kLongest || (bad_rows(rows).empty() && !pattern_is_to_come(report));
    if (finished_) {
      tell_end(rows);
    }
  }
  std::int32_t good = 0;
  std::int32_t bad = 0;
  for (const SelfTestRow& row : rows) {
    const std::int32_t bit = 1 << static_cast<std::int32_t>(row.bit);
    good |= row.verdict == Verdict::kGood ? bit : 0;
    bad |= row.verdict == Verdict::kBad ? bit : 0;
  }
  told_.verdict = !finished_ ? drivers::Health::kUnknown
                  : bad == 0 ? drivers::Health::kWell
                             : drivers::Health::kFailed;
  told_.bad = static_cast<std::uint16_t>(bad);
  told_.absent = static_cast<std::uint16_t>(kAllBits & ~(good | bad));
  told_.boot = report.boots.boot;
  told_.start = report.boots.start;
  told_.up_s = std::chrono::duration_cast<std::chrono::seconds>(report.up).count();
}

void SelfTestWatch::tell_end(const std::vector<SelfTestRow>& rows) {
  std::string text;
  for (const SelfTestRow& row : rows) {
    if (row.verdict == Verdict::kBad) {
      text += (text.empty() ? "" : "; ") + std::string(row.what) + ": " + row.words;
    }
  }
  tell_(text.empty() ? "self-test: nothing is bad" : "self-test: bad: " + text);
}

}  // namespace tubesight::board
