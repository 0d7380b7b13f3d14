#pragma once

#include <cstdint>
#include <vector>

#include "board/box/overlay_snapshot.h"
#include "core/base/image_view.h"
#include "core/base/settings.h"
#include "core/overlay/overlay.h"

namespace tubesight::board {

/// Draws what the operator sees: the picture in grey, the marks of one field in colour. Knows no
/// tracker, so that it may work on another thread.
class OverlayComposer {
 public:
  explicit OverlayComposer(const core::SessionSettings& settings);

  /// Draws the field that `snapshot` tells of. The view is valid until the next call. `frame` has
  /// the settings' size.
  [[nodiscard]] core::RgbImageView compose(const core::ImageView& frame,
                                           const OverlaySnapshot& snapshot);

 private:
  core::overlay::OverlayInput input_;
  std::vector<std::uint8_t> pixels_;
  core::RgbImageView picture_;
};

}  // namespace tubesight::board
