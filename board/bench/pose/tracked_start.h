#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "board/bench/cold_start/cold_start.h"
#include "board/bench/output/exit_status.h"
#include "board/bench/pose/pose_starts.h"
#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// The frame of a recording that clicks were made in.
struct StartFrame {
  std::int64_t frame = 0;   ///< counted from 0; the clicks hold in its first field
  bool with_events = true;  ///< starts of the recording's event file count, too, as in a replay
  bool ignore_scan_flag = false;  ///< the settings say the order of lines, not the recording
};

/// Where the tube-ends of a recording are in one of its frames.
struct TrackedFrame {
  ExitStatus status = ExitStatus::kDone;  ///< kJobFailed: not known there
  std::string message;  ///< why not kDone: what follows the frame's name, without a line end
  PictureStarts tubes;  ///< tube-ends measured in the frame's last field, at their centres
  /// The tube nearest to the guidetube's axis, beyond doubt; none where that is not known.
  std::optional<core::TubeAddress> tool;
};

/// Follows the tubes of a start through a recording: clicks belong to a frame, and what stands at
/// the same places in another one is known by tracking from there alone.
///
/// It is the tracking of `replay`, fixed point, with the recording's meta file; a frame counts when
/// each of its fields is tracked, neither degraded nor coasting. Holds a session, some 0.5 MB.
class TrackedStart {
 public:
  /// In each recording the tracking starts from the clicks: of more than core::kMaxStartPoints
  /// the first ones. `settings` must outlive this object; of its start the window and the optimum
  /// are used.
  /// One or two clicks become a start by `cold`, which must outlive this object, in each recording.
  TrackedStart(const core::SessionSettings& settings, const PictureStarts& clicks, StartFrame where,
               ColdStart* cold = nullptr);
  TrackedStart(const TrackedStart&) = delete;
  TrackedStart& operator=(const TrackedStart&) = delete;
  ~TrackedStart();

  /// The tube-ends in a frame not before the clicks'. Frames of one recording in rising order take
  /// one pass over it. kWrongInput: recording, meta or event file cannot be used, or the settings
  /// are beyond the tracking's arithmetic.
  [[nodiscard]] TrackedFrame find(const std::string& recording, std::int64_t frame);

 private:
  struct Run;

  const core::SessionSettings& settings_;
  core::StartSettings start_;
  void set_start(const PictureStarts& places);
  /// Why the recording's first field tells no start of one or two clicks; empty: it does.
  [[nodiscard]] std::string expand(const std::string& recording);

  PictureStarts clicks_;
  StartFrame where_;
  ColdStart* cold_;
  std::unique_ptr<Run> run_;  ///< the recording being followed, or none
};

/// Whether places in two pictures can be those of the same tube-ends, with nothing moved between:
/// each tube that both name lies nearer to itself than half way to any other, and there is one.
[[nodiscard]] bool agree_on_tubes(const PictureStarts& one, const PictureStarts& other);

}  // namespace tubesight::board
