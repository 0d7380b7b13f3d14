#pragma once

#include <optional>

#include "board/bench/new/video_facts.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// A tool to begin with, where nobody has calibrated it: square to the plate as the first frame
/// shows it, its axes along the sheet's, its tip below the tube-end in the picture's middle.
///
/// From the places of the tube-ends by a plane's pose [Collins2014 sec. 3.2]; of the two that the
/// perspective leaves open the better one. Nothing where the plate's pose cannot be had, or is more
/// than 75 degrees aslant.
[[nodiscard]] std::optional<core::ToolSettings> square_tool(const core::CameraSettings& camera,
                                                            const core::TubesheetSettings& sheet,
                                                            const LatticeFacts& lattice);

}  // namespace tubesight::board
