#include "board/visionbox/box_report.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "board/box/version.h"
#include "board/visionbox/control_protocol.h"
#include "core/base/names.h"
#include "core/base/words.h"
#include "drivers/control/json_line.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using drivers::JsonLine;

std::string_view name_of(SourceState state) {
  switch (state) {
    case SourceState::kOpening: return "opening";
    case SourceState::kPlaying: return "playing";
    case SourceState::kEnded: return "ended";
    case SourceState::kFailed: return "failed";
  }
  return "";
}

std::string decimal(std::int64_t numerator, std::int64_t denominator, std::int32_t digits) {
  std::string text;
  drivers::append_decimal(text, numerator, denominator, digits);
  return text;
}

/// 1/256 um, as millimetres.
std::string mm_text(std::int64_t um_q8) { return decimal(um_q8, 256'000, 4); }

std::string rate_text(double per_s) {
  std::string text;
  drivers::print(text, "%.1f", per_s);
  return text;
}

std::string tube_text(core::TubeAddress tube) {
  return std::to_string(tube.row) + "," + std::to_string(tube.column);
}

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
    line.add("primary", tube_text(sighting.primary));
  }
  if (sighting.tool_known) {
    line.add("tube", tube_text(sighting.tool)).add("aligned", sighting.aligned);
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

bool there_is_link(const BoxReport& report) { return report.link_kind != "none"; }

/// Requests that came damaged, or in pieces, or found no room.
std::uint32_t link_errors(const drivers::LinkCounters& counters) {
  return counters.crc_errors + counters.cut_frames + counters.dropped_events;
}

std::string link_text(const BoxReport& report) {
  std::string text(report.link_kind);
  if (there_is_link(report)) {
    const drivers::LinkCounters& counters = report.link.counters;
    text += report.link.open ? ", open, " : ", not open, ";
    text += std::to_string(counters.requests) + " requests, " +
            std::to_string(link_errors(counters)) + " errors";
  }
  return text;
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

/// Empty: none are written.
std::string pairs_text(const PairsReport& pairs) {
  if (pairs.file.empty()) {
    return {};
  }
  std::string text = pairs.file + ", " + std::to_string(pairs.written) + " written";
  text += pairs.lost > 0 ? ", " + std::to_string(pairs.lost) + " lost" : "";
  return text + (pairs.trouble.empty() ? "" : ": " + pairs.trouble);
}

void add_pairs(JsonLine& line, const PairsReport& pairs) {
  line.open("pairs").add("there", !pairs.file.empty());
  if (!pairs.file.empty()) {
    line.add("file", pairs.file).add("written", pairs.written).add("lost", pairs.lost);
    line.add("trouble", pairs.trouble);
  }
  line.close();
}

bool there_is_recorder(const BoxReport& report) { return !report.recorder.folder.empty(); }

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

std::string recorder_text(const BoxReport& report) {
  if (!there_is_recorder(report)) {
    return "nothing is recorded";
  }
  const RecorderReport& recorder = report.recorder;
  const RecorderCounters& counters = recorder.counters;
  std::string text = recorder.folder + ", " + std::to_string(counters.written) + " written";
  if (counters.failed + counters.refused > 0) {
    text += ", " + std::to_string(counters.failed) + " failed, " +
            std::to_string(counters.refused) + " refused";
  }
  return text + (recorder.trouble.empty() ? "" : ": " + recorder.trouble);
}

std::string sighting_text(const core::Sighting& sighting) {
  std::string text = std::string(core::name_of(sighting.state));
  if (sighting.reason != core::Reason::kNone) {
    text += " (" + std::string(core::explain(sighting.reason)) + ")";
  }
  if (sighting.tool_known) {
    text += ", under tube " + tube_text(sighting.tool) + ", " + mm_text(sighting.offset_um_q8) +
            " mm off" + (sighting.aligned ? ", vouched for" : ", not vouched for");
  }
  return text;
}

/// What the picture shows of the lamp; empty where the box does not rule it.
std::string picture_text(const TrackingStatus& tracking) {
  if (!tracking.lamp_ruled) {
    return {};
  }
  const core::Words words = core::lighting::words_of(tracking.lamp_condition);
  return "; " + (words.meaning.empty() ? "nothing shows yet that the picture follows it"
                                       : std::string(words.meaning));
}

std::string latency_text(const LatencyHistogram& histogram) {
  return "median " + std::to_string(histogram.quantile_us(0.5)) + " us, worst " +
         std::to_string(histogram.worst_us()) + " us";
}

std::string status_text(const BoxReport& report) {
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
  text += std::string("\nrealtime  ") + (tracking.scheduled ? "SCHED_FIFO" : "ordinary priority") +
          (report.memory_locked ? ", memory locked" : ", memory not locked");
  return text;
}

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

std::string status_answer(const BoxReport& report) {
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
  line.open("zones").add("places", std::int64_t{report.zones});
  line.add("known", report.zones_known).close();
  line.open("realtime").add("scheduled", report.tracking.scheduled);
  line.add("priority", report.priority).add("memory_locked", report.memory_locked).close();
  line.open("poses").add("fields_passed_over", report.poses_passed_over).close();
  return line.add("text", status_text(report)).finish();
}

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
