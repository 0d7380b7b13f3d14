#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "board/box/journal_desk.h"
#include "board/box/stop_merger.h"
#include "board/visionbox/journal_line.h"
#include "board/visionbox/source_clock.h"
#include "core/base/result.h"
#include "hal/clock.h"
#include "hal/journal.h"

namespace tubesight::board {

/// How the journal is doing, for whoever asks.
struct JournalReport {
  enum class State : std::uint8_t {
    kNone,      ///< none is kept
    kWriting,   ///< what happens is safe at once
    kStanding,  ///< the disk is full, slow or gone: rows wait
  };
  State state = State::kNone;
  std::string file;
  std::int64_t safe = 0;     ///< number of the last row that is safe on the disk
  std::int64_t waiting = 0;  ///< rows that wait for the disk
  std::int64_t lost = 0;     ///< rows that found no room since the start
  std::string trouble;       ///< why it stands still; empty: it does not
};

/// The word of a state.
[[nodiscard]] constexpr std::string_view name_of(JournalReport::State state) {
  switch (state) {
    case JournalReport::State::kNone: return "none";
    case JournalReport::State::kWriting: return "writing";
    case JournalReport::State::kStanding: return "standing still";
  }
  return {};
}

/// A journal that can be opened, and opened again after an error.
class JournalStore {
 public:
  virtual ~JournalStore() = default;
  /// Errors: kIo, with message().
  [[nodiscard]] virtual core::Result<void> open(const hal::JournalRow& begin) = 0;
  virtual void close() = 0;
  [[nodiscard]] virtual hal::Journal& journal() = 0;
  [[nodiscard]] virtual std::string message() const = 0;
  /// What open() did that somebody should know; empty: nothing.
  [[nodiscard]] virtual std::string news() const = 0;
  /// The detail of the newest row of a kind; empty: there is none.
  [[nodiscard]] virtual std::string last_detail(hal::JournalKind kind) = 0;
};

/// What all rows of a start of the program have alike.
struct JournalFrame {
  std::string boot_id;  ///< the kernel's; empty: not known
  std::string version;
  std::string camera_id;
  std::string tool_id;
  std::string base_id;
  std::string settings;  ///< SHA-256 of the settings file; empty: not known
};

/// The thread that writes the journal, at a low priority.
///
/// What the disk does not take waits, as many rows as kMostWaiting; beyond that they are lost, and
/// a row says how many as soon as there is room. The box goes on tracking whatever happens here.
class JournalWriter {
 public:
  using Tell = std::function<void(const std::string&)>;
  /// JPEG of a grey picture; empty: there is none.
  using Compress = std::function<std::string(const core::ImageView&)>;
  /// SHA-256 as 64 hexadecimal digits.
  using Digest = std::function<std::string(std::span<const std::byte>)>;

  struct Parts {
    std::unique_ptr<JournalStore> store;
    Compress compress;
    Digest digest;
  };

  static constexpr std::size_t kMostWaiting = 2000;
  /// An append that takes longer is a disk that stands still.
  static constexpr MonotonicTime kSlow = std::chrono::seconds(2);

  /// `desk` and `fields`, the clock that stamps fields, outlive the writer; `tell` takes lines for
  /// a person, on the writer's thread.
  JournalWriter(JournalDesk& desk, const hal::Clock& fields, std::string file, JournalFrame frame,
                Parts parts, Tell tell);
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;
  ~JournalWriter() { stop(); }

  void start();
  /// Ends the stop under way, writes what waits, as far as the disk takes it, and signs.
  void stop();

  /// Adds a row that did not come from the tracking, at this moment. Any thread but the tracking.
  void add(JournalLine line);
  /// Who is behind an event of the operator's station that will be answered. The same.
  void name(std::int64_t event_id, const std::string& who);

  /// Of the settings that the program was started with.
  [[nodiscard]] const std::string& settings_digest() const { return frame_.settings; }

  /// Any thread but the tracking.
  [[nodiscard]] JournalReport report() const;

  /// One round of the thread: takes what came and writes it. For tests without the thread.
  void round(bool last);

 private:
  static constexpr std::size_t kMostNames = 64;
  static constexpr std::size_t kMostAtOnce = 100;

  void run();
  void take_notes(bool last);
  void put_digest(const JournalDesk::Picture& picture, JournalNote& note) const;
  void queue_all(std::vector<JournalEntry>& entries, core::FieldTime shift, std::string picture);
  void queue(JournalLine line);
  void tell_lost();
  [[nodiscard]] bool write_waiting();
  [[nodiscard]] bool open();
  void compare_settings();
  void fail(const std::string& why);
  void publish();
  [[nodiscard]] std::string who_is(const JournalNote& note);
  [[nodiscard]] hal::JournalRow row_of(const JournalLine& line) const;

  JournalDesk* desk_;
  const hal::Clock* fields_;
  std::string file_;
  JournalFrame frame_;
  Parts parts_;
  Tell tell_;
  StopMerger merger_;

  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::int64_t> busy_since_{0};  ///< of an append under way, monotonic ns; 0: none

  // Of the writing thread.
  std::deque<JournalLine> waiting_;
  std::int64_t untold_ = 0;  ///< rows lost that no row tells of yet
  bool open_ = false;
  bool failed_ = false;    ///< since the last row that was written
  bool compared_ = false;  ///< this start's settings with those of the one before
  MonotonicTime next_try_{0};
  MonotonicTime pause_{0};
  MonotonicTime unsigned_since_{0};

  mutable std::mutex mutex_;  ///< of what follows; never taken by the tracking thread
  std::vector<JournalLine> added_;
  std::map<std::int64_t, std::string> names_;
  JournalReport report_;
};

}  // namespace tubesight::board
