#include "board/box/frame_view.h"

#include <algorithm>
#include <cstddef>

#include "core/base/assert.h"

namespace tubesight::board {

using core::FieldStatus;
using core::Parity;

FrameView::FrameView(std::int32_t width_px, std::int32_t height_px)
    : width_px_(width_px),
      height_px_(height_px),
      pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

void FrameView::take(const core::Field& field) {
  if (field.status != FieldStatus::kGood) {
    return;
  }
  const core::FieldView& lines = field.pixels;
  TUBESIGHT_ASSERT(lines.width_px == width_px_ && lines.lines > 0 &&
                   lines.first_line + (lines.lines - 1) * lines.line_step < height_px_);
  for (std::int32_t i = 0; i < lines.lines; ++i) {
    copy_line(lines.pixels + static_cast<std::ptrdiff_t>(i) * lines.stride_px,
              lines.first_line + i * lines.line_step);
  }
  has_even_ = has_even_ || field.parity != Parity::kOdd;
  has_odd_ = has_odd_ || field.parity != Parity::kEven;
  if (!has_even_ || !has_odd_) {
    fill_in_lines(has_even_ ? 1 : 0);
  }
}

void FrameView::copy_line(const std::uint8_t* from, std::int32_t to) {
  std::copy_n(from, width_px_, pixels_.begin() + static_cast<std::ptrdiff_t>(to) * width_px_);
}

void FrameView::fill_in_lines(std::int32_t first) {
  for (std::int32_t v = first; v < height_px_; v += 2) {
    const std::int32_t like = v > 0 ? v - 1 : v + 1;
    if (like < height_px_) {
      copy_line(pixels_.data() + static_cast<std::ptrdiff_t>(like) * width_px_, v);
    }
  }
}

}  // namespace tubesight::board
