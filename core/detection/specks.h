#pragma once

#include <cstdint>
#include <span>

#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// The picture without single pixels far brighter or darker than all but one of those around them,
/// which noise on a line leaves. `scratch`, which it is made in, holds as many pixels.
[[nodiscard]] picture::AveragedPicture remove_specks(const picture::AveragedPicture& picture,
                                                     std::span<std::uint16_t> scratch);

}  // namespace tubesight::core::detection
