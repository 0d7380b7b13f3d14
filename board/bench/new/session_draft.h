#pragma once

#include <array>
#include <string>

#include "board/bench/new/video_facts.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// What a new session says.
struct SessionDraft {
  std::string video;
  VideoFacts facts;
  std::string camera_file;      ///< included in place of `camera`; empty: none
  core::CameraSettings camera;  ///< with `scan` in any case
  std::string camera_from;      ///< where `camera` comes from, in words
  bool triangular = false;
  double pitch_mm = 0.0;
  double bore_mm = 0.0;
  core::Weld weld = core::Weld::kFlush;
  std::array<double, 3> tool_mm{};
  std::array<double, 3> tool_deg{};
  bool tool_known = false;
  bool tool_seen = false;    ///< turned as the first frame shows the plate
  bool has_address = false;  ///< of the tube-end in the middle: clicks are written
  core::TubeAddress address;
  core::MotionSettings motion;
};

/// Lowers the largest acceleration until fields come often enough for it on this sheet, at the
/// video's rate; where that is not known nothing changes.
void fit_motion(const core::TubesheetSettings& sheet, SessionDraft& draft);

/// The session's file, with a comment at each key.
[[nodiscard]] std::string draft_text(const SessionDraft& draft);

}  // namespace tubesight::board
