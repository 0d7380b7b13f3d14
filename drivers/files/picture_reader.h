#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/image_view.h"
#include "core/base/result.h"

namespace tubesight::drivers {

/// A grey picture that owns its pixels, line by line without padding.
struct GreyPicture {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint8_t> pixels;

  [[nodiscard]] core::ImageView view() const {
    return {pixels.data(), width_px, height_px, width_px};
  }
};

/// Reads a still: PNG (grey, colour or palette, a colour one by its BT.601 luma; 16 bits are
/// rounded to 8) or binary PGM with 255 as its largest value. Grey values are taken as they are
/// stored, whatever gamma the file names, as measurements need them.
///
/// Errors: kIo the file cannot be read, kInvalidArgument neither PNG nor PGM or damaged,
/// kUnsupported more than 8 bits or more than 8192 pixels a side; `message` is one line with the
/// path.
[[nodiscard]] core::Result<void> read_grey_picture(const std::string& path, GreyPicture& picture,
                                                   std::string& message);

/// Whether a file begins as a PNG or a binary PGM does; false also when it cannot be read.
[[nodiscard]] bool is_grey_picture(const std::string& path);

/// The same from memory; the message comes without a name.
[[nodiscard]] core::Result<void> read_grey_picture(std::span<const std::byte> bytes,
                                                   GreyPicture& picture, std::string& message);

}  // namespace tubesight::drivers
