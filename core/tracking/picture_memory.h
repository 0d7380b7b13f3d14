#pragma once

#include <array>
#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core::tracking {

/// How much of a picture is, to the last bit, the picture of the same lines before it.
struct PictureLikeness {
  std::int32_t compared = 0;  ///< lines looked at that show grey, where noise shows
  std::int32_t equal = 0;     ///< of those, the same as before

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [lines, same] = self;
    stream.number(lines, 0, 1 << 16);
    stream.number(same, 0, 1 << 16);
  }
};

/// Remembers the last picture of each parity, to recognise one that is delivered again.
///
/// A frame store that stops, or a torn field, shows the sheet where it was: the box would believe
/// the tool at rest and go on naming a tube that the tool has left. A camera's noise is never the
/// same twice, so a line of 64 equal pixels is the old picture. Twelve lines spread over the window
/// are kept as sums; some 2,000 instructions a field. Windows under 64 pixels
/// wide are not remembered.
class PictureMemory {
 public:
  static constexpr std::int32_t kLines = 12;

  void clear() { *this = {}; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [sums] = self;
    stream(sums);
  }

  /// Compares a picture with the last of its parity and puts it in its place. The window
  /// lies in the picture.
  [[nodiscard]] PictureLikeness look(const FieldView& field, Parity parity, const PixelBox& window);

 private:
  /// Sums of the sampled lines; 0: nothing to compare with.
  using Sums = std::array<std::uint64_t, static_cast<std::size_t>(kLines)>;
  std::array<Sums, 3> sums_{};  ///< by parity
};

}  // namespace tubesight::core::tracking
