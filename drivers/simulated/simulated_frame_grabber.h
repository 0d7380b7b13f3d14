#pragma once

#include <chrono>
#include <cstdint>

#include "core/base/result.h"
#include "drivers/simulated/simulated_world.h"
#include "hal/frame_grabber.h"

namespace tubesight::drivers {

/// The camera of a simulated world, as fast as it is asked.
class SimulatedFrameGrabber final : public hal::FrameGrabber {
 public:
  /// Both outlive the grabber. The world belongs to others too (dimmer, robot), but its fields are
  /// drawn by grab_for() alone.
  SimulatedFrameGrabber(SimulatedWorld& world, const Scenario& scenario)
      : world_(&world), scenario_(&scenario) {}

  /// Goes to the start of the scenario. Beside the errors of the interface: those of
  /// SimulatedWorld::configure().
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  /// Never waits; `timeout` is not used.
  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  void give_back(std::int32_t buffer) override;

  /// Events and truth of the field last delivered.
  [[nodiscard]] const SimulatedField& last() const { return last_; }

  /// Fields delivered so far.
  [[nodiscard]] std::int64_t delivered() const { return delivered_; }

  /// The latest instant of a field since start(), and the present of that world.
  [[nodiscard]] core::FieldTime latest_time() const { return latest_time_; }

 private:
  SimulatedWorld* world_;
  const Scenario* scenario_;
  SimulatedField last_;
  std::int64_t delivered_ = 0;
  core::FieldTime latest_time_{0};
  bool started_ = false;
  bool lent_ = false;
};

}  // namespace tubesight::drivers
