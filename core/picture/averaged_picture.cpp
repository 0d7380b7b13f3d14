#include "core/picture/averaged_picture.h"

#include <algorithm>

namespace tubesight::core::picture {

PictureAverage::PictureAverage(std::span<std::uint16_t> buffer, std::int32_t width_px,
                               std::int32_t height_px)
    : buffer_(buffer), width_px_(width_px), height_px_(height_px) {
  TUBESIGHT_ASSERT(width_px > 0 && height_px > 1);
  TUBESIGHT_ASSERT(buffer.size() >=
                   static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  std::fill(buffer_.begin(), buffer_.end(), std::uint16_t{0});
}

Result<void> PictureAverage::add(const FieldView& field) {
  const std::int32_t lines =
      (height_px_ - field.first_line + field.line_step - 1) / field.line_step;
  if (field.width_px != width_px_ || field.lines != lines || field.pixels == nullptr) {
    return Unexpected(Error::kInvalidArgument);
  }
  const bool whole = field.line_step == 1;
  for (std::int32_t parity = 0; parity < 2; ++parity) {
    if ((whole || field.first_line == parity) && count(parity) >= kMaxAveragedFrames) {
      return Unexpected(Error::kOutOfRange);
    }
  }
  for (std::int32_t l = 0; l < field.lines; ++l) {
    const std::uint8_t* const from =
        field.pixels + static_cast<std::ptrdiff_t>(l) * field.stride_px;
    std::uint16_t* const to =
        buffer_.data() +
        static_cast<std::ptrdiff_t>(field.first_line + l * field.line_step) * width_px_;
    for (std::int32_t u = 0; u < width_px_; ++u) {
      to[u] = static_cast<std::uint16_t>(to[u] + from[u]);
    }
  }
  for (std::int32_t parity = 0; parity < 2; ++parity) {
    counts_[static_cast<std::size_t>(parity)] += whole || field.first_line == parity ? 1 : 0;
  }
  return {};
}

void PictureAverage::scale_lines(std::int32_t first_line) {
  const std::int32_t n = count(first_line);
  for (std::int32_t v = first_line; v < height_px_; v += 2) {
    std::uint16_t* const line = buffer_.data() + static_cast<std::ptrdiff_t>(v) * width_px_;
    for (std::int32_t u = 0; u < width_px_; ++u) {
      line[u] = static_cast<std::uint16_t>((line[u] * kGreyScale + n / 2) / n);
    }
  }
}

void PictureAverage::fill_lines(std::int32_t first_line) {
  for (std::int32_t v = first_line; v < height_px_; v += 2) {
    std::uint16_t* const line = buffer_.data() + static_cast<std::ptrdiff_t>(v) * width_px_;
    const std::uint16_t* const above = v > 0 ? line - width_px_ : line + width_px_;
    const std::uint16_t* const below = v + 1 < height_px_ ? line + width_px_ : above;
    for (std::int32_t u = 0; u < width_px_; ++u) {
      line[u] = static_cast<std::uint16_t>((above[u] + below[u] + 1) / 2);
    }
  }
}

Result<AveragedPicture> PictureAverage::finish() {
  if (count(0) == 0 && count(1) == 0) {
    return Unexpected(Error::kNotReady);
  }
  for (std::int32_t first = 0; first < 2; ++first) {
    if (count(first) > 0) {
      scale_lines(first);
    }
  }
  for (std::int32_t first = 0; first < 2; ++first) {
    if (count(first) == 0) {
      fill_lines(first);
    }
  }
  counts_ = {kMaxAveragedFrames, kMaxAveragedFrames};
  return AveragedPicture{buffer_.data(), width_px_, height_px_};
}

Result<AveragedPicture> average_of_one(const ImageView& picture, std::span<std::uint16_t> buffer) {
  if (picture.width_px < 1 || picture.height_px < 2 ||
      buffer.size() < static_cast<std::size_t>(picture.width_px) *
                          static_cast<std::size_t>(picture.height_px)) {
    return Unexpected(Error::kInvalidArgument);
  }
  PictureAverage average(buffer, picture.width_px, picture.height_px);
  TUBESIGHT_TRY(average.add(field_of(picture, Parity::kProgressive)));
  return average.finish();
}

}  // namespace tubesight::core::picture
