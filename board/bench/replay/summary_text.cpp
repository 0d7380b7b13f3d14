#include "board/bench/replay/summary_text.h"

#include <array>
#include <string_view>

#include "board/box/start_text.h"
#include "core/base/names.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using drivers::print;

using core::FieldTime;
using core::Reason;
using core::TrackState;

double seconds(FieldTime time) { return std::chrono::duration<double>(time).count(); }

long long count(std::int64_t value) { return value; }

const char* c_str(std::string_view literal) { return literal.data(); }

double mean_mm(std::int64_t sum_um_q8, std::int64_t fields) {
  constexpr double kPerMm = 256.0 * 1000.0;
  return static_cast<double>(sum_um_q8) / static_cast<double>(fields) / kPerMm;
}

void print_recording(std::string& out, const RecordingFacts& recording,
                     const ReplayStatistics& statistics) {
  out += recording.name;
  print(out, ": %lld field%s of %d x %d pixels, %s, %.3f s from %.3f s%s\n",
        count(statistics.fields()), statistics.fields() == 1 ? "" : "s", recording.width_px,
        recording.height_px, recording.interlaced ? "interlaced" : "progressive",
        seconds(statistics.end() - statistics.begin()), seconds(statistics.begin()),
        recording.cut_short ? " (cut short)" : "");
}

void print_states(std::string& out, const ReplayStatistics& statistics) {
  FieldTime total{0};
  constexpr std::array kOrder = {TrackState::kTracking, TrackState::kDegraded, TrackState::kLost,
                                 TrackState::kWaiting};
  for (const TrackState state : kOrder) {
    total += statistics.state(state).time;
  }
  for (const TrackState state : kOrder) {
    const Share& share = statistics.state(state);
    const double part = total.count() > 0 ? 100.0 * seconds(share.time) / seconds(total) : 0.0;
    print(out, "  %-10s %10.3f s  %6.2f %%  %lld field%s\n", c_str(core::name_of(state)),
          seconds(share.time), part, count(share.fields), share.fields == 1 ? "" : "s");
    for (std::size_t i = 0; state == TrackState::kDegraded && i < ReplayStatistics::kReasons; ++i) {
      const auto reason = static_cast<Reason>(i);
      const Share& because = statistics.degraded(reason);
      if (because.fields > 0) {
        print(out, "    %.3f s %s: %s\n", seconds(because.time), c_str(core::name_of(reason)),
              c_str(core::explain(reason)));
      }
    }
  }
}

void print_losses(std::string& out, const ReplayStatistics& statistics) {
  for (const auto& loss : statistics.losses()) {
    print(out, "  lost at %.3f s for %.3f s: %s: %s\n", seconds(loss.at), seconds(loss.lasted),
          c_str(core::name_of(loss.reason)), c_str(core::explain(loss.reason)));
  }
}

void print_starts(std::string& out, const ReplayStatistics& statistics) {
  if (statistics.starts().empty()) {
    out += "  no start was given\n";
  }
  for (const auto& start : statistics.starts()) {
    if (start.reply.refusal == core::StartRefusal::kNone) {
      print(out, "  start at %.3f s taken\n", seconds(start.at));
    } else {
      print(out, "  start at %.3f s refused: %s: %s\n", seconds(start.at),
            c_str(core::name_of(start.reply.refusal)), refusal_text(start.reply).c_str());
    }
  }
}

void print_claims(std::string& out, const ReplayStatistics& statistics) {
  const auto contradicted = static_cast<std::int64_t>(statistics.contradictions().size());
  const std::int64_t claims =
      statistics.claims_confirmed() + contradicted + statistics.claims_unknown();
  if (claims > 0) {
    print(out, "  claims: %lld, %lld confirmed, %lld contradicted, %lld unknown\n", count(claims),
          count(statistics.claims_confirmed()), count(contradicted),
          count(statistics.claims_unknown()));
  }
  for (const auto& contradiction : statistics.contradictions()) {
    print(out, "    at %.3f s the robot claimed row %d column %d, the box saw row %d column %d\n",
          seconds(contradiction.at), contradiction.claimed.row, contradiction.claimed.column,
          contradiction.seen.row, contradiction.seen.column);
  }
  if (statistics.picks_named() + statistics.picks_unknown() > 0) {
    print(out, "  picks: %lld named, %lld where no tube is known\n",
          count(statistics.picks_named()), count(statistics.picks_unknown()));
  }
  if (statistics.not_served() > 0) {
    print(out, "  %lld event%s of kinds that this build does not answer\n",
          count(statistics.not_served()), statistics.not_served() == 1 ? "" : "s");
  }
}

