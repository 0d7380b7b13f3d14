#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "board/box/box_loop.h"
#include "board/visionbox/field_source.h"
#include "board/visionbox/kept_link.h"
#include "board/visionbox/lamp_keeper.h"
#include "board/visionbox/latency_histogram.h"
#include "board/visionbox/pairs_writer.h"
#include "board/visionbox/real_time.h"
#include "board/visionbox/wakeup.h"
#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/snapshot.h"

namespace tubesight::board {

/// What the tracking thread leaves after each turn, for whoever wants to know.
struct TrackingStatus {
  core::Sighting sighting;
  BoxCounters counters;
  std::int64_t source_errors = 0;     ///< turns in which the source said that it is gone
  std::int64_t late = 0;              ///< fields whose sighting came after the deadline
  LatencyHistogram step;              ///< from the field in hand to everything done that follows
  LatencyHistogram grab_to_sighting;  ///< from the field's instant to the same
  bool lamp = false;                  ///< somebody dims it
  std::int32_t lamp_permille = 0;     ///< level in force
  bool lamp_automatic = false;        ///< it follows the picture: nobody has commanded one
  bool lamp_ruled = false;            ///< by the box: by the picture, or a pattern
  core::lighting::LampCondition lamp_condition = core::lighting::LampCondition::kUnknown;
  bool scheduled = false;  ///< the thread has SCHED_FIFO
};

/// How a lamp is that somebody dims: of one that takes its levels only the picture shows that it
/// shines.
[[nodiscard]] drivers::Health lamp_health(bool device_fails,
                                          core::lighting::LampCondition condition);

/// The thread that tracks: takes each field from the source at its instant, steps, answers.
///
/// Whatever happens to the source, a turn is made at its rate, without a field where there is none.
/// A turn allocates nothing and waits for the source alone.
class TrackingThread {
 public:
  using Loop = BoxLoop<core::FixedPoint>;

  /// Whom the robot's view of the box comes from and goes to; null: there is none.
  struct Told {
    KeptLink* link = nullptr;
    const LampKeeper* lamp = nullptr;
    const PairsWriter* pairs = nullptr;
  };

  /// All outlive the thread. The loop and the source are started by others. The robot reads over
  /// the link how the box is doing.
  TrackingThread(Loop& loop, FieldSource& source, const Told& told,
                 const RealTimeSettings& settings);
  TrackingThread(const TrackingThread&) = delete;
  TrackingThread& operator=(const TrackingThread&) = delete;
  ~TrackingThread() { stop(); }

  /// Runs turns on a thread of its own from now on. Says why that has no real-time priority; empty
  /// where it has, or none was wanted.
  [[nodiscard]] std::string start();
  void stop();

  /// Judges no field from now on: each turn is one without a field, at their rate, and nothing can
  /// be started. Before start(), for a box that computes otherwise than it must.
  void judge_nothing() { judges_ = false; }

  /// One turn, on the thread that calls: what start() repeats.
  void turn();

  /// Turns made so far. Any thread.
  [[nodiscard]] std::int64_t turns() const { return turns_; }

  /// What the last turn left; false before the first. Any thread.
  [[nodiscard]] bool status(TrackingStatus& status) const { return latest_.try_read(status); }

 private:
  void run();
  void measure();
  void publish();
  void tell_robot();

  Loop* loop_;
  FieldSource* source_;
  Told told_;
  RealTimeSettings settings_;
  bool judges_ = true;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::int64_t> turns_{0};
  std::string no_priority_;  ///< why; written before ready_
  Wakeup ready_;
  TrackingStatus now_;
  std::int64_t dimmer_errors_ = 0;  ///< at the turn before
  core::Snapshot<TrackingStatus> latest_;
  MonotonicTime next_without_{0};  ///< when a turn without a field is due
};

}  // namespace tubesight::board
