#pragma once

#include <array>
#include <cstdint>

namespace tubesight::core::rendering {

/// The grain of the plate as a tile that repeats: scratches, veins, pores. Mean 0, sigma 1.
class SurfaceTexture {
 public:
  static constexpr std::int32_t kSide = 512;    ///< texels, a power of two
  static constexpr double kTexelsPerMm = 5.0;   ///< the tile covers 102 mm
  static constexpr float kStep = 1.0F / 32.0F;  ///< of the stored numbers

  /// Fills the tile; always the same one.
  void make();

  /// Index of a texel; coordinates of any sign.
  [[nodiscard]] static std::int32_t index(std::int32_t x, std::int32_t y) {
    return ((y & (kSide - 1)) * kSide) | (x & (kSide - 1));
  }
  /// The stored number at an index, in steps of kStep.
  [[nodiscard]] std::int32_t at_index(std::int32_t index) const {
    return tile_[static_cast<std::size_t>(index)];
  }

  /// The stored number at a texel, in steps of kStep; coordinates of any sign above -2^20.
  [[nodiscard]] std::int32_t at(std::int32_t x, std::int32_t y) const {
    return at_index(index(x, y));
  }

  /// Smoothly between texels, mean 0 and sigma 1: for broad stains.
  [[nodiscard]] float between(float x, float y) const;

 private:
  std::array<std::int8_t, static_cast<std::size_t>(kSide) * kSide> tile_{};
};

}  // namespace tubesight::core::rendering
