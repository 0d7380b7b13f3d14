#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "board/box/overlay_snapshot.h"
#include "core/base/image_view.h"
#include "core/base/settings.h"
#include "core/overlay/overlay.h"

namespace tubesight::board {

/// Draws what the operator sees: the picture in grey, the marks of one field in colour, and the
/// readout below it. Knows no tracker, so that it may work on another thread.
class OverlayComposer {
 public:
  explicit OverlayComposer(const core::SessionSettings& settings);

  /// Draws the field that `snapshot` tells of. The view is valid until the next call. `frame` has
  /// the settings' size; the overlay is as wide and higher, by core::overlay::overlay_height_px().
  [[nodiscard]] core::RgbImageView compose(const core::ImageView& frame,
                                           const OverlaySnapshot& snapshot);

 private:
  [[nodiscard]] core::overlay::HalfSize rim_of(
      const std::array<core::ImagePoint, 4>& around_px) const;

  core::overlay::OverlayInput input_;
  /// Radius of a tube-end in steps of the lattice: a rim's point is this times (cosine, sine) of
  /// its angle on the sheet, as shares of a row's and of a column's step.
  std::array<std::array<double, 2>, 2> rim_steps_{};
  std::vector<std::uint8_t> pixels_;
  core::RgbImageView picture_;
};

}  // namespace tubesight::board
