#pragma once

#include <optional>

#include "board/visionbox/camera.h"
#include "board/visionbox/field_source.h"
#include "board/visionbox/lamp_keeper.h"
#include "hal/dimmer.h"
#include "hal/lamp_history.h"
#include "hal/operator_station.h"
#include "hal/robot_link.h"

namespace tubesight::board {

/// What stands before the box's eye: the source of its fields, and what belongs to it.
class WatchedWorld {
 public:
  virtual ~WatchedWorld() = default;

  [[nodiscard]] virtual FieldSource& source() = 0;
  [[nodiscard]] virtual const FieldSource& source() const = 0;
  /// Null: nobody dims its lamp.
  [[nodiscard]] virtual hal::Dimmer* dimmer() = 0;
  /// The robot of its script, where it has one and no real one takes its place; null: there is
  /// none.
  [[nodiscard]] virtual hal::RobotLink* scripted_robot() = 0;
  /// The operator, beside that of a script where there is one.
  [[nodiscard]] virtual hal::OperatorStation& station() = 0;
  /// How the camera is doing; empty: there is none. Any thread.
  [[nodiscard]] virtual std::optional<CameraStatus> camera() const = 0;
  /// Which level shone when; null: nobody dims the lamp.
  [[nodiscard]] virtual const hal::LampHistory* lamp_history() const = 0;
  /// Who keeps a real lamp; null: there is none.
  [[nodiscard]] virtual LampKeeper* lamp() = 0;
  [[nodiscard]] virtual const LampKeeper* lamp() const = 0;
};

}  // namespace tubesight::board
