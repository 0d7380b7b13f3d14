#pragma once

#include <cstdint>
#include <optional>

#include "board/bench/script/event_script.h"
#include "core/base/result.h"
#include "hal/operator_station.h"
#include "hal/robot_link.h"

namespace tubesight::board {

/// Hands out the script's next row when it is of this origin, or of any where none is named.
class ScriptReader {
 public:
  ScriptReader(EventScript& script, std::optional<core::EventOrigin> origin)
      : script_(&script), origin_(origin) {}

  [[nodiscard]] core::Result<void> start();
  void stop() { started_ = false; }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll();
  /// kNotReady unless started.
  [[nodiscard]] core::Result<void> usable() const;

 private:
  EventScript* script_;
  std::optional<core::EventOrigin> origin_;
  bool started_ = false;
};

/// The robot of a script: says its rows and hears nothing.
class ScriptedRobotLink final : public hal::RobotLink {
 public:
  /// Whose rows the link hands out.
  enum class Rows : std::uint8_t {
    kRobots,  ///< a station has the operator's
    kAll,     ///< there is no station: rows keep their order even where instants are not in order
  };

  /// `script` outlives the link.
  explicit ScriptedRobotLink(EventScript& script, Rows rows = Rows::kRobots)
      : reader_(script, rows == Rows::kAll
                            ? std::nullopt
                            : std::optional<core::EventOrigin>(core::EventOrigin::kRobot)) {}

  [[nodiscard]] core::Result<void> start() override { return reader_.start(); }
  void stop() override { reader_.stop(); }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override {
    return reader_.poll();
  }
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& /*reply*/) override {
    return reader_.usable();
  }
  [[nodiscard]] core::Result<void> send_sighting(const core::Sighting& /*sighting*/) override {
    return reader_.usable();
  }

 private:
  ScriptReader reader_;
};

/// The operator of a script: does its rows and sees nothing.
class ScriptedOperatorStation final : public hal::OperatorStation {
 public:
  /// `script` outlives the station.
  explicit ScriptedOperatorStation(EventScript& script)
      : reader_(script, core::EventOrigin::kOperator) {}

  [[nodiscard]] core::Result<void> start() override { return reader_.start(); }
  void stop() override { reader_.stop(); }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override {
    return reader_.poll();
  }
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& /*reply*/) override {
    return reader_.usable();
  }
  [[nodiscard]] core::Result<void> show(const core::RgbImageView& /*picture*/,
                                        const core::Sighting& /*sighting*/) override {
    return reader_.usable();
  }

 private:
  ScriptReader reader_;
};

}  // namespace tubesight::board
