#include <algorithm>
#include <chrono>
#include <utility>

#include "board/visionbox/box_report.h"
#include "board/visionbox/control_protocol.h"
#include "board/visionbox/report_words.h"
#include "drivers/control/json_line.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using drivers::JsonLine;

/// Room that the next recording finds, by which older ones go.
SelfTestRow disk_row(const BoxReport& report) {
  using Verdict = SelfTestRow::Verdict;
  if (!there_is_recorder(report)) {
    return {"disk", Verdict::kAbsent, recorder_text(report)};
  }
  const RecorderReport& recorder = report.recorder;
  const bool room = recorder.room_mb >= recorder.needed_mb;
  std::string words =
      recorder_text(report) + ", " + std::to_string(recorder.room_mb) + " MB of room";
  if (recorder.open && !room) {
    words += ", a recording needs " + std::to_string(recorder.needed_mb);
  }
  return {"disk",
          recorder.open && recorder.trouble.empty() && room ? Verdict::kGood : Verdict::kBad,
          std::move(words)};
}

}  // namespace

std::vector<SelfTestRow> self_test(const BoxReport& report) {
  using Verdict = SelfTestRow::Verdict;
  const auto good_if = [](bool good) { return good ? Verdict::kGood : Verdict::kBad; };
  const TrackingStatus& tracking = report.tracking;
  std::vector<SelfTestRow> rows;
  rows.push_back({"source", good_if(report.source == SourceState::kPlaying),
                  std::string(report.source_kind) + ", " + std::string(name_of(report.source))});
  if (report.camera) {
    rows.push_back({"camera", good_if(report.camera->well), report.camera->words});
    // No fault: the box cannot look for what nobody has told it.
    const bool bound = report.camera->doubt.empty();
    rows.push_back({"identity", bound ? Verdict::kGood : Verdict::kAbsent,
                    bound ? "the calibration names this camera" : report.camera->doubt});
  }
  const double nominal =
      report.span.count() > 0 ? 1.0 / std::chrono::duration<double>(report.span).count() : 0.0;
  rows.push_back(
      {"rate", good_if(report.fields_per_s > 0.9 * nominal),
       rate_text(report.fields_per_s) + " fields a second, expected " + rate_text(nominal)});
  const std::int64_t median_us = tracking.grab_to_sighting.quantile_us(0.5);
  rows.push_back({"time",
                  good_if(tracking.grab_to_sighting.count() > 0 &&
                          static_cast<double>(median_us) < 1000.0 * report.deadline_ms),
                  latency_text(tracking.grab_to_sighting) + ", " + std::to_string(tracking.late) +
                      " fields later than " + rate_text(report.deadline_ms) + " ms"});
  rows.push_back({"lamp",
                  tracking.lamp ? good_if(tracking.counters.dimmer_errors == 0 &&
                                          (!report.lamp || report.lamp->open) &&
                                          !core::lighting::is_fault(tracking.lamp_condition))
                                : Verdict::kAbsent,
                  tracking.lamp ? std::to_string(tracking.lamp_permille) + " permille, " +
                                      std::to_string(tracking.counters.dimmer_errors) + " errors" +
                                      picture_text(tracking)
                                : "nobody dims it"});
  rows.push_back({"link", there_is_link(report) ? good_if(report.link.open) : Verdict::kAbsent,
                  link_text(report)});
  rows.push_back(disk_row(report));
  if (!report.pairs.file.empty()) {
    rows.push_back({"pairs", good_if(report.pairs.trouble.empty()), pairs_text(report.pairs)});
  }
  rows.push_back({"priority", report.priority == 0 ? Verdict::kAbsent : good_if(tracking.scheduled),
                  tracking.scheduled ? "SCHED_FIFO " + std::to_string(report.priority)
                                     : "like every other thread"});
  rows.push_back({"memory", report.lock_wanted ? good_if(report.memory_locked) : Verdict::kAbsent,
                  report.memory_locked ? "locked" : "not locked"});
  const SupervisionReport& watched = report.supervision;
  const bool watches = watched.trouble.empty() && watched.stuck.empty();
  rows.push_back({"watchdog",
                  watched.device.empty() && !watched.manager ? Verdict::kAbsent : good_if(watches),
                  watchdog_text(watched)});
  return rows;
}

std::string self_test_answer(const BoxReport& report) {
  using Verdict = SelfTestRow::Verdict;
  const std::vector<SelfTestRow> rows = self_test(report);
  const bool good = std::none_of(rows.begin(), rows.end(), [](const SelfTestRow& row) {
    return row.verdict == Verdict::kBad;
  });
  JsonLine line = begin_answer("self-test", good);
  std::string text;
  line.open("rows");
  for (const SelfTestRow& row : rows) {
    const std::string_view verdict = row.verdict == Verdict::kGood  ? "good"
                                     : row.verdict == Verdict::kBad ? "bad"
                                                                    : "absent";
    line.open(row.what).add("verdict", verdict).add("words", row.words).close();
    drivers::print(text, "%s%-9.*s %-6.*s %s", text.empty() ? "" : "\n",
                   static_cast<int>(row.what.size()), row.what.data(),
                   static_cast<int>(verdict.size()), verdict.data(), row.words.c_str());
  }
  return line.close().add("text", text).finish();
}

}  // namespace tubesight::board
