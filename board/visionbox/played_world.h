#pragma once

#include <memory>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/field_player.h"
#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/played_source.h"
#include "board/visionbox/script_ports.h"
#include "board/visionbox/watched_world.h"

namespace tubesight::board {

/// A recording or a scenario, with its lamp, its robot and its operator.
class PlayedWorld final : public WatchedWorld {
 public:
  /// `settings` and `station` outlive the world. `scripted_robot`: there is no real one.
  PlayedWorld(const BoxSettings& settings, hal::OperatorStation& station, bool scripted_robot,
              PlayedSource::Tell tell);

  [[nodiscard]] FieldSource& source() override { return source_; }
  [[nodiscard]] const FieldSource& source() const override { return source_; }
  [[nodiscard]] hal::Dimmer* dimmer() override { return player_->has_lamp() ? &dimmer_ : nullptr; }
  [[nodiscard]] hal::RobotLink* scripted_robot() override { return &robot_; }
  [[nodiscard]] hal::OperatorStation& station() override { return station_; }
  [[nodiscard]] std::optional<CameraStatus> camera() const override { return {}; }
  [[nodiscard]] const hal::LampHistory* lamp_history() const override {
    return player_->has_lamp() ? &lamp_ : nullptr;
  }
  [[nodiscard]] LampKeeper* lamp() override { return nullptr; }
  [[nodiscard]] const LampKeeper* lamp() const override { return nullptr; }

 private:
  std::unique_ptr<FieldPlayer> player_;
  PlayedSource source_;
  PlayedDimmer lamp_{source_};
  PanicDimmer dimmer_{lamp_};
  ScriptedLink robot_{source_};
  ScriptedStation station_;
};

}  // namespace tubesight::board
