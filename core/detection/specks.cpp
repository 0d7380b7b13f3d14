#include "core/detection/specks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

namespace tubesight::core::detection {

picture::AveragedPicture remove_specks(const picture::AveragedPicture& picture,
                                       std::span<std::uint16_t> scratch) {
  // Far beyond the noise of a pixel and the steepest edge of a small dot.
  constexpr std::int32_t kFar = 32 * picture::kGreyScale;
  const std::int32_t width = picture.width_px;
  const std::int32_t height = picture.height_px;
  for (std::int32_t v = 0; v < height; ++v) {
    const std::uint16_t* const line = picture.line(v);
    std::uint16_t* const to = scratch.data() + static_cast<std::ptrdiff_t>(v) * width;
    std::copy_n(line, width, to);
    for (std::int32_t u = 1; u + 1 < width; ++u) {
      // Nearly all pixels are near to one beside them.
      if (std::abs(line[u] - line[u - 1]) <= kFar || std::abs(line[u] - line[u + 1]) <= kFar) {
        continue;
      }
      std::int32_t sum = 0;
      std::int32_t count = 0;
      std::array<std::int32_t, 2> least = {0xffff, 0xffff};
      std::array<std::int32_t, 2> most = {0, 0};
      for (std::int32_t j = std::max(0, v - 1); j <= std::min(height - 1, v + 1); ++j) {
        for (std::int32_t i = u - 1; i <= u + 1; ++i) {
          if (i != u || j != v) {
            const std::int32_t grey = picture.at(i, j);
            sum += grey;
            ++count;
            least[1] = std::min(least[1], std::max(least[0], grey));
            least[0] = std::min(least[0], grey);
            most[1] = std::max(most[1], std::min(most[0], grey));
            most[0] = std::max(most[0], grey);
          }
        }
      }
      if (line[u] > most[1] + kFar || line[u] < least[1] - kFar) {
        to[u] = static_cast<std::uint16_t>((sum - least[0] - most[0]) / (count - 2));
      }
    }
  }
  return {scratch.data(), width, height};
}

}  // namespace tubesight::core::detection
