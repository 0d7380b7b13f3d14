#pragma once

#include <array>
#include <cstdint>

#include "core/rendering/exposure.h"
#include "core/rendering/row.h"
#include "core/rendering/scene.h"

namespace tubesight::core::rendering {

/// Light of a line into bytes: gain, noise, interference, black level and saturation.
class SensorNoise {
 public:
  /// Fills the table of normal numbers.
  void make();

  /// Turns `row.signal` + `row.glow` of the columns first..last into bytes of line `v`.
  void develop(const Row& row, const SensorLook& look, const Exposure& exposure, std::int32_t v,
               std::int32_t first, std::int32_t last, std::uint8_t* bytes) const;

 private:
  void interfere(const SensorLook& look, std::uint64_t bits, std::int32_t first, std::int32_t last,
                 std::uint8_t* bytes) const;

  /// Normal numbers; a line begins at two random places and adds what it finds there, so that no
  /// two lines of a run are alike.
  static constexpr std::size_t kTable = 32768;
  std::array<float, kTable + 2 * kMaxPictureSide> normal_{};
};

}  // namespace tubesight::core::rendering
