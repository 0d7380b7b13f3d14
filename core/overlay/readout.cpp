#include "core/overlay/readout.h"

#include <algorithm>

#include "core/base/words.h"
#include "core/overlay/font.h"
#include "core/overlay/palette.h"
#include "core/overlay/text_line.h"

namespace tubesight::core::overlay {
namespace {

// Sizes in picture pixels, from the picture's width: 635 px give letters of 7, 14 and 21 px.
struct Layout {
  std::int32_t caption_scale = 1;
  std::int32_t text_scale = 1;
  std::int32_t number_scale = 2;
  std::int32_t pad_px = 4;
  std::int32_t caption_bottom = 0;  ///< distance of each line's baseline from the box's top
  std::int32_t number_bottom = 0;
  std::int32_t text_bottom = 0;
  std::int32_t height_px = 0;
};

// A column of the box being written from left to right; `right` is the last pixel of it.
struct Column {
  std::int32_t left = 0;
  std::int32_t right = 0;

  [[nodiscard]] std::int32_t room_px() const { return right - left + 1; }
};

constexpr std::int32_t kSmallestWidth_px = 320;

Layout layout_for(std::int32_t width_px) {
  const std::int32_t unit = width_px / 560;
  Layout layout;
  layout.caption_scale = std::clamp(unit, 1, kLargestTextScale / 3);
  layout.text_scale = std::clamp(2 * unit, 1, 2 * kLargestTextScale / 3);
  layout.number_scale = std::clamp(3 * unit, 2, kLargestTextScale);
  layout.pad_px = 4 * layout.caption_scale;
  layout.caption_bottom = layout.pad_px + kCapitalHeight * layout.caption_scale;
  layout.number_bottom =
      layout.caption_bottom + layout.pad_px + kCapitalHeight * layout.number_scale;
  // A chip reaches one text dot and a half beyond its letters; tails reach two below the baseline.
  layout.text_bottom =
      layout.number_bottom + layout.pad_px + (kCapitalHeight + 2) * layout.text_scale;
  layout.height_px = layout.text_bottom + 2 * layout.text_scale + layout.pad_px;
  return layout;
}

// Writes words that stand on `bottom` (the pixel line below the letters) and moves the column's
// left edge behind them; says false, and writes nothing, where they do not fit.
bool put(Painter& painter, Column& column, std::int32_t bottom, std::string_view words,
         std::int32_t scale, Rgb colour) {
  const std::int32_t width = text_width_px(words, scale);
  if (width > column.room_px()) {
    return false;
  }
  painter.text({column.left, bottom - kCapitalHeight * scale}, words, scale, colour);
  column.left += width + kCellWidth * scale;
  return true;
}

// As `put`, at the column's right end.
bool put_right(Painter& painter, Column& column, std::int32_t bottom, std::string_view words,
               std::int32_t scale, Rgb colour) {
  const std::int32_t width = text_width_px(words, scale);
  if (width > column.room_px()) {
    return false;
  }
  const std::int32_t left = column.right - width + 1;
  painter.text({left, bottom - kCapitalHeight * scale}, words, scale, colour);
  column.right = left - kCellWidth * scale;
  return true;
}

// As `put`, trying smaller letters before giving up.
void put_shrinking(Painter& painter, Column& column, std::int32_t bottom, std::string_view words,
                   std::int32_t scale, Rgb colour) {
  while (scale >= 1 && !put(painter, column, bottom, words, scale, colour)) {
    --scale;
  }
}

std::int32_t chip_width_px(std::string_view words, std::int32_t scale) {
  return text_width_px(words, scale) + 4 * scale;
}

// Black words in a box of colour, which is seen from farther away than the words are read.
bool put_chip(Painter& painter, Column& column, std::int32_t bottom, std::string_view words,
              std::int32_t scale, Rgb colour) {
  const std::int32_t width = chip_width_px(words, scale);
  if (width > column.room_px()) {
    return false;
  }
  const std::int32_t top = bottom - kCapitalHeight * scale;
  painter.fill({column.left, top - 2 * scale, column.left + width - 1, bottom + 2 * scale - 1},
               colour);
  painter.text({column.left + 2 * scale, top}, words, scale, palette::kBlack);
  column.left += width + kCellWidth * scale;
  return true;
}

// "ROW 40  COL 60" with small words and large numbers; both or none, as large as they fit.
void put_address(Painter& painter, Column& column, std::int32_t bottom, const Layout& layout,
                 const std::optional<TubeAddress>& address, Rgb row_colour, Rgb column_colour) {
  TextLine row;
  TextLine col;
  if (address) {
    row.integer(address->row);
    col.integer(address->column);
  } else {
    row.words("--");
    col.words("--");
    row_colour = palette::kUnknown;
    column_colour = palette::kUnknown;
  }
  for (std::int32_t scale = layout.number_scale; scale >= 1; --scale) {
    const std::int32_t small = std::min(layout.text_scale, scale);
    const std::int32_t words = 2 * (text_width_px("ROW", small) + 4 * small);
    const std::int32_t numbers =
        text_width_px(row.view(), scale) + text_width_px(col.view(), scale);
    const std::int32_t between = 4 * scale;
    if (words + numbers + between > column.room_px()) {
      continue;
    }
    const auto write = [&](std::string_view text, std::int32_t text_scale, std::int32_t gap,
                           Rgb colour) {
      painter.text({column.left, bottom - kCapitalHeight * text_scale}, text, text_scale, colour);
      column.left += text_width_px(text, text_scale) + gap;
    };
    write("ROW", small, 4 * small, row_colour);
    write(row.view(), scale, between, row_colour);
    write("COL", small, 4 * small, column_colour);
    write(col.view(), scale, kCellWidth * scale, column_colour);
    return;
  }
}

Rgb state_colour(TrackState state) {
  switch (state) {
    case TrackState::kTracking: return palette::kStateTracking;
    case TrackState::kDegraded: return palette::kStateDegraded;
    case TrackState::kLost: return palette::kStateLost;
    case TrackState::kWaiting: break;
  }
  return palette::kStateWaiting;
}

void draw_left(Painter& painter, Column full, std::int32_t top, const Layout& layout,
               const Sighting& sighting) {
  Column line = full;
  put(painter, line, top + layout.caption_bottom, "PRIMARY TUBE", layout.caption_scale,
      palette::kCaption);
  TextLine tracked;
  tracked.integer(sighting.tracked).words(" tracked");
  put_right(painter, line, top + layout.caption_bottom, tracked.view(), layout.caption_scale,
            palette::kCaption);

  line = full;
  const auto address =
      sighting.primary_known ? std::optional(sighting.primary) : std::optional<TubeAddress>();
  put_address(painter, line, top + layout.number_bottom, layout, address, palette::kRow,
              palette::kColumn);

  line = full;
  const Rgb colour = state_colour(sighting.state);
  put_chip(painter, line, top + layout.text_bottom, state_words(sighting.state), layout.text_scale,
           colour);
  put_shrinking(painter, line, top + layout.text_bottom, words_of(sighting.reason).mark,
                layout.text_scale, colour);
}

void draw_right(Painter& painter, Column full, std::int32_t top, const Layout& layout,
                const Sighting& sighting, std::optional<std::int64_t> field) {
  Column line = full;
  put(painter, line, top + layout.caption_bottom, "TUBE ABOVE GUIDETUBE", layout.caption_scale,
      palette::kCaption);
  if (field) {
    TextLine when;
    when.words("field ").integer(*field).words("  ");
    when.decimal(nearest_quotient(sighting.time.count(), 1'000'000), 3).words(" s");
    put_right(painter, line, top + layout.caption_bottom, when.view(), layout.caption_scale,
              palette::kCaption);
  }

  // Room for the widest verdict is kept free first: the numbers may shrink, the verdict never does.
  constexpr std::string_view kAligned = "ALIGNED";
  line = full;
  const std::int32_t verdict_px = chip_width_px(kAligned, layout.text_scale);
  Column verdict{std::max(full.left, full.right - verdict_px + 1), full.right};
  line.right = verdict.left - kCellWidth * layout.caption_scale;
  const auto address =
      sighting.tool_known ? std::optional(sighting.tool) : std::optional<TubeAddress>();
  put_address(painter, line, top + layout.number_bottom, layout, address, palette::kTool,
              palette::kTool);
  // The box vouches for a tube that it knows, never for none.
  if (sighting.tool_known && sighting.aligned) {
    put_chip(painter, verdict, top + layout.number_bottom, kAligned, layout.text_scale,
             palette::kStateTracking);
  } else if (sighting.tool_known) {
    put_right(painter, verdict, top + layout.number_bottom, "not aligned", layout.caption_scale,
              palette::kStateDegraded);
  }

  line = full;
  TextLine distances;
  if (sighting.tool_known) {
    // 1/256 um to 1/100 mm and 1/10 mm.
    distances.words("offset ").decimal(nearest_quotient(sighting.offset_um_q8, 2'560), 2);
    distances.words(sighting.axis_known ? "  " : " mm");
  }
  if (sighting.axis_known) {
    distances.words("height ").decimal(nearest_quotient(sighting.height_um_q8, 25'600), 1);
    distances.words(" mm");
  }
  put_shrinking(painter, line, top + layout.text_bottom, distances.view(), layout.text_scale,
                palette::kTool);
}

}  // namespace

std::int32_t readout_height_px(std::int32_t width_px, std::int32_t height_px) {
  const std::int32_t height = layout_for(width_px).height_px;
  return width_px >= kSmallestWidth_px && height_px / 3 >= height ? height : 0;
}

void draw_readout(Painter& painter, const Sighting& sighting, std::optional<std::int64_t> field) {
  const std::int32_t width = painter.width_px();
  const std::int32_t height = readout_height_px(width, painter.height_px());
  if (height == 0) {
    return;
  }
  const Layout layout = layout_for(width);
  const std::int32_t top = painter.height_px() - height;
  painter.fill({0, top, width - 1, painter.height_px() - 1}, palette::kBlack);
  // The right column holds the longer lines.
  const std::int32_t middle = width * 9 / 20;
  painter.fill({middle, top + layout.pad_px, middle, painter.height_px() - 1 - layout.pad_px},
               palette::kUnknown);
  draw_left(painter, {layout.pad_px, middle - 2 * layout.pad_px}, top, layout, sighting);
  draw_right(painter, {middle + 2 * layout.pad_px, width - 1 - layout.pad_px}, top, layout,
             sighting, field);
}

std::string_view state_words(TrackState state) {
  switch (state) {
    case TrackState::kTracking: return "TRACKING";
    case TrackState::kDegraded: return "DEGRADED";
    case TrackState::kLost: return "LOST";
    case TrackState::kWaiting: break;
  }
  return "WAITING";
}

}  // namespace tubesight::core::overlay
