#include "board/box/overlay_composer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/instantiate.h"
#include "core/tracking/candidates.h"

namespace tubesight::board {
namespace {

core::ImagePoint image_point(const std::array<double, 2>& px) {
  constexpr double kQ16 = 65536.0;
  return {static_cast<std::int32_t>(std::lround(px[0] * kQ16)),
          static_cast<std::int32_t>(std::lround(px[1] * kQ16))};
}

template <core::Scalar S>
std::optional<core::ImagePoint> locate(const core::session::Session<S>& session,
                                       core::TubeAddress address) {
  core::ImagePoint pixel;
  return session.tracker().locate(address, pixel) ? std::optional(pixel) : std::nullopt;
}

}  // namespace

template <core::Scalar S>
OverlayComposer<S>::OverlayComposer(const core::SessionSettings& settings, bool estimates)
    : with_estimates_(estimates) {
  const auto& window = settings.start.window_px;
  input_.window = core::overlay::PixelBox{window[0], window[1], window[2], window[3]};
  input_.optimum_px = image_point(settings.start.optimum_px);
  const std::int32_t width_px = settings.camera.width_px;
  const std::int32_t height_px = settings.camera.height_px;
  pixels_.resize(std::size_t{3} * static_cast<std::size_t>(width_px) *
                 static_cast<std::size_t>(height_px));
  picture_ = {pixels_.data(), width_px, height_px, 3 * width_px};
}

template <core::Scalar S>
core::RgbImageView OverlayComposer<S>::compose(const core::ImageView& frame, std::int64_t field,
                                               const core::session::Session<S>& session,
                                               const core::session::Output& output) {
  input_.sighting = output.sighting;
  input_.tubes = output.tubes.view();
  input_.field = field;
  input_.next_row_px.reset();
  input_.next_column_px.reset();
  if (output.sighting.primary_known) {
    const core::TubeAddress primary = output.sighting.primary;
    input_.next_row_px = locate<S>(session, {primary.row + 1, primary.column});
    input_.next_column_px = locate<S>(session, {primary.row, primary.column + 1});
  }
  if (with_estimates_) {
    list_estimates(session, output);
    input_.estimates = estimates_;
  }
  core::overlay::copy_grey(frame, picture_);
  core::overlay::draw_overlay(picture_, input_);
  return picture_;
}

template <core::Scalar S>
void OverlayComposer<S>::list_estimates(const core::session::Session<S>& session,
                                        const core::session::Output& output) {
  estimates_.clear();
  core::tracking::CandidateList<S> expected;
  session.tracker().list_estimates(expected);
  for (const auto& tube : expected) {
    estimates_.push_back(
        {tube.address,
         {core::to_scaled(tube.center_px.x, 16), core::to_scaled(tube.center_px.y, 16)},
         tube.state});
  }
  for (const core::TubeSighting& seen : output.tubes) {
    const auto same = std::find_if(
        estimates_.begin(), estimates_.end(),
        [&](const core::overlay::Estimate& estimate) { return estimate.address == seen.address; });
    if (seen.plug && same != estimates_.end()) {
      same->state = core::TubeState::kPlugged;
    }
  }
}

TUBESIGHT_INSTANTIATE_CLASS(OverlayComposer)

}  // namespace tubesight::board
