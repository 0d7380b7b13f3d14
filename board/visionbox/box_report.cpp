#include "board/visionbox/box_report.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "board/box/row_column_text.h"
#include "board/box/version.h"
#include "board/visionbox/control_protocol.h"
#include "board/visionbox/report_words.h"
#include "core/base/names.h"
#include "core/base/words.h"
#include "drivers/control/json_line.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using drivers::JsonLine;

std::string decimal(std::int64_t numerator, std::int64_t denominator, std::int32_t digits) {
  std::string text;
  drivers::append_decimal(text, numerator, denominator, digits);
  return text;
}

/// 1/256 um, as millimetres.
std::string mm_text(std::int64_t um_q8) { return decimal(um_q8, 256'000, 4); }

void add_source(JsonLine& line, const BoxReport& report) {
  line.open("source").add("kind", report.source_kind).add("state", name_of(report.source));
  line.add_printed("field_ms", decimal(report.span.count(), 1'000'000, 3));
  line.add_printed("fields_per_s", rate_text(report.fields_per_s));
  line.add("passes", report.passes).add("failures", report.failures);
  line.add("made_late", report.made_late);
  line.add("errors", report.tracking.source_errors).close();
  if (!report.camera) {
    return;
  }
  line.open("camera").add("well", report.camera->well).add("words", report.camera->words);
  line.add("counts", report.camera->counts).add("stamps", report.camera->stamps);
  line.add("doubt", report.camera->doubt);
  for (const auto& [name, count] : report.camera->counters) {
    line.add(name, count);
  }
  line.close();
}

void add_sighting(JsonLine& line, const core::Sighting& sighting) {
  line.open("tracking").add("state", core::name_of(sighting.state));
  line.add("reason", core::name_of(sighting.reason)).add("field", sighting.field);
  line.add_printed("age_ms", decimal(sighting.age.count(), 1'000'000, 1));
  line.add("liveness", core::name_of(sighting.liveness));
  line.add("judged_fields", sighting.judged_fields).add("tubes_seen", sighting.tracked);
  if (sighting.primary_known) {
    line.add("primary", row_column_text(sighting.primary));
  }
  if (sighting.tool_known) {
    line.add("tube", row_column_text(sighting.tool)).add("aligned", sighting.aligned);
    line.add_printed("offset_mm", mm_text(sighting.offset_um_q8));
  }
  if (sighting.axis_known) {
    line.add_printed("height_mm", mm_text(sighting.height_um_q8));
  }
  if (sighting.margin_known) {
    line.add_printed("margin", decimal(sighting.margin_permyriad, 10'000, 4));
  }
  line.close();
}

void add_latency(JsonLine& line, std::string_view key, const LatencyHistogram& histogram) {
  line.open(key).add("median_us", histogram.quantile_us(0.5));
  line.add("p99_us", histogram.quantile_us(0.99)).add("worst_us", histogram.worst_us());
  line.add("count", histogram.count()).close();
}

void add_counters(JsonLine& line, const BoxCounters& counters) {
  line.open("counters").add("fields", counters.fields).add("missing", counters.missing);
  line.add("dimmer_errors", counters.dimmer_errors);
  const auto add_port = [&](std::string_view key, const PortCounters& port) {
    line.open(key).add("garbled", port.garbled).add("gone", port.gone);
    line.add("lost_replies", port.lost_replies).close();
  };
  add_port("link", counters.link);
  add_port("station", counters.station);
  line.close();
}

void add_link(JsonLine& line, const BoxReport& report) {
  line.open("link").add("kind", report.link_kind);
  if (there_is_link(report)) {
    const drivers::LinkCounters& counters = report.link.counters;
    const auto add = [&line](std::string_view key, std::uint32_t count) {
      line.add(key, static_cast<std::int64_t>(count));
    };
    line.add("open", report.link.open);
    add("requests", counters.requests);
    add("answers", counters.answers);
    add("exceptions", counters.exceptions);
    add("errors", link_errors(counters));
    add("other_units", counters.other_units);
    add("late_claims", counters.late_claims);
    add("abandoned_answers", counters.abandoned_answers);
    add("reopenings", counters.reopenings);
    add("response_worst_us", counters.response_worst_us);
    add("claim_response_worst_us", counters.claim_response_worst_us);
  }
  line.close();
}

void add_pairs(JsonLine& line, const PairsReport& pairs) {
  line.open("pairs").add("there", !pairs.file.empty());
  if (!pairs.file.empty()) {
    line.add("file", pairs.file).add("written", pairs.written).add("lost", pairs.lost);
    line.add("trouble", pairs.trouble);
  }
  line.close();
}

void add_journal(JsonLine& line, const JournalReport& journal) {
  line.open("journal").add("state", name_of(journal.state));
  if (!journal.file.empty()) {
    line.add("file", journal.file).add("safe", journal.safe).add("waiting", journal.waiting);
    line.add("lost", journal.lost).add("trouble", journal.trouble);
  }
  line.close();
}

void add_recorder(JsonLine& line, const BoxReport& report) {
  line.open("recorder").add("there", there_is_recorder(report));
  if (there_is_recorder(report)) {
    const RecorderReport& recorder = report.recorder;
    const auto add = [&line](std::string_view key, std::uint32_t count) {
      line.add(key, static_cast<std::int64_t>(count));
    };
    line.add("folder", recorder.folder).add("open", recorder.open);
    line.add("room_mb", recorder.room_mb).add("last", recorder.last);
    line.add("trouble", recorder.trouble);
    add("asked", recorder.counters.asked);
    add("joined", recorder.counters.joined);
    add("refused", recorder.counters.refused);
    add("written", recorder.counters.written);
    add("failed", recorder.counters.failed);
    add("restarted", recorder.counters.restarted);
    add("spared", recorder.counters.spared);
  }
  line.close();
}

void add_supervision(JsonLine& line, const SupervisionReport& watched) {
  line.open("supervision").add("stuck", watched.stuck);
  line.open("watchdog").add("there", !watched.device.empty());
  if (!watched.device.empty()) {
    line.add("device", watched.device).add("armed", watched.armed);
    line.add("timeout_s", watched.timeout_s).add("trouble", watched.trouble);
  }
  line.close();
  line.open("manager").add("there", watched.manager).add("feed_within_ms", watched.manager_ms);
  line.add("lost", watched.manager_lost).close();
  line.close();
}

std::string sighting_text(const core::Sighting& sighting) {
  std::string text = std::string(core::name_of(sighting.state));
  if (sighting.reason != core::Reason::kNone) {
    text += " (" + std::string(core::explain(sighting.reason)) + ")";
  }
  if (sighting.tool_known) {
    text += ", under tube " + row_column_text(sighting.tool) + ", " +
            mm_text(sighting.offset_um_q8) + " mm off" +
            (sighting.aligned ? ", vouched for" : ", not vouched for");
  }
  return text;
}

/// `bad`: the self-test's rows that are.
std::string status_text(const BoxReport& report, const std::string& bad) {
  const TrackingStatus& tracking = report.tracking;
  std::string text = "source    " + std::string(report.source_kind) + ", " +
                     std::string(name_of(report.source)) + ", " + rate_text(report.fields_per_s) +
                     " fields a second";
  if (report.failures > 0) {
    text += ", failed " + std::to_string(report.failures) + " times";
  }
  if (report.made_late > 0) {
    text += ", " + std::to_string(report.made_late) + " made too late";
  }
  text += report.camera ? "\ncamera    " + report.camera->words : "";
  text += report.camera && !report.camera->doubt.empty() ? "; " + report.camera->doubt : "";
  text += "\ntracking  " + sighting_text(tracking.sighting);
  text += "\nfields    " + std::to_string(tracking.counters.fields) + ", of which " +
          std::to_string(tracking.counters.missing) + " did not come; " +
          std::to_string(tracking.sighting.judged_fields) + " judged";
  text += "\nstep      " + latency_text(tracking.step);
  text += "\nsighting  " + latency_text(tracking.grab_to_sighting) + " after the field, " +
          std::to_string(tracking.late) + " later than the deadline";
  text += "\nlamp      " + (tracking.lamp ? std::to_string(tracking.lamp_permille) + " permille" +
                                                (tracking.lamp_automatic ? ", automatic" : "")
                                          : std::string("nobody dims it"));
  text += report.lamp && !report.lamp->open ? ", its device cannot be had" : "";
  text += picture_text(tracking);
  text += "\nlink      " + link_text(report);
  text += "\nrecorder  " + recorder_text(report);
  text += report.pairs.file.empty() ? "" : "\npairs     " + pairs_text(report.pairs);
  text += report.journal.file.empty() ? "" : "\njournal   " + journal_text(report.journal);
  text += std::string("\nself-test ") + (!report.self_test_finished ? "not finished"
                                         : bad.empty()              ? "nothing is bad"
                                                                    : "bad: " + bad);
  text += "\nboot      " + report.boots.words();
  text += "\nwatchdog  " + watchdog_text(report.supervision);
  text += std::string("\nrealtime  ") + (tracking.scheduled ? "SCHED_FIFO" : "ordinary priority") +
          (report.memory_locked ? ", memory locked" : ", memory not locked");
  return text;
}

}  // namespace

std::string status_answer(const BoxReport& report) {
  const std::string bad = bad_rows(self_test(report));
  JsonLine line = begin_answer("status", true);
  line.add("version", program_version());
  line.add_printed("up_s", decimal(report.up.count(), 1'000'000'000, 1));
  add_source(line, report);
  if (report.turned) {
    const TrackingStatus& tracking = report.tracking;
    add_sighting(line, tracking.sighting);
    add_counters(line, tracking.counters);
    add_latency(line, "step", tracking.step);
    add_latency(line, "grab_to_sighting", tracking.grab_to_sighting);
    line.add("late", tracking.late);
    line.open("lamp").add("dimmed", tracking.lamp).add("permille", tracking.lamp_permille);
    line.add("ruled", tracking.lamp_ruled).add("automatic", tracking.lamp_automatic);
    line.add("condition", core::lighting::words_of(tracking.lamp_condition).word);
    if (report.lamp) {
      line.add("open", report.lamp->open).add("resting", report.lamp->resting);
      line.add("failures", report.lamp->failures);
    }
    line.close();
  }
  add_link(line, report);
  add_recorder(line, report);
  add_pairs(line, report.pairs);
  add_journal(line, report.journal);
  line.open("zones").add("places", std::int64_t{report.zones});
  line.add("known", report.zones_known).close();
  line.open("realtime").add("scheduled", report.tracking.scheduled);
  line.add("priority", report.priority).add("memory_locked", report.memory_locked).close();
  add_supervision(line, report.supervision);
  line.open("boot").add("known", report.boots.known()).add("number", report.boots.boot);
  line.add("start", report.boots.start).add("trouble", report.boots.trouble).close();
  line.open("self_test").add("finished", report.self_test_finished);
  line.add("bad", bad).close();
  line.open("poses").add("fields_passed_over", report.poses_passed_over).close();
  return line.add("text", status_text(report, bad)).finish();
}

}  // namespace tubesight::board
