#pragma once

#include <memory>
#include <optional>
#include <string>

#include "board/visionbox/field_player.h"
#include "core/base/settings.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {

/// Plays a recording. With `script` the clicks of `[start]` come before its first field, and its
/// event file is played as well: what `tubesight replay` does.
class ReplayPlayer final : public FieldPlayer {
 public:
  /// `session` outlives the player.
  ReplayPlayer(const core::SessionSettings& session, std::string recording, bool script)
      : session_(&session), recording_(std::move(recording)), script_(script) {}

  [[nodiscard]] core::Result<void> start(drivers::Messages& messages) override;
  void stop() override;
  [[nodiscard]] core::Result<void> next(std::int32_t lamp_permille, PlayedField& out,
                                        drivers::Messages& messages) override;
  [[nodiscard]] core::FieldTime span() const override;
  [[nodiscard]] bool has_lamp() const override { return false; }
  [[nodiscard]] std::int32_t fields_ahead() const override { return 6; }

 private:
  const core::SessionSettings* session_;
  std::string recording_;
  bool script_;
  std::unique_ptr<drivers::ReplayFrameGrabber> grabber_;
  std::optional<hal::FieldLease> lease_;
  drivers::ReplayEvents events_;
  bool start_given_ = false;
};

}  // namespace tubesight::board
