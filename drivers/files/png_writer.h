#pragma once

#include <cstdint>
#include <string>

#include "core/base/image_view.h"
#include "core/base/result.h"

namespace tubesight::drivers {

/// What becomes of greys where a picture has more than the 256 colours of a palette.
enum class PngGreys : std::uint8_t {
  kExact,  ///< they stay, and the picture takes three times the time
  kNear,   ///< the rarest become a neighbour, one grey level off, where that is enough
};

/// Writes a picture as PNG that appears under its name only when whole; an existing one is
/// replaced.
///
/// Quick rather than small compression; up to 256 colours as a palette. Errors: kIo, and `message`
/// is one line with the path.
[[nodiscard]] core::Result<void> write_png(const std::string& path, const core::ImageView& grey,
                                           std::string& message);
[[nodiscard]] core::Result<void> write_png(const std::string& path, const core::RgbImageView& rgb,
                                           std::string& message, PngGreys greys = PngGreys::kExact);

}  // namespace tubesight::drivers
