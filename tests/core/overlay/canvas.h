#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image_view.h"
#include "core/overlay/font.h"
#include "core/overlay/pixels.h"

namespace tubesight::tests {

using core::overlay::PixelPoint;
using core::overlay::Rgb;

/// A picture to draw into whose lines are longer than its width, between two bands of guard bytes.
class Canvas {
 public:
  Canvas(std::int32_t width_px, std::int32_t height_px)
      : width_(width_px), height_(height_px), stride_(3 * width_px + kPadding) {
    bytes_.assign(2 * kBand + static_cast<std::size_t>(stride_ * height_px), kGuard);
    for (std::int32_t v = 0; v < height_; ++v) {
      for (std::int32_t u = 0; u < width_; ++u) {
        set(u, v, Rgb{});
      }
    }
  }

  [[nodiscard]] core::RgbImageView view() {
    return {bytes_.data() + kBand, width_, height_, stride_};
  }
  [[nodiscard]] std::int32_t width() const { return width_; }
  [[nodiscard]] std::int32_t height() const { return height_; }

  [[nodiscard]] Rgb at(std::int32_t u, std::int32_t v) const {
    const std::size_t i = index(u, v);
    return {bytes_[i], bytes_[i + 1], bytes_[i + 2]};
  }
  void set(std::int32_t u, std::int32_t v, Rgb colour) {
    const std::size_t i = index(u, v);
    bytes_[i] = colour.red;
    bytes_[i + 1] = colour.green;
    bytes_[i + 2] = colour.blue;
  }

  /// Says whether every byte that is no pixel is as it was.
  [[nodiscard]] bool guards_intact() const {
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      const std::size_t last = kBand + static_cast<std::size_t>(stride_ * height_);
      const bool inside =
          i >= kBand && i < last &&
          (i - kBand) % static_cast<std::size_t>(stride_) < static_cast<std::size_t>(3 * width_);
      if (!inside && bytes_[i] != kGuard) {
        return false;
      }
    }
    return true;
  }

  /// The picture as text, a line each: '#' where a pixel has the colour, '.' elsewhere.
  [[nodiscard]] std::string drawn(Rgb colour) const {
    std::string text;
    for (std::int32_t v = 0; v < height_; ++v) {
      for (std::int32_t u = 0; u < width_; ++u) {
        text += at(u, v) == colour ? '#' : '.';
      }
      text += '\n';
    }
    return text;
  }

  /// All pixels of a colour above the line `below`, line by line.
  [[nodiscard]] std::vector<PixelPoint> pixels_of(Rgb colour, std::int32_t below) const {
    std::vector<PixelPoint> found;
    for (std::int32_t v = 0; v < below; ++v) {
      for (std::int32_t u = 0; u < width_; ++u) {
        if (at(u, v) == colour) {
          found.push_back({u, v});
        }
      }
    }
    return found;
  }

  /// Where words, which do not begin with a space, stand in a colour at a scale: every dot set and
  /// every other one not.
  [[nodiscard]] std::optional<PixelPoint> find_text(std::string_view words, std::int32_t scale,
                                                    Rgb colour) const {
    if (words.empty()) {
      return PixelPoint{0, 0};
    }
    // A dot of the first character decides for most places.
    const core::overlay::Glyph& first = core::overlay::glyph_of(words[0]);
    PixelPoint dot{0, 0};
    while (!first.dot(dot.u_px, dot.v_px)) {
      dot = dot.u_px < 4 ? PixelPoint{dot.u_px + 1, dot.v_px} : PixelPoint{0, dot.v_px + 1};
    }
    const std::int32_t width = core::overlay::text_width_px(words, scale);
    const std::int32_t height = core::overlay::kCapitalHeight * scale;
    for (std::int32_t v = 0; v + height <= height_; ++v) {
      for (std::int32_t u = 0; u + width <= width_; ++u) {
        if (at(u + dot.u_px * scale, v + dot.v_px * scale) == colour &&
            stands_at(u, v, words, scale, colour)) {
          return PixelPoint{u, v};
        }
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::int32_t kPadding = 7;
  static constexpr std::size_t kBand = 4096;
  static constexpr std::uint8_t kGuard = 0xA5;

  [[nodiscard]] std::size_t index(std::int32_t u, std::int32_t v) const {
    return kBand + static_cast<std::size_t>(v * stride_ + 3 * u);
  }

  [[nodiscard]] bool stands_at(std::int32_t left, std::int32_t top, std::string_view words,
                               std::int32_t scale, Rgb colour) const {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const core::overlay::Glyph& glyph = core::overlay::glyph_of(words[i]);
      const std::int32_t cell = left + static_cast<std::int32_t>(i) * 6 * scale;
      for (std::int32_t row = 0; row < 9 * scale && top + row < height_; ++row) {
        for (std::int32_t column = 0; column < 5 * scale; ++column) {
          const bool dot = glyph.dot(column / scale, row / scale);
          if (dot != (at(cell + column, top + row) == colour)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  std::int32_t width_;
  std::int32_t height_;
  std::int32_t stride_;
  std::vector<std::uint8_t> bytes_;
};

/// The mean place of pixels, in 1/1000 px; the list must not be empty.
inline PixelPoint centroid_milli(const std::vector<PixelPoint>& pixels) {
  std::int64_t u = 0;
  std::int64_t v = 0;
  for (const PixelPoint& pixel : pixels) {
    u += pixel.u_px;
    v += pixel.v_px;
  }
  const auto count = static_cast<std::int64_t>(pixels.size());
  return {static_cast<std::int32_t>(1000 * u / count), static_cast<std::int32_t>(1000 * v / count)};
}

/// A point in 1/65536 px from thousandths of a pixel.
inline core::ImagePoint point_milli(std::int64_t u_milli, std::int64_t v_milli) {
  return {static_cast<std::int32_t>(u_milli * 65536 / 1000),
          static_cast<std::int32_t>(v_milli * 65536 / 1000)};
}

}  // namespace tubesight::tests
