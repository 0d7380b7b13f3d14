#include "drivers/v4l2/pixel_format.h"

#include <linux/videodev2.h>

namespace tubesight::drivers::v4l2 {
namespace {

constexpr std::array<PixelFormat, 6> kFormats{{
    {"GREY", V4L2_PIX_FMT_GREY, 1, 0, false},
    {"NV12", V4L2_PIX_FMT_NV12, 1, 0, false},
    {"YUYV", V4L2_PIX_FMT_YUYV, 2, 0, false},
    {"UYVY", V4L2_PIX_FMT_UYVY, 2, 1, false},
    {"Y10", V4L2_PIX_FMT_Y10, 2, 0, true},
    {"Y16", V4L2_PIX_FMT_Y16, 2, 1, false},
}};

}  // namespace

const std::array<PixelFormat, 6>& pixel_formats() { return kFormats; }

std::optional<PixelFormat> pixel_format_named(std::string_view name) {
  for (const PixelFormat& format : kFormats) {
    if (format.name == name) {
      return format;
    }
  }
  return {};
}

std::array<char, 5> code_text(std::uint32_t code) {
  std::array<char, 5> text{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto letter = static_cast<unsigned char>(code >> (8 * i) & 0x7f);
    text[i] = letter >= 0x20 && letter < 0x7f ? static_cast<char>(letter) : '?';
  }
  return text;
}

// Plain loops, of which the compiler makes vector instructions where it may (CMakeLists.txt).
void extract_line(const PixelFormat& format, const std::byte* from, std::int32_t width_px,
                  std::uint8_t* to) {
  if (!format.ten_bits) {
    const std::byte* const first = from + format.first_byte;
    for (std::int32_t u = 0; u < width_px; ++u) {
      to[u] = static_cast<std::uint8_t>(first[2 * u]);
    }
    return;
  }
  // The upper 8 of 10 bits. More would be another format's: such a value is as bright as it gets.
  for (std::int32_t u = 0; u < width_px; ++u) {
    const auto low = static_cast<std::uint8_t>(from[2 * u]);
    const auto high = static_cast<std::uint8_t>(from[2 * u + 1]);
    const auto grey = static_cast<std::uint8_t>(low >> 2 | high << 6);
    to[u] = high > 3 ? std::uint8_t{255} : grey;
  }
}

}  // namespace tubesight::drivers::v4l2
