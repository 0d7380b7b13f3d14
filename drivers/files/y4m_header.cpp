#include "drivers/files/y4m_header.h"

#include <utility>

#include "drivers/files/csv_reader.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::string_view kMagic = "YUV4MPEG2";
constexpr std::int64_t kLargestSide_px = 8192;
constexpr std::int64_t kLargestRatePart = 1'000'000'000;

Result<void> fail(Error error, std::string& message, std::string text) {
  message = std::move(text);
  return Unexpected(error);
}

Result<void> parse_side(std::string_view parameter, std::int32_t& side_px, std::string& message) {
  std::int64_t value = 0;
  if (!parse_whole(parameter.substr(1), value) || value < 1) {
    return fail(Error::kInvalidArgument, message,
                "header parameter " + in_quotes(parameter) + ": expected a size in pixels");
  }
  if (value > kLargestSide_px) {
    return fail(Error::kUnsupported, message,
                "header parameter " + in_quotes(parameter) + ": expected at most 8192 pixels");
  }
  side_px = static_cast<std::int32_t>(value);
  return {};
}

Result<void> parse_rate(std::string_view parameter, Y4mHeader& header, std::string& message) {
  const std::string_view text = parameter.substr(1);
  const std::size_t colon = text.find(':');
  std::int64_t numerator = 0;
  std::int64_t denominator = 0;
  if (colon == std::string_view::npos || !parse_whole(text.substr(0, colon), numerator) ||
      !parse_whole(text.substr(colon + 1), denominator) || numerator < 0 || denominator < 0 ||
      numerator > kLargestRatePart || denominator > kLargestRatePart ||
      (numerator == 0) != (denominator == 0)) {
    return fail(Error::kInvalidArgument, message,
                "header parameter " + in_quotes(parameter) +
                    ": expected frames a second as F<number>:<number>");
  }
  // 0:0 is the format's way to say that the rate is not known.
  header.rate_numerator = numerator;
  header.rate_denominator = denominator == 0 ? 1 : denominator;
  return {};
}

Result<void> parse_interlacing(std::string_view parameter, Y4mHeader& header,
                               std::string& message) {
  if (parameter == "I?") {
    header.interlacing = Y4mInterlacing::kUnstated;
  } else if (parameter == "Ip") {
    header.interlacing = Y4mInterlacing::kProgressive;
  } else if (parameter == "It") {
    header.interlacing = Y4mInterlacing::kEvenFirst;
  } else if (parameter == "Ib") {
    header.interlacing = Y4mInterlacing::kOddFirst;
  } else if (parameter == "Im") {
    return fail(Error::kUnsupported, message,
                "header says Im (mixed interlacing): expected It, Ib or Ip");
  } else {
    return fail(Error::kInvalidArgument, message,
                "header parameter " + in_quotes(parameter) + ": expected It, Ib or Ip");
  }
  return {};
}

std::int64_t half(std::int64_t side_px) { return (side_px + 1) / 2; }

Result<void> set_chroma(std::string_view parameter, Y4mHeader& header, std::string& message) {
  const std::string_view space = parameter.empty() ? "420" : parameter.substr(1);
  const std::int64_t width = header.width_px;
  const std::int64_t height = header.height_px;
  if (space == "mono") {
    header.chroma_bytes = 0;
  } else if (space == "420" || space == "420jpeg" || space == "420mpeg2" || space == "420paldv") {
    header.chroma_bytes = 2 * half(width) * half(height);
  } else if (space == "422") {
    header.chroma_bytes = 2 * half(width) * height;
  } else if (space == "411") {
    header.chroma_bytes = 2 * half(half(width)) * height;
  } else if (space == "444") {
    header.chroma_bytes = 2 * width * height;
  } else if (space == "444alpha") {
    header.chroma_bytes = 3 * width * height;
  } else {
    return fail(Error::kUnsupported, message,
                "colour format " + in_quotes(parameter) +
                    " is not supported: expected 8 bits as Cmono, C420jpeg, C420mpeg2, C420paldv, "
                    "C411, C422 or C444");
  }
  return {};
}

}  // namespace

Result<Y4mHeader> parse_y4m_header(std::string_view line, std::string& message) {
  if (!line.starts_with(kMagic) || (line.size() > kMagic.size() && line[kMagic.size()] != ' ')) {
    message = "not a YUV4MPEG2 file: expected the first line to begin with 'YUV4MPEG2 '";
    return Unexpected(Error::kInvalidArgument);
  }
  Y4mHeader header;
  std::string_view colour;
  line.remove_prefix(kMagic.size());
  while (!line.empty()) {
    line.remove_prefix(1);
    const std::string_view parameter = line.substr(0, line.find(' '));
    line.remove_prefix(parameter.size());
    Result<void> outcome;
    switch (parameter.empty() ? ' ' : parameter.front()) {
      case 'W': outcome = parse_side(parameter, header.width_px, message); break;
      case 'H': outcome = parse_side(parameter, header.height_px, message); break;
      case 'F': outcome = parse_rate(parameter, header, message); break;
      case 'I': outcome = parse_interlacing(parameter, header, message); break;
      case 'C': colour = parameter; break;
      default: break;  // A (shape of a pixel), X (comments) and what later versions add
    }
    if (!outcome) {
      return Unexpected(outcome.error());
    }
  }
  if (header.width_px == 0 || header.height_px == 0) {
    message = "the header lacks the picture's size: expected W<pixels> and H<pixels>";
    return Unexpected(Error::kInvalidArgument);
  }
  if (const auto outcome = set_chroma(colour, header, message); !outcome) {
    return Unexpected(outcome.error());
  }
  return header;
}

}  // namespace tubesight::drivers
