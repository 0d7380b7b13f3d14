#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include "core/base/image_view.h"

namespace tubesight::core::edges {

/// A full-frame picture on the heap with not one byte to spare: under the address sanitizer a read
/// beside it ends the test.
class Picture {
 public:
  Picture(std::int32_t width_px, std::int32_t height_px, int grey = 0)
      : width_px_(width_px),
        height_px_(height_px),
        pixels_(new std::uint8_t[static_cast<std::size_t>(width_px * height_px)]) {
    std::fill_n(pixels_.get(), width_px * height_px, static_cast<std::uint8_t>(grey));
  }

  [[nodiscard]] std::uint8_t& at(std::int32_t u, std::int32_t v) {
    return pixels_[static_cast<std::size_t>(v * width_px_ + u)];
  }
  /// Intensity as the source writes it, I(u, v), in full-frame coordinates.
  [[nodiscard]] std::int32_t I(std::int32_t u, std::int32_t v) const {
    return pixels_[static_cast<std::size_t>(v * width_px_ + u)];
  }
  [[nodiscard]] FieldView field(Parity parity) const {
    return field_of({pixels_.get(), width_px_, height_px_, width_px_}, parity);
  }
  [[nodiscard]] std::int32_t width_px() const { return width_px_; }
  [[nodiscard]] std::int32_t height_px() const { return height_px_; }

  void fill_random(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (std::int32_t i = 0; i < width_px_ * height_px_; ++i) {
      pixels_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(random() >> 24U);
    }
  }

  /// Draws by a function of the place, u and v in pixels, grey value rounded.
  template <typename Grey>
  void draw(Grey grey) {
    for (std::int32_t v = 0; v < height_px_; ++v) {
      for (std::int32_t u = 0; u < width_px_; ++u) {
        const double value = grey(static_cast<double>(u), static_cast<double>(v));
        at(u, v) = static_cast<std::uint8_t>(std::clamp(std::floor(value + 0.5), 0.0, 255.0));
      }
    }
  }

 private:
  std::int32_t width_px_;
  std::int32_t height_px_;
  std::unique_ptr<std::uint8_t[]> pixels_;
};

/// A step from 0 to 1 at 0, blurred by a Gaussian of standard deviation `sigma`.
[[nodiscard]] inline double blurred_step(double x, double sigma) {
  return 0.5 * std::erfc(-x / (sigma * 1.4142135623730951));
}

/// A dark ellipse in a bright surface, blurred: its signed distance is right near the rim.
struct Ellipse {
  double u = 0.0;
  double v = 0.0;
  double half_u = 20.0;
  double half_v = 15.0;
  double dark = 20.0;
  double bright = 160.0;
  double sigma = 0.8;

  [[nodiscard]] double operator()(double x, double y) const {
    const double a = (x - u) / half_u;
    const double b = (y - v) / half_v;
    const double level = std::sqrt(a * a + b * b);
    const double slope =
        level > 0.0 ? std::sqrt(a * a / half_u / half_u + b * b / half_v / half_v) : 1.0;
    const double distance = level > 0.0 ? (level - 1.0) * level / slope : -half_v;
    return dark + (bright - dark) * blurred_step(distance, sigma);
  }
};

}  // namespace tubesight::core::edges
