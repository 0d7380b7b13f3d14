#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "board/box/pair_desk.h"

namespace tubesight::board {

/// How the file of pairs is doing, for whoever asks.
struct PairsReport {
  std::string file;  ///< empty: none is written
  std::int64_t written = 0;
  std::int64_t lost = 0;
  std::string trouble;  ///< why the last pair was lost; empty: it was not
};

/// The thread that writes pairs of poses to their file, at the priority of every other.
///
/// A pair that cannot be written (no room on the disk, a file of another kind) is lost, told and
/// counted, and the next one is tried.
class PairsWriter {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `desk` outlives the writer; `tell` takes lines for a person, on the writer's thread.
  PairsWriter(PairDesk& desk, std::string file, Tell tell);
  PairsWriter(const PairsWriter&) = delete;
  PairsWriter& operator=(const PairsWriter&) = delete;
  ~PairsWriter() { stop(); }

  void start();

  /// Writes what was handed over, and ends.
  void stop();

  /// Any thread but the one that tracks.
  [[nodiscard]] PairsReport report() const;

  /// The same counters; any thread, waits for nobody.
  [[nodiscard]] std::int64_t written() const { return written_.load(); }
  [[nodiscard]] std::int64_t lost() const { return failed_.load() + desk_->lost(); }

 private:
  void run();
  void write_all();

  PairDesk* desk_;
  std::string file_;
  Tell tell_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::int64_t> written_{0};
  std::atomic<std::int64_t> failed_{0};
  mutable std::mutex mutex_;  ///< of what follows; never taken by the tracking thread
  std::string trouble_;
};

}  // namespace tubesight::board
