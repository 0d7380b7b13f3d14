#include "drivers/files/pgm_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::uint32_t kLargestSide_px = 8192;
constexpr std::string_view kMagic = "P5";
constexpr std::string_view kWhite = " \t\n\v\f\r";

Result<void> fail(Error error, std::string& message, std::string text) {
  message = std::move(text);
  return Unexpected(error);
}

bool begins_white(std::string_view text) {
  return !text.empty() && kWhite.find(text.front()) != std::string_view::npos;
}

/// Takes one line end off the front: LF, CR, or both in this order.
void take_line_end(std::string_view& rest) {
  rest.remove_prefix(rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest.size(), 1));
}

/// Takes a comment and the end of its line off the front.
void take_comment(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_of("\r\n"), rest.size()));
  take_line_end(rest);
}

/// Takes the next number of the header, with the white space and comments that must stand before.
bool take_number(std::string_view& rest, std::uint32_t& number) {
  if (!begins_white(rest) && !rest.starts_with('#')) {
    return false;
  }
  while (begins_white(rest) || rest.starts_with('#')) {
    if (rest.starts_with('#')) {
      take_comment(rest);
    } else {
      rest.remove_prefix(1);
    }
  }
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return error == std::errc();
}

/// Whether the picture's bytes begin like a line of text that is a comment; pixels may as well.
bool begins_like_comment(std::string_view rest) {
  const std::size_t end = rest.find_first_of("\r\n");
  return rest.starts_with('#') && end != std::string_view::npos &&
         std::all_of(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end),
                     [](char c) { return c == '\t' || static_cast<unsigned char>(c) >= 0x20; });
}

/// Takes what stands between the largest value and the picture; false when nothing does.
bool take_header_end(std::string_view& rest, std::size_t pixels) {
  if (rest.starts_with('#')) {
    take_comment(rest);
    return true;
  }
  if (!begins_white(rest)) {
    return false;
  }
  // A CR alone before a pixel of 10 looks the same, but nobody has ended lines so for decades; were
  // it read so, a picture behind a CR LF that lost one byte would pass, shifted by one pixel.
  take_line_end(rest);
  if (rest.size() != pixels && begins_like_comment(rest)) {
    std::string_view behind = rest;
    take_comment(behind);
    rest = behind.size() == pixels ? behind : rest;
  }
  return true;
}

std::string bytes_words(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " byte" : " bytes");
}

}  // namespace

Result<void> read_pgm(std::string_view bytes, GreyPicture& picture, std::string& message) {
  constexpr const char* kWrongHeader =
      "damaged PGM: expected P5, width, height and largest value, then one white-space character";
  std::string_view rest = bytes;
  rest.remove_prefix(std::min(kMagic.size(), rest.size()));
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t largest = 0;
  if (!bytes.starts_with(kMagic) || !take_number(rest, width_px) || !take_number(rest, height_px) ||
      !take_number(rest, largest) || width_px == 0 || height_px == 0) {
    return fail(Error::kInvalidArgument, message, kWrongHeader);
  }
  if (largest != 255) {
    return fail(Error::kUnsupported, message,
                "PGM with largest value " + std::to_string(largest) + ": expected 255 (8 bits)");
  }
  if (width_px > kLargestSide_px || height_px > kLargestSide_px) {
    return fail(Error::kUnsupported, message, "expected at most 8192 pixels a side");
  }
  const std::size_t pixels = std::size_t{width_px} * height_px;
  if (!take_header_end(rest, pixels)) {
    return fail(Error::kInvalidArgument, message, kWrongHeader);
  }
  if (rest.size() < pixels) {
    return fail(Error::kInvalidArgument, message,
                "damaged PGM: the file ends early, expected " + bytes_words(pixels - rest.size()) +
                    " more of the picture's " + std::to_string(pixels));
  }
  if (rest.size() > pixels) {
    const bool further = rest.substr(pixels).starts_with(kMagic);
    return fail(Error::kInvalidArgument, message,
                "damaged PGM: " + bytes_words(rest.size() - pixels) + " left over behind the " +
                    std::to_string(pixels) + " of the picture, expected none" +
                    (further ? " (a further picture follows)" : ""));
  }
  picture.width_px = static_cast<std::int32_t>(width_px);
  picture.height_px = static_cast<std::int32_t>(height_px);
  picture.pixels.resize(pixels);
  std::memcpy(picture.pixels.data(), rest.data(), pixels);
  return {};
}

}  // namespace tubesight::drivers