void print_poses(std::string& out, const ReplayStatistics& statistics) {
  constexpr double kNano = 1e-9;
  constexpr double kNanometre = 1e-6;
  for (const auto& pose : statistics.poses()) {
    const core::PoseResult& r = pose.result;
    if (r.reason != core::PoseReason::kNone) {
      print(out, "  pose at %.3f s refused: %s: %s\n", seconds(pose.at),
            c_str(core::name_of(r.reason)), c_str(core::explain(r.reason)));
      continue;
    }
    const auto mm = [&](std::int64_t nanometres) {
      return kNanometre * static_cast<double>(nanometres);
    };
    const auto degrees = [&](std::int64_t ndeg) { return kNano * static_cast<double>(ndeg); };
    print(out,
          "  pose at %.3f s: x %.4f y %.4f z %.4f mm, alpha %.4f beta %.4f gamma %.4f deg, %.4f mm "
          "off row %d column %d%s\n",
          seconds(pose.at), mm(r.position_nm[0]), mm(r.position_nm[1]), mm(r.position_nm[2]),
          degrees(r.angles_ndeg[0]), degrees(r.angles_ndeg[1]), degrees(r.angles_ndeg[2]),
          mm(r.offset_nm), r.nearest.row, r.nearest.column,
          pose.contradicted ? ", which the tracking contradicts" : "");
  }
}

void print_measuring(std::string& out, const ReplayStatistics& statistics) {
  const std::int64_t answered = statistics.state(TrackState::kTracking).fields +
                                statistics.state(TrackState::kDegraded).fields;
  if (answered > 0) {
    print(out, "  tube-ends measured: %.1f a field\n",
          static_cast<double>(statistics.tubes_used()) / static_cast<double>(answered));
  }
  if (statistics.largest_speed_mm_s() >= 0.0) {
    print(out, "  largest speed: %.1f mm/s at %.3f s\n", statistics.largest_speed_mm_s(),
          seconds(statistics.largest_speed_at()));
  }
  if (!statistics.plugs().empty()) {
    out += "  plugs recognised (row, column):";
    for (const core::TubeAddress& plug : statistics.plugs()) {
      print(out, " (%d, %d)", plug.row, plug.column);
    }
    out += '\n';
  }
}

void print_visits(std::string& out, const ReplayStatistics& statistics) {
  const auto& all = statistics.visits().visits();
  std::int64_t visited = 0;
  for (const Visit& visit : all) {
    visited += visit.dwell() >= VisitLog::kShortestVisit ? 1 : 0;
  }
  print(out, "  tubes visited: %lld", count(visited));
  out += '\n';
  if (visited > 0) {
    out += "       row  column      from_s     dwell_s  mean_offset_mm  mean_height_mm\n";
  }
  for (const Visit& visit : all) {
    if (visit.dwell() >= VisitLog::kShortestVisit) {
      print(out, "    %6d  %6d  %10.3f  %10.3f  %14.2f  %14.2f\n", visit.tube.row,
            visit.tube.column, seconds(visit.from), seconds(visit.dwell()),
            mean_mm(visit.offset_sum_um_q8, visit.fields),
            mean_mm(visit.height_sum_um_q8, visit.fields));
    }
  }
}

/// Tubes that the guidetube only came by, in their order; many are cut short.
void print_passed(std::string& out, const ReplayStatistics& statistics) {
  constexpr std::int64_t kMostNamed = 20;
  std::int64_t passed = 0;
  std::string names;
  for (const Visit& visit : statistics.visits().visits()) {
    if (visit.dwell() >= VisitLog::kShortestVisit) {
      continue;
    }
    if (++passed <= kMostNamed) {
      print(names, " (%d, %d)", visit.tube.row, visit.tube.column);
    }
  }
  if (passed > 0) {
    print(out, "  tubes passed in less than %.1f s: %lld:", seconds(VisitLog::kShortestVisit),
          count(passed));
    out += names + (passed > kMostNamed ? " ...\n" : "\n");
  }
}

}  // namespace

std::string why_not_tracked(const std::string& recording, const ReplayStatistics& statistics) {
  if (statistics.state(TrackState::kTracking).fields +
          statistics.state(TrackState::kDegraded).fields ==
      0) {
    return recording + ": never started, expected a start that is taken, for --must-track";
  }
  if (statistics.losses().empty()) {
    return {};
  }
  const ReplayStatistics::Loss& loss = statistics.losses().front();
  std::string text = recording;
  print(text, ": lost at %.3f s: %s, expected to be tracked to its end, for --must-track",
        seconds(loss.at), c_str(core::name_of(loss.reason)));
  return text;
}

std::string summary_text(const RecordingFacts& recording, const ReplayStatistics& statistics) {
  std::string out;
  print_recording(out, recording, statistics);
  print_states(out, statistics);
  print_losses(out, statistics);
  print_starts(out, statistics);
  print_claims(out, statistics);
  print_poses(out, statistics);
  print_measuring(out, statistics);
  print_passed(out, statistics);
  print_visits(out, statistics);
  return out;
}

}  // namespace tubesight::board
