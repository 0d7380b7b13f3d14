#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace tubesight::tests {

/// A picture of three bytes a pixel without padding.
struct Picture {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint8_t> bytes;
};

/// One made-up moment of an inspection whose display is kept as a golden picture.
struct Scene {
  std::string_view name;  ///< tests/data/golden/overlay-NAME.png
  std::uint64_t digest;   ///< FNV-1a, 64 bits, of the golden picture's bytes
  Picture (*draw)();      ///< draws it anew with the code under test
};

/// All scenes.
[[nodiscard]] std::span<const Scene> scenes();

/// FNV-1a, 64 bits, of a picture's bytes.
[[nodiscard]] std::uint64_t digest_of(const Picture& picture);

}  // namespace tubesight::tests
