#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tubesight::drivers::aravis {

/// How the grey values of a format lie in memory.
enum class GreyLayout : std::uint8_t {
  kBytes,         ///< a byte each
  kTenBits,       ///< 10 bits of 16, the low byte first
  kTwelveBits,    ///< 12 bits of 16, the low byte first
  kUpperBytes,    ///< two in three bytes: the upper 8 bits of both, their low bits between them
  kTenBitRun,     ///< four in five bytes, bit by bit from the lowest
  kTwelveBitRun,  ///< two in three bytes, bit by bit from the lowest
};

/// A format of grey pictures, as GenICam names them.
struct GreyFormat {
  std::string_view name;  ///< "Mono12Packed"
  std::uint32_t code = 0;
  GreyLayout layout = GreyLayout::kBytes;
  std::int32_t group_px = 1;     ///< pixels that share bytes
  std::int32_t group_bytes = 1;  ///< bytes of those

  /// Whether lines can be lent as they are.
  [[nodiscard]] constexpr bool lendable() const { return layout == GreyLayout::kBytes; }
  /// Of a line, which must be whole groups.
  [[nodiscard]] constexpr std::int32_t line_bytes(std::int32_t width_px) const {
    return width_px / group_px * group_bytes;
  }
};

/// All that the driver takes, the best first: what is lent costs nothing, and then what needs least
/// of the network.
inline constexpr std::array<GreyFormat, 7> kGreyFormats{{
    // Codes of the GenICam pixel format naming convention.
    {"Mono8", 0x01080001, GreyLayout::kBytes, 1, 1},
    {"Mono10p", 0x010a0046, GreyLayout::kTenBitRun, 4, 5},
    {"Mono12p", 0x010c0047, GreyLayout::kTwelveBitRun, 2, 3},
    {"Mono10Packed", 0x010c0004, GreyLayout::kUpperBytes, 2, 3},
    {"Mono12Packed", 0x010c0006, GreyLayout::kUpperBytes, 2, 3},
    {"Mono10", 0x01100003, GreyLayout::kTenBits, 1, 2},
    {"Mono12", 0x01100005, GreyLayout::kTwelveBits, 1, 2},
}};

[[nodiscard]] std::optional<GreyFormat> grey_format_named(std::string_view name);

/// Takes the upper 8 bits of the grey values of a line out.
void extract_line(const GreyFormat& format, const std::byte* from, std::int32_t width_px,
                  std::uint8_t* to);

}  // namespace tubesight::drivers::aravis
