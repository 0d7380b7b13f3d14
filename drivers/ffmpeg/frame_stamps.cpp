#include "drivers/ffmpeg/frame_stamps.h"

#include <cstddef>

#include "drivers/files/csv_reader.h"

namespace tubesight::drivers {
namespace {

constexpr std::size_t kLongestLine = 400;
constexpr std::int64_t kLargestPart = 1'000'000'000;

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) {
    text.remove_prefix(1);
  }
  while (text.ends_with(' ')) {
    text.remove_suffix(1);
  }
  return text;
}

/// The cell with this number, from 0, of a line whose cells are parted by commas.
std::string_view cell(std::string_view line, int number) {
  for (; number > 0; --number) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) {
      return {};
    }
    line.remove_prefix(comma + 1);
  }
  return trimmed(line.substr(0, line.find(',')));
}

}  // namespace

void FrameStamps::take(std::string_view part) {
  for (const char c : part) {
    if (c == '\n') {
      take_line();
      line_.clear();
    } else if (line_.size() < kLongestLine) {
      line_ += c;
    }
  }
}

void FrameStamps::take_line() {
  constexpr std::string_view kUnit = "#tb 0: ";
  const std::string_view line = line_;
  if (line.starts_with(kUnit)) {
    const std::string_view unit = line.substr(kUnit.size());
    const std::size_t slash = unit.find('/');
    std::int64_t numerator = 0;
    std::int64_t denominator = 0;
    if (slash != std::string_view::npos && parse_whole(unit.substr(0, slash), numerator) &&
        parse_whole(unit.substr(slash + 1), denominator) && numerator >= 1 && denominator >= 1 &&
        numerator <= kLargestPart && denominator <= kLargestPart) {
      numerator_ = numerator;
      denominator_ = denominator;
    }
    return;
  }
  if (line.empty() || line.starts_with('#')) {
    return;
  }
  constexpr int kStampCell = 2;
  std::int64_t ticks = 0;
  if (numerator_ > 0 && parse_whole(cell(line, kStampCell), ticks)) {
    stamps_.emplace_back(FrameStamp{ticks, numerator_, denominator_});
  } else {
    stamps_.emplace_back(std::nullopt);
  }
}

std::optional<FrameStamp> FrameStamps::next() {
  if (stamps_.empty()) {
    return std::nullopt;
  }
  const auto stamp = stamps_.front();
  stamps_.pop_front();
  return stamp;
}

}  // namespace tubesight::drivers
