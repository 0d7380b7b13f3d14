#include "drivers/v4l2/write_marks.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tubesight::drivers::v4l2 {
namespace {

/// In no order that repeats, as a mark may begin with either byte of a pixel of two: 0 and 255 by
/// turns are four pixels of one grey then, a dark one of 10 bits, or white of a sensor of 8 in the
/// upper half of 16. So it is of 16 bits a value beyond 10 and jumps from end to end, of packed
/// formats colours from end to end, and of one byte black and white by pixels.
constexpr std::array<std::uint8_t, WriteMarks::kBytes> kMark{0, 255, 255, 0, 255, 0, 0, 255};
/// From the place of one line's mark to that of the next: odd, so that none is left out.
constexpr std::int64_t kStride = 7'919;

/// At a picture's edges drivers may leave half lines, and columns without video, as they are for
/// good: this part of its lines and columns has no marks.
constexpr std::int32_t kEdge = 48;

/// Calls with each marked line of a field until it says no; whether it never did.
template <typename Call>
bool all_lines(const FieldLines& field, const Call& call) {
  const std::int32_t step =
      std::max(1, (field.lines + WriteMarks::kMostLines - 1) / WriteMarks::kMostLines);
  const std::int32_t edge = field.lines / kEdge;
  for (std::int32_t i = edge; i < field.lines - edge; i += step) {
    if (!call(field.first + i * field.step)) {
      return false;
    }
  }
  return true;
}

}  // namespace

void WriteMarks::begin(const AgreedFormat& agreed, std::int32_t width_px) {
  agreed_ = agreed;
  edge_bytes_ = width_px / kEdge * agreed.pixel.bytes_a_pixel;
  places_ = std::max(0, width_px * agreed.pixel.bytes_a_pixel - 2 * edge_bytes_ - kBytes + 1);
}

/// Packets are of some lines, and may be lost in the middle of one: marks stand everywhere.
std::ptrdiff_t WriteMarks::place_in(std::int32_t line) const {
  return static_cast<std::ptrdiff_t>(line) * agreed_.stride_bytes + edge_bytes_ +
         static_cast<std::ptrdiff_t>(line * kStride % places_);
}

void WriteMarks::lay(std::byte* picture) const {
  const int fields = agreed_.kind == BufferKind::kPair ? 2 : 1;
  for (int which = 0; which < fields && places_ > 0; ++which) {
    all_lines(agreed_.lines_of(which != 0, false), [&](std::int32_t line) {
      std::memcpy(picture + place_in(line), kMark.data(), kMark.size());
      return true;
    });
  }
}

bool WriteMarks::left(const std::byte* picture, const FieldLines& field) const {
  return places_ > 0 && !all_lines(field, [&](std::int32_t line) {
           return std::memcmp(picture + place_in(line), kMark.data(), kMark.size()) != 0;
         });
}

}  // namespace tubesight::drivers::v4l2
