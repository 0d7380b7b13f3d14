#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core::tracking {

/// How much of a picture is the picture of the same lines before it, block by block.
///
/// The noise of a block is that of the difference of both pictures, 56 times its variance: what
/// changes a block's brightness as a whole (a lamp, interference) is not in it.
struct PictureLikeness {
  std::int32_t compared = 0;      ///< blocks looked at that show grey in which noise can be
  std::int32_t equal = 0;         ///< of those, the same as before to the last bit
  std::int32_t equal_edges = 0;   ///< of those, equal and with an edge in them
  std::int32_t quiet = 0;         ///< of those, with less than half of the noise expected
  std::int32_t noise = 0;         ///< of all compared, on average
  std::int32_t middle_noise = 0;  ///< of the middle one in their order
  std::int32_t grey = 0;          ///< of all compared, on average
  std::int32_t contrast = 0;      ///< variance of the blocks' grey, of all in the window

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [blocks, same, same_edges, few, mean, middle, level, spread] = self;
    constexpr std::int32_t kMost = 1 << 24;
    stream.number(blocks, 0, kMost);
    stream.number(same, 0, kMost);
    stream.number(same_edges, 0, kMost);
    stream.number(few, 0, kMost);
    stream.number(mean, 0, kMost);
    stream.number(middle, 0, kMost);
    stream.number(level, 0, kMost);
    stream.number(spread, 0, kMost);
  }
};

/// Remembers a picture of each parity, to recognise one that is delivered again, whole or in parts.
///
/// A frame store that stops, or a torn field, shows the sheet where it was: the box would believe
/// the tool at rest and go on naming a tube that the tool has left. Seventy blocks of eight pixels,
/// on ten lines spread over the window, are kept as they are; some 5,000 instructions a field.
/// Windows under 64 pixels wide are not remembered. Integers alone.
class PictureMemory {
 public:
  static constexpr std::int32_t kLines = 10;
  static constexpr std::int32_t kBlocks = 7;    ///< of a line, spread over it
  static constexpr std::int32_t kBlock_px = 8;  ///< as many as a register takes at once

  void clear() { *this = {}; }

  /// Compares a picture with the one that is kept of its parity. `usual_noise` is what a block is
  /// expected to have. The window lies in the picture.
  [[nodiscard]] PictureLikeness look(const FieldView& field, Parity parity, const PixelBox& window,
                                     std::int32_t usual_noise) const;

  /// Keeps a picture in the place of the last of its parity.
  void keep(const FieldView& field, Parity parity, const PixelBox& window);

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [kept, known] = self;
    stream(kept, known);
  }

 private:
  static constexpr std::size_t kAll = std::size_t{kLines} * kBlocks;
  using Pixels = std::array<std::uint8_t, kAll * kBlock_px>;

  /// Fields of whole frames have the place of even ones: no camera has both.
  static constexpr std::size_t place_of(Parity parity) { return parity == Parity::kOdd ? 1 : 0; }

  std::array<Pixels, 2> kept_{};
  std::array<bool, 2> known_{};
};

}  // namespace tubesight::core::tracking
