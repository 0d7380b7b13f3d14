#include "board/visionbox/tracking_thread.h"

#include <algorithm>

#include "board/visionbox/panic_dimmer.h"

namespace tubesight::board {
namespace {

/// A field that is later than this is a missing one: between one and two of the times in which some
/// come, as a rule.
constexpr double kPatience = 1.75;
/// A turn is the millisecond's business, whatever a source says of its rate.
constexpr std::chrono::milliseconds kShortest{5};
constexpr std::chrono::milliseconds kLongest{1000};

}  // namespace

TrackingThread::TrackingThread(Loop& loop, FieldSource& source, const Told& told,
                               const RealTimeSettings& settings)
    : loop_(&loop), source_(&source), told_(told), settings_(settings) {}

std::string TrackingThread::start() {
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
  ready_.wait_until(monotonic_now() + std::chrono::seconds(10));
  return no_priority_;
}

void TrackingThread::stop() {
  stopping_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void TrackingThread::run() {
  touch_stack();
  use_signal_stack();
  name_this_thread("tracking");
  if (settings_.priority > 0) {
    no_priority_ = schedule_in_real_time(settings_.priority);
    now_.scheduled = no_priority_.empty();
  }
  ready_.wake();
  while (!stopping_) {
    turn();
  }
}

void TrackingThread::turn() {
  const std::chrono::duration<double> patience =
      kPatience * source_->fields_at_once() * source_->span();
  const auto timeout = std::clamp(std::chrono::duration_cast<std::chrono::milliseconds>(patience),
                                  kShortest, kLongest);
  if (!judges_ || !loop_->turn(timeout)) {
    // The source has nothing to wait for: turns go on at the rate of its fields.
    now_.source_errors += judges_ ? 1 : 0;
    sleep_until(next_without_);
    loop_->turn_without_field();
  }
  const MonotonicTime now = monotonic_now();
  if (loop_->input().field.status != core::FieldStatus::kMissing) {
    measure();
    next_without_ = now + source_->span();
  } else {
    // The second field of a frame that failed to come is given up with the first, in no time.
    next_without_ = std::max(next_without_, now - source_->span()) + source_->span();
  }
  publish();
}

void TrackingThread::measure() {
  const MonotonicTime done = monotonic_now();
  const MonotonicTime whole = done - source_->due();
  now_.step.add(done - source_->handed_over());
  now_.grab_to_sighting.add(whole);
  const std::chrono::duration<double, std::milli> whole_ms = whole;
  now_.late += whole_ms.count() > settings_.deadline_ms ? 1 : 0;
}

void TrackingThread::publish() {
  now_.sighting = loop_->output().sighting;
  now_.counters = loop_->counters();
  now_.lamp = loop_->input().lamp_dimmed;
  now_.lamp_permille = loop_->input().field.lamp_permille;
  now_.lamp_ruled = loop_->output().lamp_ruled;
  now_.lamp_automatic = loop_->output().lamp_automatic;
  now_.lamp_condition = loop_->output().lamp;
  latest_.publish(now_);
  ++turns_;
  tell_robot();
}

void TrackingThread::tell_robot() {
  if (told_.link == nullptr) {
    return;
  }
  using drivers::Health;
  drivers::LinkHealth health;
  const SourceState source = source_->state();
  health.camera = source == SourceState::kPlaying   ? Health::kWell
                  : source == SourceState::kOpening ? Health::kUnknown
                                                    : Health::kFailed;
  health.lamp_dimmed = now_.lamp;
  health.lamp_automatic = now_.lamp_automatic;
  if (now_.lamp) {
    const bool device_fails = now_.counters.dimmer_errors > dimmer_errors_ ||
                              (told_.lamp != nullptr && !told_.lamp->report().open);
    health.lamp = lamp_health(device_fails, now_.lamp_condition);
    health.lamp_permille = now_.lamp_permille;
  }
  dimmer_errors_ = now_.counters.dimmer_errors;
  health.fields = now_.counters.fields;
  health.fields_missing = now_.counters.missing;
  health.fields_late = now_.late;
  if (told_.pairs != nullptr) {
    health.pairs_written = told_.pairs->written();
    health.pairs_lost = told_.pairs->lost();
  }
  told_.link->set_health(health);
}

drivers::Health lamp_health(bool device_fails, core::lighting::LampCondition condition) {
  if (device_fails || core::lighting::is_fault(condition)) {
    return drivers::Health::kFailed;
  }
  return condition == core::lighting::LampCondition::kWell ? drivers::Health::kWell
                                                           : drivers::Health::kUnknown;
}

}  // namespace tubesight::board
