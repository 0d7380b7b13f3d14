#pragma once

#include <array>
#include <cstdint>

#include "core/rendering/renderer_limits.h"

namespace tubesight::core::rendering {

/// One line of the picture while it is drawn; all stay in the processor's first cache. Grey levels
/// are those before gain, offset and noise.
struct Row {
  /// Room for a few pixels over, so that whole vectors may be written.
  static constexpr std::size_t kCapacity = kMaxPictureSide + 32;
  using Line = std::array<float, kCapacity>;

  alignas(64) Line ray_x{};     ///< ray (x, y, 1) of each pixel, camera frame: x
  alignas(64) Line ray_y{};     ///< likewise, y
  alignas(64) Line light{};     ///< grey level of a plain plate there
  alignas(64) Line plate{};     ///< the same with the texture: the picture without tube-ends
  alignas(64) Line sheet_x{};   ///< place on the plate, texels: x
  alignas(64) Line sheet_y{};   ///< likewise, y
  alignas(64) Line fineness{};  ///< how much of the grain is resolved, 0..1
  alignas(64) Line glow{};      ///< veil and blooming, grey levels
  alignas(64) Line motion_u{};  ///< way during the exposure, px: to the right
  alignas(64) Line motion_v{};  ///< likewise, down
  alignas(64) std::array<std::int32_t, kCapacity> texel{};  ///< index of the texture's texel
  alignas(64) Line signal{};                                ///< the picture so far
};

}  // namespace tubesight::core::rendering
