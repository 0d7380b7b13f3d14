#include "board/box/overlay_composer.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tubesight::board {
namespace {

core::ImagePoint image_point(const std::array<double, 2>& px) {
  constexpr double kQ16 = 65536.0;
  return {static_cast<std::int32_t>(std::lround(px[0] * kQ16)),
          static_cast<std::int32_t>(std::lround(px[1] * kQ16))};
}

}  // namespace

OverlayComposer::OverlayComposer(const core::SessionSettings& settings) {
  const auto& window = settings.start.window_px;
  input_.window = core::PixelBox{window[0], window[1], window[2], window[3]};
  input_.optimum_px = image_point(settings.start.optimum_px);
  const std::int32_t width_px = settings.camera.width_px;
  const std::int32_t height_px = settings.camera.height_px;
  pixels_.resize(std::size_t{3} * static_cast<std::size_t>(width_px) *
                 static_cast<std::size_t>(height_px));
  picture_ = {pixels_.data(), width_px, height_px, 3 * width_px};
}

core::RgbImageView OverlayComposer::compose(const core::ImageView& frame,
                                            const OverlaySnapshot& snapshot) {
  input_.sighting = snapshot.sighting;
  input_.tubes = snapshot.tubes.view();
  input_.field = snapshot.field;
  input_.next_row_px = snapshot.next_row_px;
  input_.next_column_px = snapshot.next_column_px;
  input_.estimates = snapshot.estimates.view();
  core::overlay::copy_grey(frame, picture_);
  core::overlay::draw_overlay(picture_, input_);
  return picture_;
}

}  // namespace tubesight::board
