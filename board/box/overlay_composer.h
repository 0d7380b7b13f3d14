#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/overlay/overlay.h"
#include "core/session/session.h"

namespace tubesight::board {

/// Draws what the operator sees: the recorded frame in grey, the overlay of one field in colour.
template <core::Scalar S>
class OverlayComposer {
 public:
  /// `estimates`: mark where every tube is expected, too.
  OverlayComposer(const core::SessionSettings& settings, bool estimates);

  /// Draws the field that `session` has just processed with the answer `output`. The view is valid
  /// until the next call. `frame` has the settings' size.
  [[nodiscard]] core::RgbImageView compose(const core::ImageView& frame, std::int64_t field,
                                           const core::session::Session<S>& session,
                                           const core::session::Output& output);

 private:
  void list_estimates(const core::session::Session<S>& session,
                      const core::session::Output& output);

  core::overlay::OverlayInput input_;
  bool with_estimates_;
  std::vector<std::uint8_t> pixels_;
  core::RgbImageView picture_;
  std::vector<core::overlay::Estimate> estimates_;
};

}  // namespace tubesight::board
