#pragma once

#include <optional>

#include "board/visionbox/played_source.h"
#include "core/base/result.h"
#include "hal/operator_station.h"
#include "hal/robot_link.h"

namespace tubesight::board {

/// The robot that a played source's script tells of: says its rows and hears nothing.
class ScriptedLink final : public hal::RobotLink {
 public:
  /// `source` outlives the link.
  explicit ScriptedLink(PlayedSource& source) : source_(&source) {}

  [[nodiscard]] core::Result<void> start() override;
  void stop() override { started_ = false; }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  [[nodiscard]] core::Result<void> send_sighting(const core::Sighting& sighting) override;

 private:
  PlayedSource* source_;
  bool started_ = false;
};

/// The operator of the box: does first what a played source's script says, then what the station
/// does. Answers to the script are heard by nobody.
class ScriptedStation final : public hal::OperatorStation {
 public:
  /// Ids of the station's events begin here; those of scripts are smaller.
  static constexpr std::int64_t kFirstStationId = std::int64_t{1} << 48;

  /// Both outlive this. Without a link to say them, rows of the robot are left out.
  ScriptedStation(PlayedSource& source, hal::OperatorStation& station, bool scripted_link)
      : source_(&source), station_(&station), scripted_link_(scripted_link) {}

  [[nodiscard]] core::Result<void> start() override { return station_->start(); }
  void stop() override { station_->stop(); }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  [[nodiscard]] core::Result<void> show(const core::RgbImageView& picture,
                                        const core::Sighting& sighting) override {
    return station_->show(picture, sighting);
  }

 private:
  PlayedSource* source_;
  hal::OperatorStation* station_;
  bool scripted_link_;
};

}  // namespace tubesight::board
