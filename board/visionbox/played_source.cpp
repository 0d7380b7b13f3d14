#include "board/visionbox/played_source.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "board/visionbox/panic_dimmer.h"
#include "core/base/assert.h"
#include "core/base/copy_lines.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;
using std::chrono::milliseconds;

/// Until the source was opened: a field of 60 a second.
constexpr core::FieldTime kUsualSpan{16'666'667};
/// Between the last field of one pass and the first of the next: longer than any track coasts.
constexpr core::FieldTime kGap = std::chrono::seconds(1);
/// How soon the source's thread sees that it is to stop.
constexpr milliseconds kPatience{100};
/// In which a field is made, where time stands still for it.
constexpr MonotonicTime kLongestMaking = std::chrono::seconds(10);

}  // namespace

PlayedSource::PlayedSource(FieldPlayer& player, const PlayedSourceSettings& settings, Tell tell)
    : player_(&player), settings_(settings), tell_(std::move(tell)), span_ns_(kUsualSpan.count()) {
  for (Slot& slot : slots_) {
    slot.pixels.resize(static_cast<std::size_t>(settings.width_px) *
                       static_cast<std::size_t>(settings.height_px));
  }
}

Result<void> PlayedSource::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  stopping_ = false;
  const auto ahead =
      static_cast<std::uint32_t>(std::clamp<std::int32_t>(player_->fields_ahead(), 1, kSlots));
  for (std::uint32_t i = 0; i < ahead; ++i) {
    static_cast<void>(free_.try_push(i));  // as many places as slots
    slot_freed_.wake();
  }
  thread_ = std::thread([this] {
    use_signal_stack();
    play_all();
  });
  constexpr auto kLongest = std::chrono::seconds(10);
  opened_.wait_until(monotonic_now() + kLongest);
  return {};
}

void PlayedSource::stop() {
  if (!started_) {
    return;
  }
  stopping_ = true;
  slot_freed_.wake();
  thread_.join();
  started_ = false;
  lent_ = false;
  held_.reset();
  spare_.reset();
  std::uint32_t index = 0;
  while (filled_.try_pop(index) || free_.try_pop(index)) {
  }
}

void PlayedSource::play_all() {
  milliseconds wait = settings_.first_wait;
  while (!stopping_) {
    const std::int64_t before = delivered_;
    const auto played = play_once();
    player_->stop();
    if (std::exchange(first_attempt_, false)) {
      opened_.wake();
    }
    if (stopping_) {
      break;
    }
    if (delivered_ != before) {
      wait = settings_.first_wait;
    }
    if (!played && played.error() != Error::kEndOfData) {
      ++failures_;
      state_ = SourceState::kFailed;
      slot_filled_.wake();
      wait_before_reopening(wait);
    } else if (!settings_.loop) {
      state_ = SourceState::kEnded;
      slot_filled_.wake();
      tell_("source: came to its end");
      return;
    }
  }
}

Result<void> PlayedSource::play_once() {
  drivers::Messages messages;
  if (const auto started = player_->start(messages); !started) {
    say(messages, "source: cannot be opened");
    return started;
  }
  ++passes_;
  if (player_->span() > core::FieldTime{0}) {
    span_ns_ = player_->span().count();
  }
  Shift shift;
  PlayedField played;
  std::uint32_t index = 0;
  while (wait_for_slot(index)) {
    const auto made = player_->next(lamp_permille_, played, messages);
    if (!made) {
      spare_ = index;  // the tracking thread alone gives slots back
      say(messages, made.error() == Error::kEndOfData ? "" : "source: failed");
      return made;
    }
    fill(played, shift, slots_[index]);
    made_late_ += monotonic_now() > clock_.monotonic(slots_[index].field.mid_exposure) ? 1 : 0;
    static_cast<void>(filled_.try_push(index));  // as many places as slots
    state_ = SourceState::kPlaying;
    ++delivered_;
    slot_filled_.wake();
    if (std::exchange(first_attempt_, false)) {
      opened_.wake();
    }
  }
  return {};
}

/// False: the source is to stop.
bool PlayedSource::wait_for_slot(std::uint32_t& slot) {
  while (!stopping_) {
    if (spare_) {
      slot = *std::exchange(spare_, {});
      return true;
    }
    if (free_.try_pop(slot)) {
      return true;
    }
    slot_freed_.wait_until(monotonic_now() + kPatience);
  }
  return false;
}

void PlayedSource::begin_at(const core::Field& first, Shift& shift) {
  // A field from now, so that those behind the first are there when they are due, and nobody takes
  // the wait for a field that did not come.
  shift.known = true;
  if (!clock_.running()) {
    clock_.set(first.mid_exposure, monotonic_now() + span());
    return;
  }
  const core::FieldTime at = std::max(last_time_ + kGap, clock_.now() + span());
  shift.time = at - first.mid_exposure;
  shift.sequence = next_sequence_ + kGap / span() - first.sequence;
}

