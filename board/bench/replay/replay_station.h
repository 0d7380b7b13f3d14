#pragma once

#include <optional>

#include "board/bench/output/overlay_sink.h"
#include "board/bench/script/event_script.h"
#include "board/bench/script/scripted_ports.h"
#include "core/base/result.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "hal/operator_station.h"

namespace tubesight::board {

/// The operator of a replay: does what the script says, and sees the pictures of `--overlay`.
class ReplayStation final : public hal::OperatorStation {
 public:
  /// `pictures` is null when nobody wants to see; else it is open. All outlive the station.
  ReplayStation(EventScript& script, const drivers::ReplayFrameGrabber& grabber,
                OverlaySink* pictures)
      : operator_(script), grabber_(&grabber), pictures_(pictures) {}

  [[nodiscard]] core::Result<void> start() override { return operator_.start(); }
  void stop() override { operator_.stop(); }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override {
    return operator_.poll_event();
  }
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override {
    return operator_.send_reply(reply);
  }
  /// Writes the picture under the number of the field last grabbed. kIo: it cannot be written, and
  /// the sink's message tells why.
  [[nodiscard]] core::Result<void> show(const core::RgbImageView& picture,
                                        const core::Sighting& sighting) override {
    TUBESIGHT_TRY(operator_.show(picture, sighting));
    return pictures_ != nullptr ? pictures_->add(grabber_->field_number(), picture)
                                : core::Result<void>();
  }

 private:
  ScriptedOperatorStation operator_;
  const drivers::ReplayFrameGrabber* grabber_;
  OverlaySink* pictures_;
};

}  // namespace tubesight::board
