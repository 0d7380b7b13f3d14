#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tubesight::board {

/// What takes longer than a moment, one after the other on a thread of little priority. Bounded.
class SideJobs {
 public:
  static constexpr std::size_t kMost = 8;

  SideJobs() = default;
  SideJobs(const SideJobs&) = delete;
  SideJobs& operator=(const SideJobs&) = delete;
  ~SideJobs() { stop(); }

  /// `begin` is called first on the thread.
  void start(std::function<void()> begin);
  /// Forgets what was not begun, and waits for what was.
  void stop();

  /// False: too many wait, and this one is not done.
  [[nodiscard]] bool add(std::function<void()> job);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace tubesight::board
