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
  std::int64_t chroma_bytes = 0;  ///< what follows the luma plane in each frame

  [[nodiscard]] std::int64_t luma_bytes() const {
    return std::int64_t{width_px} * std::int64_t{height_px};
  }
};

/// Reads the first line (without its line feed).
///
/// Served are 8-bit pictures: Cmono, C420 (jpeg, mpeg2, paldv; also when C is missing), C411, C422,
/// C444, C444alpha. Errors: kInvalidArgument not a YUV4MPEG2 header or a parameter is malformed,
/// kUnsupported another colour space, more bits, mixed interlacing or too large a picture;
/// `message` says which, without the file's name.
[[nodiscard]] core::Result<Y4mHeader> parse_y4m_header(std::string_view line, std::string& message);

/// The parameter `C` that makes so many bytes follow the luma plane ("Cmono", "C420"); of several
/// the shortest, and empty when none does.
[[nodiscard]] std::string_view y4m_colour_of(const Y4mHeader& header, std::int64_t chroma_bytes);

/// What a recording is told that was copied as if it were text: bytes of its pixels are changed
/// too.
inline constexpr std::string_view kTextModeWords =
    "damaged by a transfer in text mode: a line ends in CR LF, expected LF alone";

}  // namespace tubesight::drivers
