#pragma once

#include <array>
#include <cstdint>

#include "core/base/static_vector.h"
#include "core/rendering/disc.h"
#include "core/rendering/exposure.h"
#include "core/rendering/light_grid.h"
#include "core/rendering/scene.h"
#include "core/rendering/tube_ends.h"
#include "core/rendering/view.h"

namespace tubesight::core::rendering {

/// The discs of one exposure, those of a tube-end together and in the order to draw them, and which
/// of them a line meets.
class DiscList {
 public:
  /// A picture shows some 2,000 tube-ends larger than a pixel, whatever its own size: the plate
  /// beyond is dark.
  static constexpr std::int32_t kMaxDiscs = 8192;
  static constexpr std::int32_t kMaxTubes = 4096;

  /// Finds all tube-ends in lines top..bottom and makes their discs.
  void fill(const Scene& scene, const TubeEnds& ends, const View& view, const Exposure& exposure,
            const LightGrid& light, std::int32_t top, std::int32_t bottom);

  /// Draws line `v`; lines come in growing order, from the first.
  void draw(std::int32_t v, std::int32_t first, std::int32_t last, bool moves, Row& row);

 private:
  /// The discs first..first + count - 1 of one tube-end.
  struct Tube {
    std::int32_t first = 0, count = 0;
    std::int32_t top = 0, bottom = -1;
    std::int32_t next = -1;  // further one that begins in the same line
  };

  void add_tube(const Scene& scene, const TubeEnds& ends, const View& view,
                const Exposure& exposure, const LightGrid& light, TubeAddress address);

  StaticVector<Disc, kMaxDiscs> discs_;
  StaticVector<Tube, kMaxTubes> tubes_;
  StaticVector<std::int32_t, kMaxTubes> active_;
  std::array<std::int32_t, kMaxPictureSide> begins_{};  // first tube by line; -1: none
  std::int32_t top_ = 0;
  std::int32_t bottom_ = 0;
  std::int32_t entered_ = 0;  // lines whose tubes are active already
};

}  // namespace tubesight::core::rendering
