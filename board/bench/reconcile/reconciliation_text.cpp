#include "board/bench/reconcile/reconciliation_text.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tubesight::board {
namespace {

/// Which entry at an end tells most: what is wrong, then what vouches, then the rest.
int weight(JobFinding finding) {
  switch (finding) {
    case JobFinding::kWrongTube: return 0;
    case JobFinding::kContradicted: return 1;
    case JobFinding::kVouched: return 2;
    case JobFinding::kNotVouched: return 3;
    case JobFinding::kNotDone: break;
  }
  return 4;
}

const JudgedJob* telling(const std::vector<JudgedJob>& end) {
  const auto at =
      std::min_element(end.begin(), end.end(), [](const JudgedJob& one, const JudgedJob& other) {
        return weight(one.finding) < weight(other.finding);
      });
  return at == end.end() ? nullptr : &*at;
}

std::string address_text(const core::TubeAddress& tube) {
  return "(" + std::to_string(tube.row) + ", " + std::to_string(tube.column) + ")";
}

std::string cells(const std::optional<core::TubeAddress>& tube) {
  return tube ? std::to_string(tube->row) + "," + std::to_string(tube->column) : ",";
}

std::string words_of(const JudgedJob& judged) {
  const std::string when = judged.job.done_at ? " at " + utc_text(*judged.job.done_at) : "";
  const std::string row =
      judged.row > 0 ? ", row " + std::to_string(judged.row) + " of the journal" : "";
  const std::string seen = judged.seen ? address_text(*judged.seen) : "another tube";
  switch (judged.finding) {
    case JobFinding::kVouched: return "done" + when + ", vouched for" + row;
    case JobFinding::kWrongTube: return "done" + when + " UNDER " + seen + row;
    case JobFinding::kContradicted:
      return "done" + when + " although the box had seen " + seen + row;
    case JobFinding::kNotVouched: return "done" + when + ", not vouched for" + row;
    case JobFinding::kNotDone: break;
  }
  return "to be done";
}

void append_end(std::string& text, std::string_view leg, const std::vector<JudgedJob>& end) {
  if (end.empty()) {
    text += "    " + std::string(leg) + " end: nothing\n";
  }
  for (const JudgedJob& judged : end) {
    text += "    " + std::string(leg) + " end " + address_text(judged.job.tube) + ": " +
            words_of(judged) + " (line " + std::to_string(judged.job.line) + ")\n";
  }
}

}  // namespace

std::string_view name_of(TubeFinding finding) {
  constexpr std::array<std::string_view, 6> kWords = {"wrong-end", "contradicted", "one-end",
                                                      "open",      "not-vouched",  "closed"};
  return kWords[static_cast<std::size_t>(finding)];
}

std::string_view name_of(JobFinding finding) {
  constexpr std::array<std::string_view, 5> kWords = {"vouched", "wrong-tube", "contradicted",
                                                      "not-vouched", "not-done"};
  return kWords[static_cast<std::size_t>(finding)];
}

std::string reconciliation_text(std::span<const ReconciledTube> tubes) {
  std::string text;
  std::array<int, 6> counts{};
  for (const ReconciledTube& tube : tubes) {
    ++counts[static_cast<std::size_t>(tube.finding)];
    if (tube.finding == TubeFinding::kClosed) {
      continue;
    }
    text += std::string(name_of(tube.finding)) + ": " + tube.kind + " of tube " +
            address_text(tube.tube) + '\n';
    for (std::size_t leg = 0; leg < kLegWords.size(); ++leg) {
      append_end(text, kLegWords[leg], tube.ends[leg]);
    }
    if (tube.other_half) {
      text += "    tube " + address_text(*tube.other_half) +
              " has it at the other end alone: one of the two was perhaps meant for the other\n";
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    text += std::string(i > 0 ? ", " : "") + std::to_string(counts[i]) + ' ' +
            std::string(name_of(static_cast<TubeFinding>(i)));
  }
  return text + '\n';
}

std::string reconciliation_rows(std::span<const ReconciledTube> tubes) {
  std::string text;
  for (const ReconciledTube& tube : tubes) {
    text += tube.kind + ',' + cells(tube.tube) + ',' + std::string(name_of(tube.finding));
    for (const std::vector<JudgedJob>& end : tube.ends) {
      const JudgedJob* const judged = telling(end);
      if (judged == nullptr) {
        text += ",,,,,";
        continue;
      }
      text += ',' + std::string(name_of(judged->finding)) + ',';
      text += judged->job.done_at ? utc_text(*judged->job.done_at) : "";
      text += ',' + cells(judged->seen) + ',';
      text += judged->row > 0 ? std::to_string(judged->row) : "";
    }
    text += ',' + cells(tube.other_half) + '\n';
  }
  return text;
}

}  // namespace tubesight::board