void PlayedSource::fill(const PlayedField& played, Shift& shift, Slot& slot) {
  if (!shift.known) {
    begin_at(played.field, shift);
  }
  slot.field = played.field;
  slot.field.mid_exposure += shift.time;
  slot.field.sequence += shift.sequence;
  last_time_ = std::max(last_time_, slot.field.mid_exposure);
  next_sequence_ = slot.field.sequence + 1;
  const core::FieldView& from = played.field.pixels;
  if (from.pixels != nullptr) {
    slot.field.pixels = core::copied_lines(from, slot.pixels.data());
  }
  slot.events = played.events;
  for (core::Event& event : slot.events) {
    event.at = event.at.value_or(played.field.mid_exposure) + shift.time;
    auto* const start = std::get_if<core::Start>(&event.content);
    if (start != nullptr && shift.time != core::FieldTime(0)) {
      start->confirmed = true;  // a later pass: the tool is elsewhere without having gone there
    }
  }
}

void PlayedSource::wait_before_reopening(milliseconds& wait) {
  const MonotonicTime until = monotonic_now() + wait;
  while (!stopping_ && monotonic_now() < until) {
    sleep_until(std::min<MonotonicTime>(until, monotonic_now() + kPatience));
  }
  wait = std::min(2 * wait, settings_.longest_wait);
}

void PlayedSource::say(const drivers::Messages& messages, const char* otherwise) {
  for (const std::string& message : messages) {
    tell_(message);
  }
  if (messages.empty() && *otherwise != '\0') {
    tell_(otherwise);
  }
}

Result<hal::FieldLease> PlayedSource::grab_for(milliseconds timeout) {
  if (!started_ || lent_) {
    return Unexpected(Error::kNotReady);
  }
  const MonotonicTime asked = monotonic_now();
  const MonotonicTime latest = asked + timeout;
  const MonotonicTime made_by = settings_.in_real_time ? latest : asked + kLongestMaking;
  while (!held_) {
    // In this order: what was filled before the source ended is still taken.
    const SourceState state = state_;
    std::uint32_t index = 0;
    if (filled_.try_pop(index)) {
      held_ = index;
    } else if (state == SourceState::kEnded || state == SourceState::kFailed) {
      return Unexpected(Error::kDisconnected);
    } else if (!slot_filled_.wait_until(made_by)) {
      return Unexpected(Error::kTimeout);
    }
  }
  const Slot& slot = slots_[*held_];
  if (!settings_.in_real_time) {
    clock_.set(slot.field.mid_exposure,
               std::max(monotonic_now(), clock_.monotonic(slot.field.mid_exposure)));
  }
  due_ = clock_.monotonic(slot.field.mid_exposure);
  // Out of real time making it may have taken longer than the time that there was to wait.
  if (due_ > (settings_.in_real_time ? latest : std::max(latest, monotonic_now()))) {
    sleep_until(latest);
    return Unexpected(Error::kTimeout);
  }
  sleep_until(due_);
  handed_over_ = monotonic_now();
  hand_over(slot);
  lent_ = true;
  return hal::FieldLease(*this, static_cast<std::int32_t>(*std::exchange(held_, {})), slot.field);
}

void PlayedSource::hand_over(const Slot& slot) {
  shone_permille_ = slot.field.lamp_permille;
  if (said_taken_ == said_.size()) {
    said_.clear();
    said_taken_ = 0;
  }
  for (const core::Event& event : slot.events) {
    unsaid_ += said_.try_push_back(event) ? 0 : 1;
  }
}

void PlayedSource::give_back(std::int32_t buffer) {
  TUBESIGHT_ASSERT(lent_);
  lent_ = false;
  static_cast<void>(free_.try_push(static_cast<std::uint32_t>(buffer)));  // it came from there
  slot_freed_.wake();
}

const core::Event* PlayedSource::next_said() const {
  return said_taken_ < said_.size() ? &said_[said_taken_] : nullptr;
}

void PlayedSource::take_said() {
  TUBESIGHT_ASSERT(said_taken_ < said_.size());
  ++said_taken_;
}

Result<void> PlayedDimmer::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  source_->set_lamp_permille(0);
  return {};
}

void PlayedDimmer::stop() {
  if (started_) {
    source_->set_lamp_permille(0);
  }
  started_ = false;
  level_permille_ = 0;
}

Result<void> PlayedDimmer::set_level(std::int32_t permille) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (permille < 0 || permille > hal::kFullLevel_permille) {
    return Unexpected(Error::kOutOfRange);
  }
  source_->set_lamp_permille(permille);
  level_permille_ = permille;
  return {};
}

}  // namespace tubesight::board
