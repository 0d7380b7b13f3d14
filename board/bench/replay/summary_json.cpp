#include "board/bench/replay/summary_json.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/names.h"
#include "core/base/words.h"
#include "drivers/control/json_line.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::FieldTime;
using core::Reason;
using core::TrackState;
using drivers::append_decimal;
using drivers::json_string;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::string seconds(FieldTime time) {
  std::string text;
  append_decimal(text, std::chrono::nanoseconds(time).count(), kSecond_ns, 6);
  return text;
}

std::string whole(std::int64_t value) { return std::to_string(value); }

std::string address(core::TubeAddress tube) {
  return "[" + whole(tube.row) + ", " + whole(tube.column) + "]";
}

using Members = std::vector<std::pair<std::string_view, std::string>>;

std::string object(const Members& members) {
  std::string out = "{";
  for (const auto& [key, value] : members) {
    out += (out.size() > 1 ? ", " : "") + json_string(key) + ": " + value;
  }
  return out + "}";
}

/// A list with an entry a line.
std::string list(const std::vector<std::string>& entries) {
  std::string out = "[";
  for (const std::string& entry : entries) {
    out += (out.size() > 1 ? ",\n    " : "\n    ") + entry;
  }
  return out + (entries.empty() ? "]" : "\n  ]");
}

std::string share(const Share& share) {
  return object({{"fields", whole(share.fields)}, {"time_s", seconds(share.time)}});
}

std::string states(const ReplayStatistics& statistics) {
  constexpr std::array kOrder = {TrackState::kTracking, TrackState::kDegraded, TrackState::kLost,
                                 TrackState::kWaiting};
  Members members;
  for (const TrackState state : kOrder) {
    members.emplace_back(core::name_of(state), share(statistics.state(state)));
  }
  return object(members);
}

std::string degraded(const ReplayStatistics& statistics) {
  Members members;
  for (std::size_t i = 0; i < ReplayStatistics::kReasons; ++i) {
    const auto reason = static_cast<Reason>(i);
    if (statistics.degraded(reason).fields > 0) {
      members.emplace_back(core::name_of(reason), share(statistics.degraded(reason)));
    }
  }
  return object(members);
}

std::string starts(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const auto& start : statistics.starts()) {
    const bool taken = start.reply.refusal == core::StartRefusal::kNone;
    entries.push_back(
        object({{"at_s", seconds(start.at)},
                {"taken", taken ? "true" : "false"},
                {"reason", taken ? "null" : json_string(core::name_of(start.reply.refusal))}}));
  }
  return list(entries);
}

std::string losses(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const auto& loss : statistics.losses()) {
    entries.push_back(object({{"at_s", seconds(loss.at)},
                              {"lasted_s", seconds(loss.lasted)},
                              {"reason", json_string(core::name_of(loss.reason))}}));
  }
  return list(entries);
}

std::string contradictions(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const auto& contradiction : statistics.contradictions()) {
    entries.push_back(object({{"at_s", seconds(contradiction.at)},
                              {"claimed", address(contradiction.claimed)},
                              {"seen", address(contradiction.seen)}}));
  }
  return list(entries);
}

std::string poses(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const auto& pose : statistics.poses()) {
    const bool good = pose.result.reason == core::PoseReason::kNone;
    entries.push_back(
        object({{"at_s", seconds(pose.at)},
                {"reason", good ? "null" : json_string(core::name_of(pose.result.reason))},
                {"contradicted", pose.contradicted ? "true" : "false"}}));
  }
  return list(entries);
}

std::string plugs(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const core::TubeAddress& plug : statistics.plugs()) {
    entries.push_back(address(plug));
  }
  return list(entries);
}

std::string mean_mm(std::int64_t sum_um_q8, std::int64_t fields) {
  constexpr std::int64_t kPerMm = 256 * 1000;
  if (fields == 0) {
    return "null";
  }
  std::string text;
  append_decimal(text, sum_um_q8 / fields, kPerMm, 4);
  return text;
}

std::string visits(const ReplayStatistics& statistics) {
  std::vector<std::string> entries;
  for (const Visit& visit : statistics.visits().visits()) {
    const bool passed = visit.dwell() < VisitLog::kShortestVisit;
    entries.push_back(object({{"tube", address(visit.tube)},
                              {"from_s", seconds(visit.from)},
                              {"dwell_s", seconds(visit.dwell())},
                              {"fields", whole(visit.fields)},
                              {"mean_offset_mm", mean_mm(visit.offset_sum_um_q8, visit.fields)},
                              {"mean_height_mm", mean_mm(visit.height_sum_um_q8, visit.fields)},
                              {"passed", passed ? "true" : "false"}}));
  }
  return list(entries);
}

std::string tubes_a_field(const ReplayStatistics& statistics) {
  const std::int64_t answered = statistics.state(TrackState::kTracking).fields +
                                statistics.state(TrackState::kDegraded).fields;
  std::string text;
  if (answered == 0) {
    return "null";
  }
  append_decimal(text, statistics.tubes_used() * 100 / answered, 100, 2);
  return text;
}

std::string speed(const ReplayStatistics& statistics) {
  constexpr double kUmPerMm = 1000.0;
  if (statistics.largest_speed_mm_s() < 0.0) {
    return "null";
  }
  std::string text;
  append_decimal(text, std::int64_t(statistics.largest_speed_mm_s() * kUmPerMm + 0.5), 1000, 3);
  return text;
}

}  // namespace

std::string summary_json(const RecordingFacts& recording, const ReplayStatistics& statistics) {
  const bool moved = statistics.largest_speed_mm_s() >= 0.0;
  const Members members = {
      {"format", "1"},
      {"recording", json_string(recording.name)},
      {"width_px", whole(recording.width_px)},
      {"height_px", whole(recording.height_px)},
      {"interlaced", recording.interlaced ? "true" : "false"},
      {"cut_short", recording.cut_short ? "true" : "false"},
      {"fields", whole(statistics.fields())},
      {"begin_s", seconds(statistics.begin())},
      {"end_s", seconds(statistics.end())},
      {"states", states(statistics)},
      {"degraded", degraded(statistics)},
      {"losses", losses(statistics)},
      {"starts", starts(statistics)},
      {"claims_confirmed", whole(statistics.claims_confirmed())},
      {"claims_unknown", whole(statistics.claims_unknown())},
      {"contradictions", contradictions(statistics)},
      {"picks_named", whole(statistics.picks_named())},
      {"picks_unknown", whole(statistics.picks_unknown())},
      {"poses", poses(statistics)},
      {"tubes_a_field", tubes_a_field(statistics)},
      {"largest_speed_mm_s", speed(statistics)},
      {"largest_speed_at_s", moved ? seconds(statistics.largest_speed_at()) : "null"},
      {"plugs", plugs(statistics)},
      {"visits", visits(statistics)},
  };
  std::string out = "{\n";
  for (std::size_t i = 0; i < members.size(); ++i) {
    out += "  " + json_string(members[i].first) + ": " + members[i].second;
    out += i + 1 < members.size() ? ",\n" : "\n";
  }
  return out + "}\n";
}

}  // namespace tubesight::board
