#include "board/visionbox/journal_faults.h"

namespace tubesight::board {

void JournalFaults::look(const BoxReport& report) {
  if (!report.self_test_finished) {
    return;
  }
  struct Condition {
    bool there = false;
    bool bad = false;
    std::string words;
  };
  std::map<std::string_view, Condition> parts;
  for (const SelfTestRow& row : self_test(report)) {
    const bool camera = row.bit == drivers::SelfTestBit::kCamera;
    if (!camera && row.bit != drivers::SelfTestBit::kLamp) {
      continue;
    }
    Condition& part = parts[camera ? "camera" : "lamp"];
    part.there = true;
    if (row.verdict == SelfTestRow::Verdict::kBad || part.words.empty()) {
      part.words = row.words;
    }
    part.bad = part.bad || row.verdict == SelfTestRow::Verdict::kBad;
  }
  for (const auto& [name, part] : parts) {
    look(name, part.bad, part.words);
  }
}

void JournalFaults::look(std::string_view part, bool bad, const std::string& words) {
  const auto [known, first] = bad_.try_emplace(std::string(part), false);
  if (known->second == bad) {
    return;
  }
  known->second = bad;
  JournalLine line;
  line.kind = hal::JournalKind::kFault;
  line.detail = detail_word("part", part) + (bad ? " what=begun " : " what=over ") +
                detail_word("words", words);
  add_(std::move(line));
}

}  // namespace tubesight::board
