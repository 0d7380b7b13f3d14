#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/base/result.h"

namespace tubesight::core::picture {

/// Frames that one average takes: 32 times 255 still fits the 16 bits of a sum.
inline constexpr std::int32_t kMaxAveragedFrames = 32;

/// Grey levels of an averaged picture are counted in 1/256.
inline constexpr std::int32_t kGreyScale = 256;

/// A full-frame picture at rest, in 1/256 grey level, that somebody else owns; lines follow each
/// other without padding.
///
/// The fraction is what averaging gains: rounding four frames to whole levels again would leave an
/// error of 0.3 levels where the average's own noise is half a level.
struct AveragedPicture {
  const std::uint16_t* pixels = nullptr;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;

  [[nodiscard]] const std::uint16_t* line(std::int32_t v) const {
    return pixels + static_cast<std::ptrdiff_t>(v) * width_px;
  }
  [[nodiscard]] std::int32_t at(std::int32_t u, std::int32_t v) const { return line(v)[u]; }
};

/// Sums frames or fields of one picture at rest; the buffer is handed in.
///
/// Fields keep their own lines of the full frame and may be counted unequally.
class PictureAverage {
 public:
  /// `buffer` holds at least width * height sums and must outlive this object.
  PictureAverage(std::span<std::uint16_t> buffer, std::int32_t width_px, std::int32_t height_px);

  /// Adds one field, or a whole frame as its progressive field. kInvalidArgument: another size;
  /// kOutOfRange: its lines are summed kMaxAveragedFrames times already.
  [[nodiscard]] Result<void> add(const FieldView& field);

  /// How often lines 0, 2, 4 … (0) or 1, 3, 5 … (1) have been summed.
  [[nodiscard]] std::int32_t count(std::int32_t first_line) const {
    return counts_[static_cast<std::size_t>(first_line)];
  }

  /// The mean of a line's pixel so far, in grey levels. Needs a count above zero of that line.
  [[nodiscard]] double mean(std::int32_t u, std::int32_t v) const {
    return static_cast<double>(sum_line(v)[u]) / count(v & 1);
  }
  [[nodiscard]] const std::uint16_t* sum_line(std::int32_t v) const {
    return buffer_.data() + static_cast<std::ptrdiff_t>(v) * width_px_;
  }
  [[nodiscard]] std::int32_t width_px() const { return width_px_; }
  [[nodiscard]] std::int32_t height_px() const { return height_px_; }

  /// Turns the sums into the average, in their place; nothing can be added afterwards. Lines that
  /// were never added are taken from the lines above and below (one field alone).
  /// kNotReady: nothing was added.
  [[nodiscard]] Result<AveragedPicture> finish();

 private:
  void scale_lines(std::int32_t first_line);
  void fill_lines(std::int32_t first_line);

  std::span<std::uint16_t> buffer_;
  std::int32_t width_px_;
  std::int32_t height_px_;
  std::array<std::int32_t, 2> counts_{};
};

/// One whole picture as if it were an average; `buffer` holds at least as many sums as it has
/// pixels and must outlive the result. kInvalidArgument: fewer than two
/// lines, or too small a buffer.
[[nodiscard]] Result<AveragedPicture> average_of_one(const ImageView& picture,
                                                     std::span<std::uint16_t> buffer);

}  // namespace tubesight::core::picture
