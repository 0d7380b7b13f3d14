#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "board/bench/output/exit_status.h"
#include "board/bench/output/overlay_sink.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/result_files.h"
#include "board/bench/replay/replay_statistics.h"
#include "board/box/pose_service.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/messages.h"
#include "drivers/files/pairs_file.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {

/// What a replay reads; all opened and checked.
struct ReplayInputs {
  const std::string& session;    ///< name of the settings file, for messages
  const std::string& recording;  ///< name of the recording, for the rows of poses
  const core::SessionSettings& settings;
  drivers::ReplayFrameGrabber& grabber;
  drivers::ReplayEvents& events;
  /// The session's state before the first field, as a box's recorder wrote it; without one the
  /// session begins with the recording, and with the settings' start.
  std::optional<std::span<const std::byte>> state;
  double length_s = 0.0;  ///< of a video, as it says of itself; 0: not known
};

/// What a replay writes; all opened, nothing committed.
struct ReplayOutputs {
  ResultFiles& results;
  OverlaySink* overlay;  ///< null: none wanted
  bool overlay_estimates;
  PoseService& poses;
  std::string& pose_rows;        ///< of `pose --csv`, one a request computed
  drivers::AtomicFile* replies;  ///< rows of answers are appended; null: none wanted
  drivers::PairsText* pairs;     ///< of poses by the robot and by the box; null: none wanted
  ReplayStatistics& statistics;
  ProgressLine& progress;
};

/// How the fields of a replay ended.
struct ReplayEnd {
  ExitStatus status = ExitStatus::kDone;
  bool cut_short = false;      ///< the recording is; all of its complete part was replayed
  drivers::Messages messages;  ///< for standard error
};

/// Replays all fields: the session in arithmetic S, its answers to the outputs.
///
/// kWrongInput: the settings are beyond the arithmetic, the state is none of theirs, or the
/// recording proved to be corrupt or at odds with its meta file. kJobFailed: an output cannot be
/// written.
template <core::Scalar S>
[[nodiscard]] ReplayEnd replay_fields(ReplayInputs inputs, ReplayOutputs outputs);

}  // namespace tubesight::board
