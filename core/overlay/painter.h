#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/image_view.h"
#include "core/overlay/pixels.h"

namespace tubesight::core::overlay {

/// Draws pixels, lines, boxes and text into somebody's RGB picture, clipped at its edges.
///
/// Every call takes any coordinates: what lies outside is left out and never wraps to the other
/// side; coordinates beyond +-2^24 px are taken as +-2^24. The part inside is the same, pixel for
/// pixel, as if the picture were larger. Costs are proportional to the pixels drawn inside, plus
/// the picture's longer side for a line. Nothing is allocated; the picture must outlive the
/// painter.
class Painter {
 public:
  /// Takes a picture of at least one pixel; a view that contradicts itself is asserted.
  explicit Painter(const RgbImageView& picture);

  [[nodiscard]] std::int32_t width_px() const { return picture_.width_px; }
  [[nodiscard]] std::int32_t height_px() const { return picture_.height_px; }

  /// Sets one pixel.
  void pixel(PixelPoint at, Rgb colour);

  /// Fills a box, edges included; an empty box draws nothing.
  void fill(const PixelBox& box, Rgb colour);

  /// Draws the frame of a box, `thickness_px` >= 1 inwards from its edges.
  void outline(const PixelBox& box, std::int32_t thickness_px, Rgb colour);

  /// Draws a line, both ends included, with a square brush of `thickness_px` >= 1.
  ///
  /// The brush's middle is the pixel nearest to the ideal line; an even brush reaches one pixel
  /// farther right and down than left and up.
  void line(PixelPoint from, PixelPoint to, std::int32_t thickness_px, Rgb colour);

  /// Draws an upright cross whose four arms run from `gap_px` to `reach_px` off the centre, both
  /// included; a gap of 0 closes it.
  void cross_hair(PixelPoint center, std::int32_t gap_px, std::int32_t reach_px,
                  std::int32_t thickness_px, Rgb colour);

  /// Draws an x whose ends lie `reach_px` right or left of and above or below the centre.
  void diagonal_cross(PixelPoint center, std::int32_t reach_px, std::int32_t thickness_px,
                      Rgb colour);

  /// Draws the outline, one pixel wide, of a circle with a radius of 0..4096 px (asserted).
  void circle(PixelPoint center, std::int32_t radius_px, Rgb colour);

  /// Fills the ring of pixels whose centres lie between two distances from `center`'s, those of
  /// `inner_px` - 1/2 and `outer_px` + 1/2, for 0 <= inner_px <= outer_px <= 4096 (asserted).
  void ring(PixelPoint center, std::int32_t inner_px, std::int32_t outer_px, Rgb colour);

  /// Writes one line of text, `scale` >= 1 pixels a dot, `top_left` being the first cell's corner.
  ///
  /// See font.h for what it measures and which characters there are.
  void text(PixelPoint top_left, std::string_view words, std::int32_t scale, Rgb colour);

 private:
  void brush(PixelPoint at, std::int32_t thickness_px, Rgb colour);

  RgbImageView picture_;
};

}  // namespace tubesight::core::overlay
