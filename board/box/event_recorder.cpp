#include "board/box/event_recorder.h"

#include <algorithm>
#include <chrono>

#include "core/base/assert.h"
#include "core/base/copy_lines.h"
#include "core/base/reply.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Field;
using core::FieldStatus;
using core::Parity;
using core::Result;
using core::Scan;
using core::Unexpected;

/// Between recordings that disagreements begin. With the defaults the disk holds 31 recordings:
/// what is older stays there for a quarter of an hour of a robot that is wrong without end.
constexpr core::FieldTime kBetweenDisagreements = std::chrono::seconds(30);

void count(std::atomic<std::uint32_t>& counter) { counter.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

/// Fields in a row with the state before the first.
struct EventRecorder::Segment {
  std::vector<std::byte> state;
  std::size_t state_bytes = 0;
  std::vector<KeptField> fields;
  std::int32_t used = 0;
  std::vector<core::Event> events;  ///< of all fields, one after the other
  std::int32_t events_used = 0;
  std::vector<std::uint8_t> pixels;

  void clear() {
    state_bytes = 0;
    used = 0;
    events_used = 0;
  }
  [[nodiscard]] bool holds(std::int64_t number) const {
    return used > 0 && fields[0].field.number <= number &&
           number <= fields[static_cast<std::size_t>(used - 1)].field.number;
  }
};

EventRecorder::EventRecorder() = default;
EventRecorder::~EventRecorder() = default;

Result<void> EventRecorder::configure(const RecorderSettings& settings,
                                      const core::CameraSettings& camera, std::size_t state_bytes) {
  const auto division = divide_memory(settings, camera, state_bytes);
  if (!division) {
    return Unexpected(division.error());
  }
  settings_ = settings;
  camera_ = camera;
  division_ = *division;
  memory_.resize(division_.segments);
  const auto fields = static_cast<std::size_t>(division_.fields_a_segment);
  for (std::uint32_t i = 0; i < division_.segments; ++i) {
    memory_[i].state.resize(state_bytes);
    memory_[i].fields.resize(fields);
    memory_[i].events.resize(fields * static_cast<std::size_t>(core::kMaxEventsPerField));
    memory_[i].pixels.resize(fields * static_cast<std::size_t>(division_.field_bytes));
    static_cast<void>(free_.try_push_back(i));
  }
  return {};
}

/// Files know a field by its number, and its lines by that.
bool EventRecorder::fits(const Field& field) const {
  if (field.number <= number_ ||
      field.parity != core::parity_of(camera_.scan, field.number % 2 != 0)) {
    // A missing field has no parity of its own.
    return field.number > number_ && field.status == FieldStatus::kMissing;
  }
  if (field.status != FieldStatus::kGood) {
    return true;
  }
  // Not by field_of(), which needs a picture to point into.
  const std::int32_t first = field.parity == Parity::kOdd ? 1 : 0;
  const std::int32_t lines = field.parity == Parity::kProgressive
                                 ? camera_.height_px
                                 : (camera_.height_px - first + 1) / 2;
  return field.pixels.width_px == camera_.width_px && field.pixels.lines == lines;
}

bool EventRecorder::ends_frame(const Field& field) const {
  return camera_.scan == Scan::kProgressive || field.number % 2 == 1;
}

void EventRecorder::take(const core::session::Input& input, const core::session::Output& output) {
  const Field& field = input.field;
  if (!fits(field)) {
    count(counts_.restarted);
    drop_all();
  }
  if (open_) {
    keep(input);
  } else {
    drop_all();  // what follows would not be what came next
  }
  number_ = field.number;
  frame_ended_ = ends_frame(field);
  look_for_reasons(field, output);
  if (frame_ended_ && going_on_ == 0) {
    freeze();
  } else if (going_on_ > 0) {
    --going_on_;
  }
  if (open_ && frame_ended_ &&
      memory_[kept_[kept_.size() - 1]].used + 2 > division_.fields_a_segment) {
    open_ = false;
  }
}

void EventRecorder::keep(const core::session::Input& input) {
  Segment& segment = memory_[kept_[kept_.size() - 1]];
  if (segment.used ==
      division_.fields_a_segment) {  // frames of one field each: as no camera goes on
    count(counts_.restarted);
    drop_all();
    return;
  }
  const auto place = static_cast<std::size_t>(segment.used);
  KeptField& kept = segment.fields[place];
  kept.field = input.field;
  kept.first_event = segment.events_used;
  kept.events = input.events.size();
  std::copy(input.events.begin(), input.events.end(),
            segment.events.begin() + static_cast<std::ptrdiff_t>(segment.events_used));
  segment.events_used += kept.events;
  ++segment.used;
  std::uint8_t* to =
      segment.pixels.data() + place * static_cast<std::size_t>(division_.field_bytes);
  const core::FieldView& from = input.field.pixels;
  kept.field.pixels = {to, camera_.width_px, 0, camera_.width_px, from.first_line, from.line_step};
  const bool copied = input.field.status != FieldStatus::kMissing && from.pixels != nullptr &&
                      from.width_px == camera_.width_px &&
                      std::int64_t{from.lines} * from.width_px <= division_.field_bytes;
  if (!copied) {
    return;
  }
  kept.field.pixels.lines = from.lines;
  core::copy_lines(from, to);
}

void EventRecorder::look_for_reasons(const Field& field, const core::session::Output& output) {
  const core::TrackState state = output.sighting.state;
  const bool lost = state == core::TrackState::kLost && state_ != core::TrackState::kLost;
  state_ = state;
  if (settings_.on_disagreement && disagrees(field, output)) {
    ask(hal::RecordingReason::kDisagreement, field);
  }
  if (lost && settings_.on_track_lost) {
    ask(hal::RecordingReason::kTrackLost, field);
  }
  const std::uint32_t requested = requested_.load(std::memory_order_relaxed);
  if (requested != taken_) {
    ask(hal::RecordingReason::kCommand, field, {taken_ + 1, requested});
    taken_ = requested;
  }
}

/// Whether a claim is contradicted that was not, just before: a robot that insists on it is shown
/// by the first recording.
bool EventRecorder::disagrees(const Field& field, const core::session::Output& output) {
  bool anew = false;
  for (const core::Reply& reply : output.replies) {
    const auto* const claim = core::content_if<core::ClaimReply>(reply);
    if (claim == nullptr) {
      continue;
    }
    if (claim->verdict == core::ClaimVerdict::kContradicted) {
      if (contradicted_ == claim->claimed) {
        continue;
      }
      if (too_soon(field)) {
        count(counts_.spared);  // and not taken as shown
        continue;
      }
      anew = true;
      contradicted_ = claim->claimed;
    } else if (claim->verdict == core::ClaimVerdict::kConfirmed) {
      contradicted_.reset();
    }
  }
  return anew;
}

/// A recording that is going on shows it at no cost. Time that runs backwards is another source's.
bool EventRecorder::too_soon(const Field& field) const {
  if (going_on_ >= 0 || !disagreed_at_) {
    return false;
  }
  const core::FieldTime since = field.mid_exposure - *disagreed_at_;
  return core::FieldTime{0} <= since && since < kBetweenDisagreements;
}

void EventRecorder::ask(hal::RecordingReason reason, const Field& field,
                        RecordingRequests requests) {
  count(counts_.asked);
  if (going_on_ < 0 && kept_.empty()) {
    refuse(reason, requests);
    return;
  }
  if (going_on_ >= 0) {
    count(counts_.joined);
  } else {
    head_.reason = reason;
    head_.field = field.number;
    head_.at = field.mid_exposure;
    requests_ = {};
    going_on_ = settings_.fields_after;
    if (reason == hal::RecordingReason::kDisagreement) {
      disagreed_at_ = field.mid_exposure;
    }
  }
  if (requests.last != 0) {
    requests_.first = requests_.last == 0 ? requests.first : requests_.first;
    requests_.last = requests.last;
  }
}

/// Whoever asked by request() hears of it, unless nobody fetched the answers to those before him.
void EventRecorder::refuse(hal::RecordingReason reason, RecordingRequests requests) {
  count(counts_.refused);
  if (requests.last != 0) {
    Recording nothing;
    nothing.head.reason = reason;
    nothing.requests = requests;
    static_cast<void>(waiting_.try_push(nothing));
  }
}

/// Hands all that is kept to the writing thread.
void EventRecorder::freeze() {
  going_on_ = -1;
  reclaim();
  Recording recording{head_, requests_, {}};
  for (const std::uint32_t segment : kept_) {
    if (memory_[segment].used > 0) {
      static_cast<void>(recording.segments.try_push_back(segment));
    }
  }
  if (free_.empty() || recording.segments.empty() || !waiting_.try_push(recording)) {
    refuse(head_.reason, requests_);
    return;
  }
  for (const std::uint32_t segment : kept_) {
    if (memory_[segment].used == 0) {
      static_cast<void>(free_.try_push_back(segment));
    }
  }
  kept_.clear();
  open_ = false;
}

void EventRecorder::drop_all() {
  if (going_on_ >= 0) {
    going_on_ = -1;
    refuse(head_.reason, requests_);
  }
  for (const std::uint32_t segment : kept_) {
    static_cast<void>(free_.try_push_back(segment));
  }
  kept_.clear();
  open_ = false;
}

void EventRecorder::reclaim() {
  std::uint32_t segment = 0;
  while (back_.try_pop(segment)) {
    static_cast<void>(free_.try_push_back(segment));
  }
}

/// Finds room for a segment: of what is free, or the oldest that is kept.
bool EventRecorder::open_segment() {
  reclaim();
  // A quarter is left for going on while the rest is written; one, where some is being written.
  const auto all = static_cast<std::int32_t>(memory_.size());
  const std::int32_t spare = kept_.size() + free_.size() == all ? all / 4 : 1;
  const bool from_kept = !kept_.empty() && free_.size() <= spare;
  if (from_kept && going_on_ >= 0 && memory_[kept_[0]].holds(head_.field)) {
    freeze();  // it would lose what it is kept for; memory is short
  }
  std::uint32_t segment = 0;
  if (!kept_.empty() && free_.size() <= spare) {
    segment = kept_[0];
    std::copy(kept_.begin() + 1, kept_.end(), kept_.begin());
    kept_.truncate(kept_.size() - 1);
  } else if (!free_.empty()) {
    segment = free_[free_.size() - 1];
    free_.truncate(free_.size() - 1);
  } else {
    return false;
  }
  memory_[segment].clear();
  return kept_.try_push_back(segment);
}

std::span<std::byte> EventRecorder::state_wanted() {
  if (open_ || !frame_ended_ || memory_.empty() || !open_segment()) {
    return {};
  }
  open_ = true;
  return memory_[kept_[kept_.size() - 1]].state;
}

void EventRecorder::put_state(std::size_t bytes) {
  TUBESIGHT_ASSERT(open_);
  memory_[kept_[kept_.size() - 1]].state_bytes = bytes;
  if (bytes == 0) {
    drop_all();
  }
}

void EventRecorder::flush() {
  if (going_on_ >= 0) {
    freeze();
  }
}

std::optional<RecordingOutcome> EventRecorder::write_next(hal::RecordingStore& store) {
  Recording recording;
  if (!waiting_.try_pop(recording)) {
    return {};
  }
  RecordingOutcome outcome{RecordingOutcome::End::kRefused, recording.head.reason,
                           recording.requests};
  if (!recording.segments.empty()) {
    const bool written = static_cast<bool>(write(recording, store));
    outcome.end = written ? RecordingOutcome::End::kWritten : RecordingOutcome::End::kFailed;
    count(written ? counts_.written : counts_.failed);
  }
  for (const std::uint32_t segment : recording.segments) {
    static_cast<void>(back_.try_push(segment));  // there is room for all
  }
  return outcome;
}

Result<void> EventRecorder::write(const Recording& recording, hal::RecordingStore& store) {
  hal::RecordingHead head = recording.head;
  head.width_px = camera_.width_px;
  head.height_px = camera_.height_px;
  head.scan = camera_.scan;
  const Segment& first = memory_[recording.segments[0]];
  head.state = std::span(first.state).first(first.state_bytes);
  for (const std::uint32_t segment : recording.segments) {
    head.fields += memory_[segment].used;
  }
  TUBESIGHT_TRY(store.begin(head));
  for (const std::uint32_t number : recording.segments) {
    const Segment& segment = memory_[number];
    for (std::int32_t i = 0; i < segment.used; ++i) {
      const KeptField& kept = segment.fields[static_cast<std::size_t>(i)];
      const auto events = std::span(segment.events)
                              .subspan(static_cast<std::size_t>(kept.first_event),
                                       static_cast<std::size_t>(kept.events));
      TUBESIGHT_TRY(store.add(kept.field, events));
    }
  }
  return store.finish();
}

RecorderCounters EventRecorder::counters() const {
  const auto read = [](const std::atomic<std::uint32_t>& counter) {
    return counter.load(std::memory_order_relaxed);
  };
  return {read(counts_.asked),   read(counts_.joined), read(counts_.refused),
          read(counts_.written), read(counts_.failed), read(counts_.restarted),
          read(counts_.spared)};
}

}  // namespace tubesight::board
