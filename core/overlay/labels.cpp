#include "core/overlay/labels.h"

#include <cstdlib>

#include "core/overlay/font.h"
#include "core/overlay/palette.h"

namespace tubesight::core::overlay {
namespace {

// Where an estimate's address is written: centred beneath its dot.
PixelBox address_box(PixelPoint at, std::string_view words, MarkScale scale) {
  constexpr std::int32_t kBelow = 8;
  return label_box(at.u_px, at.v_px + scale.px(kBelow), words, scale);
}

bool overlap(const PixelBox& a, const PixelBox& b, std::int32_t aside_px) {
  return a.left <= b.right + aside_px && b.left <= a.right + aside_px && a.top <= b.bottom &&
         b.top <= a.bottom;
}

// Whether the address of `tubes[index]` can be written in `box` without touching another one's dot
// or address. Of two addresses that touch none is written, so that the choice does not depend on
// the order.
bool has_room(MarkScale scale, std::span<const Estimate> tubes, std::size_t index,
              const PixelBox& box) {
  // The longest address is 23 characters of 6 dots wide; beneath are its letters and their gap.
  const std::int32_t far_px = 23 * kCellWidth * scale.text() + scale.px(8);
  const std::int32_t beneath_px = kGlyphHeight * scale.text() + scale.px(16);
  const std::int32_t dot_px = scale.px(3);
  const PixelPoint at = nearest_pixel(tubes[index].center_px);
  for (std::size_t other = 0; other < tubes.size(); ++other) {
    const PixelPoint place = nearest_pixel(tubes[other].center_px);
    if (other == index || std::abs(place.v_px - at.v_px) > beneath_px ||
        std::abs(place.u_px - at.u_px) > far_px) {
      continue;
    }
    const TextLine words = address_text(tubes[other].address);
    if (overlap(box,
                PixelBox{place.u_px - dot_px, place.v_px - dot_px, place.u_px + dot_px,
                         place.v_px + dot_px},
                scale.px(2)) ||
        overlap(box, address_box(place, words.view(), scale), scale.px(2))) {
      return false;
    }
  }
  return true;
}

}  // namespace

Rgb estimate_colour(TubeState state) {
  switch (state) {
    case TubeState::kOpen: return palette::kEstimateOpen;
    case TubeState::kPlugged: return palette::kEstimatePlugged;
    case TubeState::kAbsent: break;
  }
  return palette::kEstimateAbsent;
}

TextLine address_text(TubeAddress address) {
  TextLine line;
  line.integer(address.row).words(",").integer(address.column);
  return line;
}

PixelBox label_box(std::int32_t middle_px, std::int32_t top_px, std::string_view words,
                   MarkScale scale) {
  const std::int32_t width = text_width_px(words, scale.text());
  const std::int32_t left = middle_px - width / 2;
  return {left, top_px, left + width - 1, top_px + (kCapitalHeight + 2) * scale.text() - 1};
}

void draw_label(Painter& painter, MarkScale scale, const PixelBox& box, std::string_view words,
                Rgb colour) {
  if (box.left < 0 || box.top < 0 || box.right >= painter.width_px() ||
      box.bottom >= painter.height_px()) {
    return;
  }
  const std::int32_t edge = scale.text();
  painter.fill({box.left - edge, box.top - edge, box.right + edge, box.bottom}, palette::kBlack);
  painter.text({box.left, box.top}, words, scale.text(), colour);
}

void draw_addresses(Painter& painter, MarkScale scale, std::span<const Estimate> tubes) {
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    if (tubes[i].state == TubeState::kAbsent) {
      continue;
    }
    const TextLine words = address_text(tubes[i].address);
    const PixelBox box = address_box(nearest_pixel(tubes[i].center_px), words.view(), scale);
    if (has_room(scale, tubes, i, box)) {
      draw_label(painter, scale, box, words.view(), estimate_colour(tubes[i].state));
    }
  }
}

}  // namespace tubesight::core::overlay
