#include "board/visionbox/report_words.h"

#include "core/base/words.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {

std::string_view name_of(SourceState state) {
  switch (state) {
    case SourceState::kOpening: return "opening";
    case SourceState::kPlaying: return "playing";
    case SourceState::kEnded: return "ended";
    case SourceState::kFailed: return "failed";
  }
  return "";
}

std::string rate_text(double per_s) {
  std::string text;
  drivers::print(text, "%.1f", per_s);
  return text;
}

bool there_is_link(const BoxReport& report) { return report.link_kind != "none"; }

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

std::string journal_text(const JournalReport& journal) {
  std::string text = journal.file + ", " + std::string(name_of(journal.state)) + ", safe to row " +
                     std::to_string(journal.safe);
  text += journal.waiting > 0 ? ", " + std::to_string(journal.waiting) + " waiting" : "";
  text += journal.lost > 0 ? ", " + std::to_string(journal.lost) + " lost" : "";
  return text + (journal.trouble.empty() ? "" : ": " + journal.trouble);
}

std::string pairs_text(const PairsReport& pairs) {
  if (pairs.file.empty()) {
    return {};
  }
  std::string text = pairs.file + ", " + std::to_string(pairs.written) + " written";
  text += pairs.lost > 0 ? ", " + std::to_string(pairs.lost) + " lost" : "";
  return text + (pairs.trouble.empty() ? "" : ": " + pairs.trouble);
}

bool there_is_recorder(const BoxReport& report) { return !report.recorder.folder.empty(); }

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

std::string picture_text(const TrackingStatus& tracking) {
  if (!tracking.lamp_ruled) {
    return {};
  }
  const core::Words words = core::lighting::words_of(tracking.lamp_condition);
  return "; " + (words.meaning.empty() ? "nothing shows yet that the picture follows it"
                                       : std::string(words.meaning));
}

std::string watchdog_text(const SupervisionReport& watched) {
  std::string text;
  if (!watched.device.empty()) {
    text = watched.device +
           (watched.armed ? ", armed, " + std::to_string(watched.timeout_s) + " s" : ", not armed");
    text += watched.trouble.empty() ? "" : ": " + watched.trouble;
  }
  if (watched.manager) {
    text += (text.empty() ? "" : "; ") + std::string("the service manager's");
    text += watched.manager_ms > 0 ? ", " + std::to_string(watched.manager_ms) + " ms" : ", none";
    text +=
        watched.manager_lost > 0 ? ", " + std::to_string(watched.manager_lost) + " not told" : "";
  }
  text += watched.stuck.empty() ? "" : "; stands still: " + watched.stuck;
  return text.empty() ? "nobody watches over the box" : text;
}

std::string latency_text(const LatencyHistogram& histogram) {
  return "median " + std::to_string(histogram.quantile_us(0.5)) + " us, worst " +
         std::to_string(histogram.worst_us()) + " us";
}

}  // namespace tubesight::board
