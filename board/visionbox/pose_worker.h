#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "board/box/pose_handover.h"
#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/wakeup.h"

namespace tubesight::board {

/// The thread that computes poses, at the priority of every other.
class PoseWorker {
 public:
  /// `handover` outlives the worker.
  explicit PoseWorker(PoseHandover& handover) : handover_(&handover) {}
  PoseWorker(const PoseWorker&) = delete;
  PoseWorker& operator=(const PoseWorker&) = delete;
  ~PoseWorker() { stop(); }

  void start() {
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
  }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }

 private:
  /// Half a field: looked at that often, what is handed over never fills its slots while the thread
  /// is idle, and the tracking thread has nobody to wake.
  static constexpr std::chrono::milliseconds kEvery{8};

  void run() {
    use_signal_stack();
    while (!stopping_) {
      if (!handover_->serve()) {
        sleep_until(monotonic_now() + kEvery);
      }
    }
  }

  PoseHandover* handover_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
};

}  // namespace tubesight::board
