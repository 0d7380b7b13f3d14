#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/pose/picture_pose.h"

namespace tubesight::board {

/// Why a picture gave no pose, in one line without the picture's name.
[[nodiscard]] std::string explain(const core::pose::PictureOutcome& outcome,
                                  std::span<const core::pose::PictureStart> starts);

/// What a refusal of the pose means, in a few words for a person; docs/messages.md tells more.
[[nodiscard]] std::string_view explain(core::pose::PoseRefusal refusal);

/// Why a tube-end was not measured, in a few words.
[[nodiscard]] std::string_view explain(core::picture::RimFinding finding);

}  // namespace tubesight::board
