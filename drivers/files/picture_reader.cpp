#include "drivers/files/picture_reader.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include <png.h>

#include "drivers/files/byte_source.h"
#include "drivers/files/pgm_reader.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::uint32_t kLargestSide_px = 8192;
constexpr std::size_t kLargestFile = std::size_t{256} << 20;

Result<void> fail(Error error, std::string& message, std::string text) {
  message = std::move(text);
  return Unexpected(error);
}

/// What libpng's callbacks need. libpng reports errors by longjmp, so nothing with a destructor may
/// live in the functions between setjmp and the calls; all memory belongs to the caller.
struct PngInput {
  std::span<const std::byte> rest;
  std::array<char, 80> error{};
};

void png_note_error(png_structp png, png_const_charp text) {
  auto* const input = static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(input->error.data(), text, input->error.size() - 1);
  png_longjmp(png, 1);
}

void png_ignore_warning(png_structp, png_const_charp) {}

void png_take_bytes(png_structp png, png_bytep into, std::size_t count) {
  auto* const input = static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > input->rest.size()) {
    png_error(png, "the file ends early");
  }
  std::memcpy(into, input->rest.data(), count);
  input->rest = input->rest.subspan(count);
}

struct PngShape {
  png_uint_32 width_px = 0;
  png_uint_32 height_px = 0;
  int channels = 0;
};

/// Reads up to the pixels and asks for 8-bit grey or RGB without alpha.
bool read_png_shape(png_structp png, png_infop info, PngInput& input, PngShape& shape) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_read_fn(png, &input, png_take_bytes);
  png_set_user_limits(png, 0x7FFFFFFF, 0x7FFFFFFF);
  png_read_info(png, info);
  shape.width_px = png_get_image_width(png, info);
  shape.height_px = png_get_image_height(png, info);
  png_set_scale_16(png);  // 16 bits to the nearest of 8
  png_set_expand(png);
  png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  shape.channels = png_get_channels(png, info);
  return true;
}

bool read_png_pixels(png_structp png, png_bytepp lines) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  // More lines in the data than the header says are an error too, not a warning: the width may be
  // what is wrong. Of what follows the pixels (texts, profiles) nothing matters.
  png_set_benign_errors(png, 0);
  png_read_image(png, lines);
  png_set_benign_errors(png, 1);
  png_read_end(png, nullptr);
  return true;
}

void take_luma(const std::vector<std::uint8_t>& rgb, std::vector<std::uint8_t>& grey) {
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const auto* const pixel = rgb.data() + 3 * i;
    grey[i] =
        static_cast<std::uint8_t>((299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2] + 500) / 1000);
  }
}

Result<void> decode_png(png_structp png, png_infop info, PngInput& input, GreyPicture& picture,
                        std::string& message) {
  PngShape shape;
  if (!read_png_shape(png, info, input, shape)) {
    return fail(Error::kInvalidArgument, message,
                std::string("damaged PNG: ") + input.error.data());
  }
  if (shape.width_px > kLargestSide_px || shape.height_px > kLargestSide_px) {
    return fail(Error::kUnsupported, message, "expected at most 8192 pixels a side");
  }
  const std::size_t pixels = std::size_t{shape.width_px} * shape.height_px;
  const auto channels = static_cast<std::size_t>(shape.channels);
  std::vector<std::uint8_t> samples(pixels * channels);
  std::vector<png_bytep> lines(shape.height_px);
  for (std::size_t v = 0; v < lines.size(); ++v) {
    lines[v] = samples.data() + v * shape.width_px * channels;
  }
  if (!read_png_pixels(png, lines.data())) {
    return fail(Error::kInvalidArgument, message,
                std::string("damaged PNG: ") + input.error.data());
  }
  picture.width_px = static_cast<std::int32_t>(shape.width_px);
  picture.height_px = static_cast<std::int32_t>(shape.height_px);
  if (shape.channels == 1) {
    picture.pixels = std::move(samples);
  } else {
    picture.pixels.resize(pixels);
    take_luma(samples, picture.pixels);
  }
  return {};
}

Result<void> read_png(std::span<const std::byte> bytes, GreyPicture& picture,
                      std::string& message) {
  PngInput input{bytes, {}};
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, png_note_error, png_ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_read_struct(&png, &info, nullptr);
    return fail(Error::kIo, message, "no memory to decompress it");
  }
  const auto outcome = decode_png(png, info, input, picture, message);
  png_destroy_read_struct(&png, &info, nullptr);
  return outcome;
}

constexpr std::size_t kPngSignature = 8;

bool is_png(std::span<const std::byte> bytes) {
  return bytes.size() >= kPngSignature &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kPngSignature) == 0;
}

bool is_pgm(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{'P'} && bytes[1] == std::byte{'5'};
}

}  // namespace

Result<void> read_grey_picture(const std::string& path, GreyPicture& picture,
                               std::string& message) {
  std::string text;
  std::string why;
  auto outcome = read_whole_file(path, kLargestFile, text, why);
  if (!outcome) {
    message = path + ": cannot be read: " + why;
    return outcome;
  }
  outcome = read_grey_picture(std::as_bytes(std::span(text.data(), text.size())), picture, why);
  if (!outcome) {
    message = path + ": " + why;
  }
  return outcome;
}

bool is_grey_picture(const std::string& path) {
  std::unique_ptr<ByteSource> source;
  std::string ignored;
  std::array<std::byte, kPngSignature> first{};
  if (!open_file(path, source, ignored)) {
    return false;
  }
  const auto count = source->read(first);
  const auto bytes = std::span<const std::byte>(first).first(count.value_or(0));
  return is_png(bytes) || is_pgm(bytes);
}

Result<void> read_grey_picture(std::span<const std::byte> bytes, GreyPicture& picture,
                               std::string& message) {
  if (is_png(bytes)) {
    return read_png(bytes, picture, message);
  }
  if (is_pgm(bytes)) {
    return read_pgm({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, picture, message);
  }
  return fail(Error::kInvalidArgument, message,
              "neither PNG nor PGM: expected an 8-bit grey still");
}

}  // namespace tubesight::drivers
