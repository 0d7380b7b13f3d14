#include "drivers/files/y4m_header.h"

#include <array>
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

struct ColourSpace {
  std::string_view parameter;
  std::int64_t (*chroma_bytes)(std::int64_t width_px, std::int64_t height_px);
};

std::int64_t none(std::int64_t, std::int64_t) { return 0; }
std::int64_t quarters(std::int64_t width_px, std::int64_t height_px) {
  return 2 * half(width_px) * half(height_px);
}

constexpr std::array kColourSpaces = {
    ColourSpace{"Cmono", none},
    ColourSpace{"C420", quarters},
    ColourSpace{"C420jpeg", quarters},
    ColourSpace{"C420mpeg2", quarters},
    ColourSpace{"C420paldv", quarters},
    ColourSpace{"C422", [](std::int64_t w, std::int64_t h) { return 2 * half(w) * h; }},
    ColourSpace{"C411", [](std::int64_t w, std::int64_t h) { return 2 * half(half(w)) * h; }},
    ColourSpace{"C444", [](std::int64_t w, std::int64_t h) { return 2 * w * h; }},
    ColourSpace{"C444alpha", [](std::int64_t w, std::int64_t h) { return 3 * w * h; }},
};

/// Takes the bits off "Cmono10" or "C420p10", which are 8 where none are told.
std::int32_t take_depth(std::string_view& parameter) {
  constexpr std::int32_t kFewest = 9;
  constexpr std::int32_t kMost = 16;
  for (const std::string_view before : {"Cmono", "C420p", "C422p", "C444p"}) {
    std::int32_t depth = 0;
    if (parameter.starts_with(before) && parse_whole(parameter.substr(before.size()), depth) &&
        depth >= kFewest && depth <= kMost) {
      parameter = parameter.substr(0, before.ends_with('p') ? before.size() - 1 : before.size());
      return depth;
    }
  }
  return 8;
}

Result<void> set_chroma(std::string_view parameter, Y4mHeader& header, std::string& message) {
  std::string_view wanted = parameter.empty() ? "C420" : parameter;
  header.depth_bits = take_depth(wanted);
  for (const ColourSpace& space : kColourSpaces) {
    if (space.parameter == wanted) {
      header.chroma_bytes =
          space.chroma_bytes(header.width_px, header.height_px) * (header.depth_bits > 8 ? 2 : 1);
      return {};
    }
  }
  return fail(Error::kUnsupported, message,
              "colour format " + in_quotes(parameter) +
                  " is not supported: expected Cmono, C420jpeg, C420mpeg2, C420paldv, C411, C422 "
                  "or C444, or 9 to 16 bits as in Cmono10, C420p10, C422p10 or C444p10");
}

}  // namespace

Result<Y4mHeader> parse_y4m_header(std::string_view line, std::string& message) {
  if (!line.starts_with(kMagic) || (line.size() > kMagic.size() && line[kMagic.size()] != ' ')) {
    message = "not a YUV4MPEG2 file: expected the first line to begin with 'YUV4MPEG2 '";
    return Unexpected(Error::kInvalidArgument);
  }
  if (line.find('\r') != std::string_view::npos) {
    message = kTextModeWords;
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

std::string_view y4m_colour_of(const Y4mHeader& header, std::int64_t chroma_bytes) {
  if (header.depth_bits > 8) {
    return {};
  }
  for (const ColourSpace& space : kColourSpaces) {
    if (space.chroma_bytes(header.width_px, header.height_px) == chroma_bytes) {
      return space.parameter;
    }
  }
  return {};
}

}  // namespace tubesight::drivers
