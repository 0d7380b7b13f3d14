#include "drivers/aravis/grey_format.h"

namespace tubesight::drivers::aravis {
namespace {

/// The upper 8 of `bits` bits in two bytes. More would be another format's: such a value is as
/// bright as it gets.
template <unsigned bits>
void take_out_of_words(const std::byte* from, std::int32_t width_px, std::uint8_t* to) {
  for (std::int32_t u = 0; u < width_px; ++u) {
    const unsigned word =
        std::to_integer<unsigned>(from[2 * u]) | std::to_integer<unsigned>(from[2 * u + 1]) << 8;
    to[u] = static_cast<std::uint8_t>(word >> bits != 0 ? 255U : word >> (bits - 8));
  }
}

void take_upper_bytes(const std::byte* from, std::int32_t width_px, std::uint8_t* to) {
  for (std::int32_t u = 0; u + 1 < width_px; u += 2) {
    const std::byte* const group = from + u / 2 * 3;
    to[u] = std::to_integer<std::uint8_t>(group[0]);
    to[u + 1] = std::to_integer<std::uint8_t>(group[2]);
  }
}

void take_twelve_bits(const std::byte* from, std::int32_t width_px, std::uint8_t* to) {
  for (std::int32_t u = 0; u + 1 < width_px; u += 2) {
    const std::byte* const group = from + u / 2 * 3;
    to[u] = std::to_integer<std::uint8_t>(group[0] >> 4 | group[1] << 4);
    to[u + 1] = std::to_integer<std::uint8_t>(group[2]);
  }
}

/// Of pixel i of a group the bits 10 i + 2 to 10 i + 9.
void take_ten_bits(const std::byte* from, std::int32_t width_px, std::uint8_t* to) {
  for (std::int32_t u = 0; u + 3 < width_px; u += 4) {
    const std::byte* const group = from + u / 4 * 5;
    to[u] = std::to_integer<std::uint8_t>(group[0] >> 2 | group[1] << 6);
    to[u + 1] = std::to_integer<std::uint8_t>(group[1] >> 4 | group[2] << 4);
    to[u + 2] = std::to_integer<std::uint8_t>(group[2] >> 6 | group[3] << 2);
    to[u + 3] = std::to_integer<std::uint8_t>(group[4]);
  }
}

}  // namespace

std::optional<GreyFormat> grey_format_named(std::string_view name) {
  for (const GreyFormat& format : kGreyFormats) {
    if (format.name == name) {
      return format;
    }
  }
  return {};
}

void extract_line(const GreyFormat& format, const std::byte* from, std::int32_t width_px,
                  std::uint8_t* to) {
  switch (format.layout) {
    case GreyLayout::kBytes:
      for (std::int32_t u = 0; u < width_px; ++u) {
        to[u] = std::to_integer<std::uint8_t>(from[u]);
      }
      return;
    case GreyLayout::kTenBits: take_out_of_words<10>(from, width_px, to); return;
    case GreyLayout::kTwelveBits: take_out_of_words<12>(from, width_px, to); return;
    case GreyLayout::kUpperBytes: take_upper_bytes(from, width_px, to); return;
    case GreyLayout::kTenBitRun: take_ten_bits(from, width_px, to); return;
    case GreyLayout::kTwelveBitRun: take_twelve_bits(from, width_px, to); return;
  }
}

}  // namespace tubesight::drivers::aravis
