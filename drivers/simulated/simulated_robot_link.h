#pragma once

#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/result.h"
#include "drivers/simulated/dice.h"
#include "drivers/simulated/simulated_robot.h"
#include "hal/robot_link.h"

namespace tubesight::drivers {

/// What a line does to messages, in both directions.
struct LineNoise {
  double lost = 0.0;     ///< share of the messages that never arrive
  double garbled = 0.0;  ///< share that arrives unreadable
  std::uint64_t seed = 1;
};

/// The line to a simulated robot, as fast as it is asked, with noise if wanted.
class SimulatedRobotLink final : public hal::RobotLink {
 public:
  /// `robot` outlives the link.
  explicit SimulatedRobotLink(SimulatedRobot& robot, const LineNoise& noise = {})
      : robot_(&robot), noise_(noise), dice_(noise.seed) {}

  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  [[nodiscard]] core::Result<void> send_sighting(const core::Sighting& sighting) override;

  /// Pulls the plug (false), or puts it in again. What is sent meanwhile is lost.
  void connect(bool connected) { connected_ = connected; }

 private:
  enum class Fate : std::uint8_t { kArrives, kLost, kGarbled };

  [[nodiscard]] core::Result<void> usable();
  [[nodiscard]] Fate fate();
  void forget_messages();

  SimulatedRobot* robot_;
  LineNoise noise_;
  Dice dice_;
  bool started_ = false;
  bool connected_ = true;
};

}  // namespace tubesight::drivers
