#pragma once

#include <string>

#include "core/base/image_view.h"

namespace tubesight::drivers {

/// A grey picture as JPEG of this quality, 1..100; empty: there was no memory for it.
[[nodiscard]] std::string jpeg_of(const core::ImageView& grey, int quality);

}  // namespace tubesight::drivers
