#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "board/bench/cold_start/cold_start.h"
#include "board/bench/output/exit_status.h"
#include "board/bench/output/still_reader.h"
#include "board/bench/pose/pose_starts.h"
#include "board/bench/pose/tracked_start.h"
#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// The clicks of a `pose`, and what is to be done with them.
struct StillClicks {
  PictureStarts places;
  StartFrame where;         ///< of recordings: the frame that they were made in
  bool only_start = false;  ///< the pose uses the tubes named and no others
};

/// Where a pose begins, or why nobody knows which tubes its stills show.
struct TubesFound {
  ExitStatus status = ExitStatus::kDone;  ///< kJobFailed: not known
  std::string message;                    ///< why not kDone, beginning with a file's name
  PictureStarts places;                   ///< tube-ends in the first still
  std::optional<core::TubeAddress> tool;  ///< what the tracking sees above the guidetube
};

/// Tells which tube-ends are where in stills of one pose. Clicks belong to a picture: elsewhere
/// the same place may show the next tube, and nothing in the picture tells.
///
/// - A picture's file: the clicks, as the user says so. Likewise the frame they were made in, when
///   the recording does not call it damaged.
/// - Another frame of a recording: the tubes tracked to it from there.
/// - A frame behind another one of the same pose: nothing moved between the two, as they agree
///   (StillAverager) and follow each other (find_frame_gaps()).
class StillTubes {
 public:
  /// `settings` must outlive this object.
  /// With `cold`, which must too, one or two clicks will do: in a still that was clicked in they
  /// are given back as they are.
  StillTubes(const core::SessionSettings& settings, StillClicks clicks, ColdStart* cold = nullptr);

  /// Whether the clicks themselves tell the still's tubes; else it is tracked, for which the
  /// settings need a tool.
  [[nodiscard]] bool was_clicked(const Still& still) const {
    return still.frame < 0 || still.frame == clicks_.where.frame;
  }

  /// The tubes in the stills of one pose, at least one.
  [[nodiscard]] TubesFound find(std::span<const Still> stills);

 private:
  TubesFound find_in(const Still& still);
  [[nodiscard]] TubesFound choose(const Still& still, TubesFound tracked) const;

  const core::SessionSettings& settings_;
  StillClicks clicks_;
  ColdStart* cold_;
  std::unique_ptr<TrackedStart> tracked_;  ///< made when a still needs it
};

}  // namespace tubesight::board
