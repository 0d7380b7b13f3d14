#pragma once

#include <cstdint>
#include <string>

#include "board/bench/output/exit_status.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// Whether frames of a recording follow each other closely.
struct FrameGaps {
  ExitStatus status = ExitStatus::kDone;  ///< kJobFailed: they do not
  std::string message;  ///< why not kDone; for kJobFailed what follows the recording's name
};

/// Looks for a gap in the fields of frames `first` to `last` in which the tool could have gone from
/// under one tube to under the next: pictures on both sides of it that agree would prove nothing,
/// as one place of a bare lattice looks like the other.
///
/// Each field must be good, come after the one before and be numbered on, and its time must be too
/// short for [motion] to cover 0.8 of the distance between neighbouring tubes. kWrongInput: the
/// recording or its meta file cannot be used. With `ignore_scan_flag` the settings say the order of
/// lines, whatever the recording's flag says.
[[nodiscard]] FrameGaps find_frame_gaps(const core::SessionSettings& settings,
                                        const std::string& recording, std::int64_t first,
                                        std::int64_t last, bool ignore_scan_flag = false);

}  // namespace tubesight::board
