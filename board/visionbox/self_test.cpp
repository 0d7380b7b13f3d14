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
using drivers::SelfTestBit;
using Verdict = SelfTestRow::Verdict;
using Rows = std::vector<SelfTestRow>;

Verdict good_if(bool good) { return good ? Verdict::kGood : Verdict::kBad; }

/// Room that the next recording finds, by which older ones go.
SelfTestRow disk_row(const BoxReport& report) {
  if (!there_is_recorder(report)) {
    return {SelfTestBit::kDisk, "disk", Verdict::kAbsent, recorder_text(report)};
  }
  const RecorderReport& recorder = report.recorder;
  const bool room = recorder.room_mb >= recorder.needed_mb;
  std::string words =
      recorder_text(report) + ", " + std::to_string(recorder.room_mb) + " MB of room";
  if (recorder.open && !room) {
    words += ", a recording needs " + std::to_string(recorder.needed_mb);
  }
  return {SelfTestBit::kDisk, "disk",
          recorder.open && recorder.trouble.empty() && room ? Verdict::kGood : Verdict::kBad,
          std::move(words)};
}

void add_source(Rows& rows, const BoxReport& report) {
  rows.push_back({SelfTestBit::kCamera, "source", good_if(report.source == SourceState::kPlaying),
                  std::string(report.source_kind) + ", " + std::string(name_of(report.source))});
  if (!report.camera) {
    return;
  }
  rows.push_back(
      {SelfTestBit::kCamera, "camera", good_if(report.camera->well), report.camera->words});
  // No fault: the box cannot look for what nobody has told it, and no camera that is another one
  // than the calibration's is ever opened.
  const bool bound = report.camera->doubt.empty();
  rows.push_back({SelfTestBit::kIdentity, "identity",
                  bound && report.camera->well ? Verdict::kGood : Verdict::kAbsent,
                  !bound                ? report.camera->doubt
                  : report.camera->well ? "the calibration names this camera"
                                        : "no camera to compare the calibration with"});
}

/// That it delivers as often as it must, and is judged in time.
void add_pace(Rows& rows, const BoxReport& report) {
  const double nominal =
      report.span.count() > 0 ? 1.0 / std::chrono::duration<double>(report.span).count() : 0.0;
  rows.push_back(
      {SelfTestBit::kRate, "rate", good_if(report.fields_per_s > 0.9 * nominal),
       rate_text(report.fields_per_s) + " fields a second, expected " + rate_text(nominal)});
  const LatencyHistogram& whole = report.tracking.grab_to_sighting;
  const auto median_us = static_cast<double>(whole.quantile_us(0.5));
  rows.push_back({SelfTestBit::kTime, "time",
                  good_if(whole.count() > 0 && median_us < 1000.0 * report.deadline_ms),
                  latency_text(whole) + ", " + std::to_string(report.tracking.late) +
                      " fields later than " + rate_text(report.deadline_ms) + " ms"});
}

void add_lamp(Rows& rows, const BoxReport& report) {
  const TrackingStatus& tracking = report.tracking;
  const bool well = tracking.counters.dimmer_errors == 0 && (!report.lamp || report.lamp->open) &&
                    !core::lighting::is_fault(tracking.lamp_condition);
  rows.push_back({SelfTestBit::kLamp, "lamp", tracking.lamp ? good_if(well) : Verdict::kAbsent,
                  tracking.lamp ? std::to_string(tracking.lamp_permille) + " permille, " +
                                      std::to_string(tracking.counters.dimmer_errors) + " errors" +
                                      picture_text(tracking)
                                : "nobody dims it"});
  if (!report.pattern_wanted) {
    return;
  }
  using core::Liveness;
  const Liveness live = tracking.sighting.liveness;
  rows.push_back(
      {SelfTestBit::kPattern, "pattern",
       live == Liveness::kUnknown ? Verdict::kAbsent : good_if(live == Liveness::kProved),
       live == Liveness::kUnknown  ? "nothing shows yet that the picture is live"
       : live == Liveness::kProved ? "the picture follows the lamp"
                                   : "the picture does not follow the lamp"});
}

void add_machine(Rows& rows, const BoxReport& report) {
  const bool scheduled = report.tracking.scheduled;
  rows.push_back(
      {SelfTestBit::kPriority, "priority",
       report.priority == 0 ? Verdict::kAbsent : good_if(scheduled),
       scheduled ? "SCHED_FIFO " + std::to_string(report.priority) : "like every other thread"});
  rows.push_back({SelfTestBit::kMemory, "memory",
                  report.lock_wanted ? good_if(report.memory_locked) : Verdict::kAbsent,
                  report.memory_locked ? "locked" : "not locked"});
  rows.push_back({SelfTestBit::kBoots, "boots",
                  report.boots.wanted ? good_if(report.boots.known()) : Verdict::kAbsent,
                  report.boots.words()});
  const SupervisionReport& watched = report.supervision;
  const bool wanted = !watched.device.empty() || watched.manager;
  rows.push_back(
      {SelfTestBit::kWatchdog, "watchdog",
       wanted ? good_if(watched.trouble.empty() && watched.stuck.empty()) : Verdict::kAbsent,
       watchdog_text(watched)});
}

}  // namespace

std::vector<SelfTestRow> self_test(const BoxReport& report) {
  Rows rows;
  rows.push_back({SelfTestBit::kNumbers, "numbers",
                  report.golden.ran ? good_if(report.golden.good) : Verdict::kAbsent,
                  report.golden.ran ? report.golden.words : "the golden recording was not played"});
  add_source(rows, report);
  add_pace(rows, report);
  add_lamp(rows, report);
  rows.push_back({SelfTestBit::kLink, "link",
                  there_is_link(report) ? good_if(report.link.open) : Verdict::kAbsent,
                  link_text(report)});
  rows.push_back(disk_row(report));
  if (!report.journal.file.empty()) {
    rows.push_back({SelfTestBit::kJournal, "journal",
                    good_if(report.journal.state == JournalReport::State::kWriting),
                    journal_text(report.journal)});
  }
  if (!report.pairs.file.empty()) {
    rows.push_back({SelfTestBit::kPairs, "pairs", good_if(report.pairs.trouble.empty()),
                    pairs_text(report.pairs)});
  }
  add_machine(rows, report);
  return rows;
}

std::string bad_rows(const std::vector<SelfTestRow>& rows) {
  std::string names;
  for (const SelfTestRow& row : rows) {
    if (row.verdict == Verdict::kBad) {
      names += names.empty() ? "" : ", ";
      names += row.what;
    }
  }
  return names;
}

std::string self_test_answer(const BoxReport& report) {
  const std::vector<SelfTestRow> rows = self_test(report);
  JsonLine line = begin_answer("self-test", bad_rows(rows).empty());
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
