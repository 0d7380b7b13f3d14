#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tubesight::drivers::v4l2 {

/// Where a format keeps its grey values. The luma of all of them begins with the buffer.
struct PixelFormat {
  std::string_view name;           ///< as settings say it: "GREY"
  std::uint32_t code = 0;          ///< V4L2_PIX_FMT_...
  std::int32_t bytes_a_pixel = 1;  ///< from one grey value to the next
  std::int32_t first_byte = 0;     ///< of the first grey value; of Y16 its upper 8 bits
  bool ten_bits = false;           ///< of 16, the low byte first; else a byte each

  /// Whether lines can be lent as they are.
  [[nodiscard]] constexpr bool lendable() const { return bytes_a_pixel == 1; }
};

/// All that the driver takes, the best first: what is lent costs nothing, and 10 bits no more than
/// 16.
[[nodiscard]] const std::array<PixelFormat, 6>& pixel_formats();

[[nodiscard]] std::optional<PixelFormat> pixel_format_named(std::string_view name);

/// "YUYV", or what else stands in a code that we have no name for.
[[nodiscard]] std::array<char, 5> code_text(std::uint32_t code);

/// Takes the grey values of a line of `width_px` out, to 8 bits.
void extract_line(const PixelFormat& format, const std::byte* from, std::int32_t width_px,
                  std::uint8_t* to);

}  // namespace tubesight::drivers::v4l2
