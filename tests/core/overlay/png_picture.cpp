#include "tests/core/overlay/png_picture.h"

#include <cstdio>

#include <png.h>

namespace tubesight::tests {
namespace {

png_image new_image() {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  return image;
}

}  // namespace

std::optional<Picture> read_png(const std::string& path) {
  png_image image = new_image();
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), image.message);
    return std::nullopt;
  }
  image.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<std::int32_t>(image.width), static_cast<std::int32_t>(image.height),
                  std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  if (png_image_finish_read(&image, nullptr, picture.bytes.data(), 0, nullptr) == 0) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), image.message);
    return std::nullopt;
  }
  return picture;
}

bool write_png(const std::string& path, const Picture& picture) {
  png_image image = new_image();
  image.width = static_cast<png_uint_32>(picture.width_px);
  image.height = static_cast<png_uint_32>(picture.height_px);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.bytes.data(), 0, nullptr) == 0) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), image.message);
    return false;
  }
  return true;
}

}  // namespace tubesight::tests
