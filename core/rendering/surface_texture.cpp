#include "core/rendering/surface_texture.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/random.h"

namespace tubesight::core::rendering {
namespace {

constexpr std::uint64_t kTileSeed = 20130;

/// A number of -1..1 for a node of a lattice of `period` nodes that repeats.
float node(std::int32_t x, std::int32_t y, std::int32_t period, std::uint32_t layer) {
  const std::int32_t column = ((x % period) + period) % period;
  const std::int32_t line = ((y % period) + period) % period;
  return static_cast<float>(2.0 * share_of(mixed(kTileSeed, column, line, layer)) - 1.0);
}

float eased(float share) { return share * share * (3.0F - 2.0F * share); }

/// One line of smooth noise: `period` cells over the tile, so that it repeats.
class NoiseLine {
 public:
  NoiseLine(std::int32_t y, std::int32_t period, std::uint32_t layer)
      : scale_(static_cast<float>(period) / SurfaceTexture::kSide) {
    const float line = static_cast<float>(y) * scale_;
    const auto top = static_cast<std::int32_t>(line);
    const float down = eased(line - static_cast<float>(top));
    for (std::int32_t x = 0; x <= period; ++x) {
      nodes_[static_cast<std::size_t>(x)] =
          node(x, top, period, layer) * (1.0F - down) + node(x, top + 1, period, layer) * down;
    }
  }

  [[nodiscard]] float at(std::int32_t x) const {
    const float column = static_cast<float>(x) * scale_;
    const auto left = static_cast<std::size_t>(column);
    const float across = eased(column - static_cast<float>(left));
    return nodes_[left] * (1.0F - across) + nodes_[left + 1] * across;
  }

 private:
  float scale_;
  std::array<float, 97> nodes_{};
};

/// Dark lines where smooth noise crosses zero: 0 in between, -1 on the line.
float vein(float noise) {
  const float near = std::abs(noise) * 9.0F;
  return near < 1.0F ? near - 1.0F : 0.0F;
}

}  // namespace

void SurfaceTexture::make() {
  for (std::int32_t y = 0; y < kSide; ++y) {
    // Cells of 1.1 mm, 2.1 mm and 6.4 mm, veins of 12 and 25 mm.
    const NoiseLine fine(y, 96, 1);
    const NoiseLine middle(y, 48, 2);
    const NoiseLine coarse(y, 16, 3);
    const NoiseLine thin(y, 8, 4);
    const NoiseLine wide(y, 4, 5);
    for (std::int32_t x = 0; x < kSide; ++x) {
      const float grain = 1.15F * fine.at(x) + 1.1F * middle.at(x) + 0.9F * coarse.at(x);
      const float value = grain + 0.9F * vein(thin.at(x)) + 0.7F * vein(wide.at(x)) + 0.2F;
      const float steps = std::clamp(1.25F * value / kStep, -127.0F, 127.0F);
      tile_[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] =
          static_cast<std::int8_t>(std::lround(steps));
    }
  }
}

float SurfaceTexture::between(float x, float y) const {
  const float left = std::floor(x);
  const float top = std::floor(y);
  const auto column = static_cast<std::int32_t>(left);
  const auto line = static_cast<std::int32_t>(top);
  const float across = x - left;
  const float down = y - top;
  const float upper = static_cast<float>(at(column, line)) * (1.0F - across) +
                      static_cast<float>(at(column + 1, line)) * across;
  const float lower = static_cast<float>(at(column, line + 1)) * (1.0F - across) +
                      static_cast<float>(at(column + 1, line + 1)) * across;
  return (upper * (1.0F - down) + lower * down) * kStep;
}

}  // namespace tubesight::core::rendering
