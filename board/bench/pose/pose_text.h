#pragma once

#include <array>
#include <optional>
#include <string>

#include "board/bench/output/pose_rows.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"
#include "core/verification/position_correction.h"

namespace tubesight::board {

/// What the summary of one pose is written from.
struct PoseFacts {
  const PoseRow& row;
  const core::pose::PictureOutcome& outcome;
  const core::pose::PoseModel& model;
  const core::tubesheet::SheetMap& map;
  std::int32_t pictures = 1;
  double frame_shift_px = 0.0;
  double field_shift_px = 0.0;
  bool total = false;
  /// No address was given: where the tube-end is that the sheet's frame begins at.
  std::optional<std::array<double, 2>> middle_px{};
};

/// The pose in words and numbers, for a person: six numbers with their standard deviations, offset
/// and tilt from the nearest tube, what was measured and what was not.
[[nodiscard]] std::string pose_text(const PoseFacts& facts);

/// The move that brings the tip under a tube, its uncertainty, and whether the limit is met.
[[nodiscard]] std::string correction_text(const core::verification::PositionCorrection& correction,
                                          const core::verification::CorrectionRequest& request);

}  // namespace tubesight::board
