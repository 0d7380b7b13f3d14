#include "board/visionbox/box_watch.h"

#include <chrono>

#include "core/base/names.h"
#include "core/base/words.h"

namespace tubesight::board {
namespace {

constexpr MonotonicTime kCountEvery = std::chrono::seconds(1);

const char* words(SourceState state) {
  switch (state) {
    case SourceState::kOpening: return "source: opening";
    case SourceState::kPlaying: return "source: playing";
    case SourceState::kEnded: return "source: ended, the box goes on without fields";
    case SourceState::kFailed: return "source: failed, to be opened again";
  }
  return "";
}

std::string tracking_words(const core::Sighting& sighting) {
  std::string text = "tracking: " + std::string(core::name_of(sighting.state));
  if (sighting.reason != core::Reason::kNone) {
    text += ": " + std::string(core::explain(sighting.reason));
  }
  return text;
}

}  // namespace

void BoxWatch::look(const BoxReport& report) {
  if (source_ != report.source) {
    source_ = report.source;
    tell_(words(report.source));
  }
  headline_ = words(report.source);
  if (!report.turned) {
    return;
  }
  const core::Sighting& sighting = report.tracking.sighting;
  const std::string tracking = tracking_words(sighting);
  headline_ = tracking + "; " + headline_;
  if (sighting.state != state_ || sighting.reason != reason_) {
    state_ = sighting.state;
    reason_ = sighting.reason;
    tell_(tracking);
  }
  const BoxCounters& counters = report.tracking.counters;
  if (report.up - counted_at_ >= kCountEvery) {
    const std::chrono::duration<double> since = report.up - counted_at_;
    const std::int64_t came = counters.fields - counters.missing;
    fields_per_s_ = static_cast<double>(came - counted_) / since.count();
    counted_ = came;
    counted_at_ = report.up;
    if (report.tracking.late > late_) {
      tell_(std::to_string(report.tracking.late - late_) + " sightings came after the deadline");
      late_ = report.tracking.late;
    }
    if (report.made_late > made_late_) {
      tell_("source: made " + std::to_string(report.made_late - made_late_) +
            " fields after their instant");
      made_late_ = report.made_late;
    }
  }
}

}  // namespace tubesight::board
