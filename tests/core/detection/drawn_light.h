#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// A picture of light that a function gives, in grey levels above the darkest, with noise.
class DrawnLight {
 public:
  /// `light`: by u and v in pixels; `noise`: its deviation.
  template <typename Light>
  DrawnLight(int width, int height, double noise, Light light) : width_(width), height_(height) {
    std::mt19937 random(7);
    std::normal_distribution<double> spread(0.0, noise);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        // Four by four samples a pixel, or outlines would be staircases.
        double grey = 0.0;
        for (int i = 0; i < 16; ++i) {
          grey += light(u + 0.25 * (i % 4) - 0.375, v + 0.25 * (i / 4) - 0.375) / 16.0;
        }
        pixels_.push_back(
            static_cast<std::uint16_t>(std::lround(256.0 * std::max(0.0, grey + spread(random)))));
      }
    }
  }

  void cover(int left, int top, int right, int bottom, double grey) {
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        pixels_[static_cast<std::size_t>(v * width_ + u)] =
            static_cast<std::uint16_t>(256.0 * grey);
      }
    }
  }

  [[nodiscard]] picture::AveragedPicture view() const { return {pixels_.data(), width_, height_}; }

 private:
  int width_;
  int height_;
  std::vector<std::uint16_t> pixels_;
};

}  // namespace tubesight::core::detection
