#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "board/box/event_recorder.h"
#include "board/visionbox/record_settings.h"
#include "core/base/settings.h"
#include "drivers/recording/file_recording_store.h"

namespace tubesight::board {

/// How the recorder is doing, for whoever asks.
struct RecorderReport {
  std::string folder;          ///< empty: nothing is recorded
  bool open = false;           ///< the folder is there
  std::int64_t room_mb = 0;    ///< what is free on its disk, and what older recordings would leave
  std::int64_t needed_mb = 0;  ///< of those, for a recording
  std::string last;            ///< the recording written last: its path without ending
  std::string trouble;         ///< why the last recording or the folder failed; empty: it did not
  RecorderCounters counters;
};

/// What became of a request for a recording.
struct RecordAnswer {
  enum class State : std::uint8_t {
    kPending,
    kWritten,
    kNotWritten,  ///< and never will be
    kWaits,       ///< for its folder, without end; written when that is there and memory held it
  };
  State state = State::kPending;
  std::string words;  ///< its path without ending, or why there is none
};

/// The thread that writes what the recorder hands over, at the priority of every other.
///
/// A folder that is not there is tried again each second; recordings wait for it meanwhile, and
/// where their memory ends, further ones are refused.
class RecordingWriter {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `recorder` outlives the writer. `session` is what the box tracks by; `origin`, one line,
  /// stands above it in each recording; `tell` takes lines for a person, on the writer's thread and
  /// that of start().
  RecordingWriter(EventRecorder& recorder, const RecordSettings& settings,
                  const core::SessionSettings& session, const std::string& origin, Tell tell);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  ~RecordingWriter() { stop(); }

  void start();

  /// Writes what was handed over, and ends. After the recorder's flush().
  void stop();

  /// What became of EventRecorder::request()'s `number`. Any thread.
  [[nodiscard]] RecordAnswer answer(std::uint32_t number) const;

  /// Any thread.
  [[nodiscard]] RecorderReport report() const;

 private:
  struct Ended {
    RecordingRequests requests;
    RecordAnswer answer;
  };

  void run(bool is_open);
  [[nodiscard]] bool open();
  void measure_room();
  void write_all();
  void take(const RecordingOutcome& outcome);

  EventRecorder* recorder_;
  RecordSettings settings_;
  Tell tell_;
  drivers::FileRecordingStore store_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};

  mutable std::mutex mutex_;  ///< of what follows; never taken by the tracking thread
  bool open_ = false;
  bool over_ = false;  ///< nothing is written any more
  std::int64_t room_mb_ = 0;
  std::string last_;
  std::string trouble_;
  std::deque<Ended> ended_;  ///< the latest requests
};

}  // namespace tubesight::board
