#include "tests/system/mission_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace tubesight::tests {
namespace {

/// A read that took longer tells too little of its moment.
constexpr std::int64_t kTight_us = 2000;
constexpr std::int32_t kSightingBit = 1;

bool parse_tube(const std::string& text, core::TubeAddress& tube) {
  return std::sscanf(text.c_str(), "%d,%d", &tube.row, &tube.column) == 2;
}

}  // namespace

MissionLog::MissionLog(const std::string& text, double span_us) : span_us_(span_us) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    take(line);
  }
  mark_fields();
}

void MissionLog::take(const std::string& line) {
  std::istringstream words(line);
  std::string kind;
  std::string tube;
  words >> kind;
  if (kind == "P") {
    MissionPoll poll;
    words >> poll.sent_us >> poll.received_us >> poll.valid >> poll.field >> poll.age_ms >> tube >>
        poll.aligned >> poll.state;
    polls_.push_back(poll);
  } else if (kind == "C") {
    MissionClaim claim;
    std::int32_t verdict = 0;
    std::string seen;
    words >> claim.sent_us >> claim.taken_us >> claim.received_us >> claim.age_ms >> tube >>
        verdict >> claim.reason >> seen >> claim.field;
    claim.verdict = static_cast<MissionVerdict>(verdict);
    claim.named = parse_tube(seen, claim.seen);
    if (!parse_tube(tube, claim.tube)) {
      words.setstate(std::ios::failbit);
    }
    claims_.push_back(claim);
  } else if (kind == "R") {
    MissionRestart restart;
    words >> restart.at_us >> restart.field >> tube >> restart.refused;
    if (!parse_tube(tube, restart.tube)) {
      words.setstate(std::ios::failbit);
    }
    restarts_.push_back(restart);
  } else if (kind == "H") {
    words >> health_.fields >> health_.missing >> health_.late >> health_.requests >>
        health_.exceptions >> health_.crc_errors >> health_.late_claims >> health_.worst_us >>
        health_.claim_worst_us;
  } else {
    words.setstate(std::ios::failbit);
  }
  if (words.fail()) {
    strange_ += line + "\n";
  }
}

void MissionLog::mark_fields() {
  for (const MissionPoll& poll : polls_) {
    if ((poll.valid & kSightingBit) != 0 && poll.received_us - poll.sent_us <= kTight_us) {
      const auto middle = static_cast<double>(poll.sent_us + poll.received_us) / 2.0;
      marks_.push_back({poll.field, middle - 1000.0 * static_cast<double>(poll.age_ms)});
    }
  }
  if (marks_.empty()) {
    strange_ += "no read of the sighting tells when a field was exposed\n";
    marks_.push_back({});
  }
}

std::size_t MissionLog::restarts_taken() const {
  return static_cast<std::size_t>(
      std::count_if(restarts_.begin(), restarts_.end(),
                    [](const MissionRestart& restart) { return restart.refused == 0; }));
}

std::size_t MissionLog::polls_while_lost() const {
  constexpr std::int32_t kWaiting = 1;
  constexpr std::int32_t kLost = 4;
  return static_cast<std::size_t>(std::count_if(
      polls_.begin(), polls_.end(),
      [](const MissionPoll& poll) { return poll.state == kLost || poll.state == kWaiting; }));
}

double MissionLog::exposed_us(std::int64_t number) const {
  auto near = std::lower_bound(marks_.begin(), marks_.end(), number,
                               [](const Mark& mark, std::int64_t n) { return mark.number < n; });
  if (near == marks_.end() ||
      (near != marks_.begin() && number - std::prev(near)->number < near->number - number)) {
    --near;
  }
  return near->at_us + static_cast<double>(number - near->number) * span_us_;
}

std::int64_t MissionLog::slot_at(double instant_us) const {
  // Numbers are the source's slots as long as no field was missed, as at the first reads.
  const Mark& first = marks_.front();
  const double zero_us = first.at_us - static_cast<double>(first.number) * span_us_;
  return std::llround((instant_us - zero_us) / span_us_);
}

}  // namespace tubesight::tests
