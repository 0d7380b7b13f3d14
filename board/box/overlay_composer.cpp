#include "board/box/overlay_composer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/tubesheet/sheet_places.h"

namespace tubesight::board {
namespace {

core::ImagePoint image_point(const std::array<double, 2>& px) {
  constexpr double kQ16 = 65536.0;
  return {static_cast<std::int32_t>(std::lround(px[0] * kQ16)),
          static_cast<std::int32_t>(std::lround(px[1] * kQ16))};
}

std::int32_t pixels_up(double px) {
  constexpr double kMost_px = 8192.0;
  return static_cast<std::int32_t>(std::ceil(std::min(px, kMost_px)));
}

}  // namespace

OverlayComposer::OverlayComposer(const core::SessionSettings& settings) {
  const auto& window = settings.start.window_px;
  input_.window = core::PixelBox{window[0], window[1], window[2], window[3]};
  input_.optimum_px = image_point(settings.start.optimum_px);
  input_.aligned_within_um_q8 =
      static_cast<std::int32_t>(std::lround(settings.verification.aligned_within_mm * 256'000.0));
  const double radius_mm = settings.tubesheet.bore_mm / 2.0;
  const auto place = [&](double x_mm, double y_mm) {
    return core::tubesheet::lattice_place(settings.tubesheet, {x_mm, y_mm});
  };
  const auto origin = place(0.0, 0.0);
  const auto along_x = place(radius_mm, 0.0);
  const auto along_y = place(0.0, radius_mm);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    rim_steps_[i] = {along_x[i] - origin[i], along_y[i] - origin[i]};
  }
  const std::int32_t width_px = settings.camera.width_px;
  const std::int32_t height_px =
      core::overlay::overlay_height_px(width_px, settings.camera.height_px);
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
  input_.tool_rim =
      snapshot.around_tool_px ? std::optional(rim_of(*snapshot.around_tool_px)) : std::nullopt;
  input_.estimates = snapshot.estimates.view();
  input_.news = {snapshot.news.clicks().view(), snapshot.news.refusal(), snapshot.news.claim(),
                 snapshot.claimed_px};
  core::overlay::copy_grey(frame, picture_);
  core::overlay::draw_overlay(picture_, input_);
  return picture_;
}

// Near a tube the image of the sheet is its linear part: a circle on the sheet is an ellipse, and
// the half of its size along u is the length of that part's first line, as a share of the radius.
core::overlay::HalfSize OverlayComposer::rim_of(
    const std::array<core::ImagePoint, 4>& around_px) const {
  constexpr double kTwoPixels_q16 = 131'072.0;
  const auto half = [&](double by_row, double by_column) {
    return pixels_up(std::hypot(by_row * rim_steps_[0][0] + by_column * rim_steps_[1][0],
                                by_row * rim_steps_[0][1] + by_column * rim_steps_[1][1]));
  };
  const auto step = [](std::int32_t after_q16, std::int32_t before_q16) {
    return (static_cast<double>(after_q16) - static_cast<double>(before_q16)) / kTwoPixels_q16;
  };
  return {half(step(around_px[0].u_q16, around_px[1].u_q16),
               step(around_px[2].u_q16, around_px[3].u_q16)),
          half(step(around_px[0].v_q16, around_px[1].v_q16),
               step(around_px[2].v_q16, around_px[3].v_q16))};
}

}  // namespace tubesight::board
