#include "drivers/v4l2/pixel_format.h"

#include <cstring>

#include <linux/videodev2.h>

namespace tubesight::drivers::v4l2 {
namespace {

constexpr std::array<PixelFormat, 6> kFormats{{
    {"GREY", V4L2_PIX_FMT_GREY, 1, 0, 0},
    {"NV12", V4L2_PIX_FMT_NV12, 1, 0, 0},
    {"YUYV", V4L2_PIX_FMT_YUYV, 2, 0, 0},
    {"UYVY", V4L2_PIX_FMT_UYVY, 2, 1, 0},
    {"Y10", V4L2_PIX_FMT_Y10, 2, 0, 2},
    {"Y16", V4L2_PIX_FMT_Y16, 2, 0, 8},
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

// Plain loops over whole words: the compiler makes vector instructions of them.
void extract_line(const PixelFormat& format, const std::byte* from, std::int32_t width_px,
                  std::uint8_t* to) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(from);
  if (format.shift == 0) {
    const std::uint8_t* const first = bytes + format.first_byte;
    for (std::int32_t u = 0; u < width_px; ++u) {
      to[u] = first[2 * u];
    }
    return;
  }
  // More bits than the format has would be another format's: such a value is as bright as it gets.
  const std::uint32_t shift = static_cast<std::uint32_t>(format.shift);
  for (std::int32_t u = 0; u < width_px; ++u) {
    const std::uint32_t value = bytes[2 * u] | static_cast<std::uint32_t>(bytes[2 * u + 1]) << 8;
    const std::uint32_t grey = value >> shift;
    to[u] = static_cast<std::uint8_t>(grey < 255 ? grey : 255);
  }
}

}  // namespace tubesight::drivers::v4l2
