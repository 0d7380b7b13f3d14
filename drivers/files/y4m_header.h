#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// What the header of a recording says about the order of its lines; the parameter `I`.
enum class Y4mInterlacing : std::uint8_t {
  kUnstated,     ///< no `I`, or `I?`
  kProgressive,  ///< `Ip`
  kEvenFirst,    ///< `It`: the field with the top line (line 0) came first
  kOddFirst,     ///< `Ib`
};

/// The first line of a YUV4MPEG2 file.
struct Y4mHeader {
  std::int32_t width_px = 0;        ///< 1..8192
  std::int32_t height_px = 0;       ///< 1..8192
  std::int64_t rate_numerator = 0;  ///< frames a second; 0: not stated
  std::int64_t rate_denominator = 1;
  Y4mInterlacing interlacing = Y4mInterlacing::kUnstated;
  std::int32_t depth_bits = 8;    ///< of a sample, 8..16; above 8 it takes two bytes, low one first
  std::int64_t chroma_bytes = 0;  ///< what follows the luma plane in each frame

  /// The luma plane with a byte a pixel, as it is delivered.
  [[nodiscard]] std::int64_t luma_bytes() const {
    return std::int64_t{width_px} * std::int64_t{height_px};
  }
  /// The luma plane as it stands in the file.
  [[nodiscard]] std::int64_t stored_luma_bytes() const {
    return luma_bytes() * (depth_bits > 8 ? 2 : 1);
  }
};

/// Reads the first line (without its line feed).
///
/// Served are pictures of 8 bits, Cmono, C420 (jpeg, mpeg2, paldv; also when C is missing), C411,
/// C422, C444, C444alpha, and of 9 to 16 bits as ffmpeg names them: Cmono10, C420p10, C422p10,
/// C444p10. Errors: kInvalidArgument not a YUV4MPEG2 header or a parameter is malformed,
/// kUnsupported another colour space, mixed interlacing or too large a picture; `message` says
/// which, without the file's name.
[[nodiscard]] core::Result<Y4mHeader> parse_y4m_header(std::string_view line, std::string& message);

/// The parameter `C` that makes so many bytes follow the luma plane ("Cmono", "C420"); of several
/// the shortest, and empty when none does. For 8 bits.
[[nodiscard]] std::string_view y4m_colour_of(const Y4mHeader& header, std::int64_t chroma_bytes);

/// What a recording is told that was copied as if it were text: bytes of its pixels are changed
/// too.
inline constexpr std::string_view kTextModeWords =
    "damaged by a transfer in text mode: a line ends in CR LF, expected LF alone";

}  // namespace tubesight::drivers
