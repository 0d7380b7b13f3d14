#pragma once

#include <memory>
#include <optional>

#include "board/visionbox/aravis_camera.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/camera_source.h"
#include "board/visionbox/lamp_device.h"
#include "board/visionbox/lamp_keeper.h"
#include "board/visionbox/v4l2_camera.h"
#include "board/visionbox/watched_world.h"

namespace tubesight::board {

/// The camera that settings name.
[[nodiscard]] inline std::unique_ptr<Camera> make_camera(const SourceSettings& source,
                                                         const hal::Clock& clock) {
  if (source.kind == SourceKind::kAravis) {
    return std::make_unique<AravisCamera>(source.aravis, clock);
  }
  return std::make_unique<V4l2Camera>(source.v4l2, clock);
}

/// A camera, with a lamp where one is dimmed, and nobody but the real robot and the real operator.
class CameraWorld final : public WatchedWorld {
 public:
  /// `settings` and `station` outlive the world.
  CameraWorld(const BoxSettings& settings, hal::OperatorStation& station,
              const CameraSource::Tell& tell)
      : station_(&station),
        camera_(make_camera(settings.source, clock_)),
        source_(*camera_, tell),
        lamp_(make_lamp(settings.lamp)) {
    if (lamp_ != nullptr) {
      keeper_.emplace(*lamp_, settings.lamp.care, tell);
    }
  }

  [[nodiscard]] FieldSource& source() override { return source_; }
  [[nodiscard]] const FieldSource& source() const override { return source_; }
  [[nodiscard]] hal::Dimmer* dimmer() override { return keeper_ ? &*keeper_ : nullptr; }
  [[nodiscard]] hal::RobotLink* scripted_robot() override { return nullptr; }
  [[nodiscard]] hal::OperatorStation& station() override { return *station_; }
  [[nodiscard]] std::optional<CameraStatus> camera() const override {
    CameraStatus status = camera_->status();
    status.doubt = source_.doubt();
    return status;
  }
  [[nodiscard]] const hal::LampHistory* lamp_history() const override { return lamp(); }
  [[nodiscard]] LampKeeper* lamp() override { return keeper_ ? &*keeper_ : nullptr; }
  [[nodiscard]] const LampKeeper* lamp() const override { return keeper_ ? &*keeper_ : nullptr; }

 private:
  hal::OperatorStation* station_;
  SystemClock clock_;
  std::unique_ptr<Camera> camera_;
  CameraSource source_;
  std::unique_ptr<LampDevice> lamp_;  ///< null: nobody dims it
  std::optional<LampKeeper> keeper_;
};

}  // namespace tubesight::board
