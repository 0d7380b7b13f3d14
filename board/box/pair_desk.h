#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/pose_pair.h"
#include "core/base/reply.h"
#include "core/base/spsc_queue.h"

namespace tubesight::board {

/// Brings together what the robot told of its own pose with a request, and what the box then
/// measured: pairs, by which the robot's base is calibrated.
///
/// A pair is made only where the pose was confirmed: a tube that the box did not see, or another
/// one, would put the base a tube off. take() is of the tracking thread, never waits and never
/// allocates; take_pair() is of another one, or the same.
class PairDesk {
 public:
  /// Takes the events and the answers of a step.
  void take(const core::EventList& events, const core::ReplyList& replies);

  /// The next pair, in their order.
  [[nodiscard]] std::optional<core::PosePair> take_pair();

  /// Pairs that found no room so far: nobody took them. Any thread.
  [[nodiscard]] std::int64_t lost() const { return lost_.load(); }

 private:
  /// A request takes some fields of standing still; a disk that hangs longer than eight of them is
  /// gone.
  static constexpr std::uint32_t kRoom = 8;

  struct Told {
    std::int64_t id = 0;
    core::EventOrigin origin = core::EventOrigin::kRobot;
    core::RobotPose robot;
  };

  std::optional<Told> told_;  ///< with the request that is under way
  core::SpscQueue<core::PosePair, kRoom> pairs_;
  std::atomic<std::int64_t> lost_{0};
};

}  // namespace tubesight::board
