#include "drivers/files/png_writer.h"

#include <span>
#include <vector>

#include <png.h>

#include "drivers/files/atomic_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> write(const std::string& path, png_uint_32 format, std::int32_t width_px,
                   std::int32_t height_px, const std::uint8_t* pixels, std::int32_t stride_bytes,
                   std::string& message) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = format;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, stride_bytes, nullptr) ==
      0) {
    message = path + ": cannot be written as PNG: " + image.message;
    return Unexpected(Error::kIo);
  }
  AtomicFile file;
  auto outcome = file.open(path);
  if (outcome) {
    outcome = file.write(std::span<const std::byte>(bytes).first(size));
  }
  if (outcome) {
    outcome = file.commit();
  }
  if (!outcome) {
    message = file.message();
  }
  return outcome;
}

}  // namespace

Result<void> write_png(const std::string& path, const core::ImageView& grey, std::string& message) {
  return write(path, PNG_FORMAT_GRAY, grey.width_px, grey.height_px, grey.pixels, grey.stride_px,
               message);
}

Result<void> write_png(const std::string& path, const core::RgbImageView& rgb,
                       std::string& message) {
  return write(path, PNG_FORMAT_RGB, rgb.width_px, rgb.height_px, rgb.pixels, rgb.stride_bytes,
               message);
}

}  // namespace tubesight::drivers
