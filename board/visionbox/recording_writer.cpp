#include "board/visionbox/recording_writer.h"

#include <chrono>
#include <utility>

#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/wakeup.h"
#include "drivers/settings/session_text.h"

namespace tubesight::board {
namespace {

constexpr std::chrono::milliseconds kLookEvery{50};
constexpr std::chrono::seconds kOpenEvery{1};
constexpr std::size_t kMostEnded = 32;
constexpr std::chrono::seconds kMeasureEvery{2};

std::int64_t utc_s() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

/// As settings are read, with a comment above.
std::string session_text(const core::SessionSettings& session, const std::string& origin) {
  return (origin.empty() ? "" : "# " + origin + "\n") + drivers::session_text(session);
}

}  // namespace

RecordingWriter::RecordingWriter(EventRecorder& recorder, const RecordSettings& settings,
                                 const core::SessionSettings& session, const std::string& origin,
                                 Tell tell)
    : recorder_(&recorder),
      settings_(settings),
      tell_(std::move(tell)),
      store_(settings.folder, settings.disk_mb, session_text(session, origin), utc_s) {}

void RecordingWriter::start() {
  stopping_ = false;
  over_ = false;  // no thread runs yet
  const bool is_open = open();
  thread_ = std::thread([this, is_open] {
    use_signal_stack();
    run(is_open);
  });
}

void RecordingWriter::stop() {
  stopping_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void RecordingWriter::run(bool is_open) {
  MonotonicTime next_open = monotonic_now() + kOpenEvery;
  MonotonicTime next_measure = monotonic_now() + kMeasureEvery;
  while (true) {
    // Asked before the last look, so that nothing handed over before stop() is left.
    const bool last = stopping_;
    const MonotonicTime now = monotonic_now();
    if (!is_open && (last || now >= next_open)) {
      is_open = open();
      next_open = now + kOpenEvery;
    }
    if (is_open) {
      write_all();
    }
    if (is_open && now >= next_measure) {
      measure_room();
      next_measure = now + kMeasureEvery;
    }
    if (last) {
      const std::lock_guard lock(mutex_);
      over_ = true;
      return;
    }
    sleep_until(now + kLookEvery);
  }
}

bool RecordingWriter::open() {
  const bool opened = static_cast<bool>(store_.open());
  std::string told;
  {
    const std::lock_guard lock(mutex_);
    open_ = opened;
    if (opened) {
      trouble_.clear();
    } else if (trouble_ != store_.message()) {
      trouble_ = store_.message();
      told = trouble_;
    }
  }
  if (!told.empty()) {
    tell_("recorder: " + told);
  }
  if (opened) {
    measure_room();
  }
  return opened;
}

/// Reads the folder, so it is done now and then.
void RecordingWriter::measure_room() {
  const std::int64_t room_mb = store_.room_mb().value_or(0);
  const std::lock_guard lock(mutex_);
  room_mb_ = room_mb;
}

void RecordingWriter::write_all() {
  while (const auto outcome = recorder_->write_next(store_)) {
    take(*outcome);
  }
}

void RecordingWriter::take(const RecordingOutcome& outcome) {
  using End = RecordingOutcome::End;
  Ended ended{outcome.requests, {RecordAnswer::State::kNotWritten, {}}};
  std::string told;
  switch (outcome.end) {
    case End::kWritten:
      ended.answer = {RecordAnswer::State::kWritten, store_.path()};
      told = "written, " + store_.path();
      break;
    case End::kFailed: ended.answer.words = told = store_.message(); break;
    case End::kRefused: ended.answer.words = told = "no memory for it, earlier ones wait"; break;
  }
  {
    const std::lock_guard lock(mutex_);
    if (outcome.end == End::kWritten) {
      last_ = store_.path();
      trouble_.clear();
    } else if (outcome.end == End::kFailed) {
      trouble_ = store_.message();
    }
    ended_.push_back(std::move(ended));
    if (ended_.size() > kMostEnded) {
      ended_.pop_front();
    }
  }
  tell_("recorder: " + told);
}

RecordAnswer RecordingWriter::answer(std::uint32_t number) const {
  const std::lock_guard lock(mutex_);
  for (const Ended& ended : ended_) {
    if (ended.requests.hold(number)) {
      return ended.answer;
    }
  }
  if (over_) {
    return {RecordAnswer::State::kNotWritten,
            "the box ended before it was written" + (open_ ? "" : ": " + trouble_)};
  }
  if (!open_) {
    return {RecordAnswer::State::kWaits,
            "not written yet, waits for the folder: " + trouble_ +
                "; kept while memory has room for it, status will tell"};
  }
  return {};
}

RecorderReport RecordingWriter::report() const {
  RecorderReport report;
  report.folder = settings_.folder;
  report.needed_mb = settings_.recorder.memory_mb;
  report.counters = recorder_->counters();
  const std::lock_guard lock(mutex_);
  report.open = open_;
  report.room_mb = room_mb_;
  report.last = last_;
  report.trouble = trouble_;
  return report;
}

}  // namespace tubesight::board
