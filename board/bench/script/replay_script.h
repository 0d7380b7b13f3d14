#pragma once

#include "board/bench/script/event_script.h"
#include "core/base/event.h"
#include "core/base/settings.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {

/// The script of a replay: the settings' start, then the recording's event file.
class ReplayScript final : public EventScript {
 public:
  /// `[start]` of the settings becomes a start event before the first field. `recorded` and
  /// `grabber` outlive the script.
  ReplayScript(const core::StartSettings& start, drivers::ReplayEvents& recorded,
               const drivers::ReplayFrameGrabber& grabber);

  /// Leaves the settings' start out: the recording is of a session that had started before.
  void leave_start_out() { started_ = true; }

  /// Leaves out events of fields before the first one: the recording is replayed from there on, and
  /// what was clicked into another picture is no click into that one.
  void begin_at_first_field() { skips_ = true; }

  [[nodiscard]] const core::Event* next() override;
  void take() override;
  [[nodiscard]] core::FieldTime field_time() const override { return grabber_->field_time(); }

 private:
  core::Event start_;
  bool skips_ = false;
  bool started_ = false;  ///< the start was taken, or left out
  drivers::ReplayEvents* recorded_;
  const drivers::ReplayFrameGrabber* grabber_;
};

}  // namespace tubesight::board
