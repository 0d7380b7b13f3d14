#include "core/overlay/readout.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/base/assert.h"
#include "core/overlay/dial.h"
#include "core/overlay/font.h"
#include "core/overlay/messages.h"
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
  std::array<std::int32_t, 2> message_bottoms{};
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
  constexpr std::int32_t kStated_px = 635;
  const std::int32_t width = std::min(width_px, 32 * kStated_px);
  Layout layout;
  layout.caption_scale = std::clamp(width / kStated_px, 1, kLargestTextScale / 3);
  layout.text_scale = std::clamp(2 * width / kStated_px, 1, 2 * kLargestTextScale / 3);
  layout.number_scale = std::clamp(3 * width / kStated_px, 2, kLargestTextScale);
  layout.pad_px = 4 * layout.caption_scale;
  // A chip reaches one text dot and a half beyond its letters; tails reach two below the baseline.
  const std::int32_t tails = 2 * layout.text_scale;
  const std::int32_t text = kCapitalHeight * layout.text_scale + tails;
  layout.caption_bottom = layout.pad_px + kCapitalHeight * layout.caption_scale;
  layout.number_bottom =
      layout.caption_bottom + layout.pad_px + kCapitalHeight * layout.number_scale;
  layout.text_bottom = layout.number_bottom + layout.pad_px + text;
  layout.message_bottoms[0] = layout.text_bottom + tails + 2 * layout.pad_px + text;
  layout.message_bottoms[1] = layout.message_bottoms[0] + tails + layout.pad_px / 2 + text;
  layout.height_px = (layout.message_bottoms[1] + tails + layout.pad_px + 1) / 2 * 2;
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

// The first of some ways to say it that fits, at the column's right end.
void put_right_first(Painter& painter, Column& column, std::int32_t bottom,
                     std::initializer_list<std::string_view> ways, std::int32_t scale, Rgb colour) {
  for (const std::string_view words : ways) {
    if (put_right(painter, column, bottom, words, scale, colour)) {
      return;
    }
  }
}

void draw_left(Painter& painter, Column full, const Layout& layout, const Sighting& sighting) {
  Column line = full;
  put(painter, line, layout.caption_bottom, "PRIMARY TUBE", layout.caption_scale,
      palette::kCaption);
  TextLine number;
  number.integer(sighting.tracked);
  TextLine tracked = number;
  tracked.words(" tracked");
  put_right_first(painter, line, layout.caption_bottom, {tracked.view(), number.view()},
                  layout.caption_scale, palette::kCaption);

  line = full;
  const auto address =
      sighting.primary_known ? std::optional(sighting.primary) : std::optional<TubeAddress>();
  put_address(painter, line, layout.number_bottom, layout, address, palette::kRow,
              palette::kColumn);

  line = full;
  put_chip(painter, line, layout.text_bottom, state_words(sighting.state), layout.text_scale,
           colour_of(sighting.state));
  if (sighting.judged) {
    TextLine residual;
    residual.decimal(nearest_quotient(std::int64_t{sighting.residual_px_q16} * 100, 65'536), 2);
    residual.words(" px");
    TextLine named;
    named.words("residual ").words(residual.view());
    put_right_first(painter, line, layout.text_bottom, {named.view(), residual.view()},
                    layout.caption_scale, palette::kCaption);
  }
}

void draw_distances(Painter& painter, Column full, const Layout& layout, const Sighting& sighting) {
  // 1/256 um to 1/100 mm and 1/10 mm.
  TextLine offset;
  offset.decimal(nearest_quotient(sighting.offset_um_q8, 2'560), 2);
  TextLine height;
  height.decimal(nearest_quotient(sighting.height_um_q8, 25'600), 1).words(" mm");
  const auto distances = [&](std::string_view offset_words, std::string_view height_words) {
    TextLine both;
    if (sighting.tool_known) {
      both.words(offset_words).words(offset.view()).words(sighting.axis_known ? "  " : " mm");
    }
    if (sighting.axis_known) {
      both.words(height_words).words(height.view());
    }
    return both;
  };
  const TextLine whole = distances("offset ", "height ");
  const TextLine brief = distances("off ", "high ");
  for (std::int32_t scale = layout.text_scale; scale >= 1; --scale) {
    Column line = full;
    if (put(painter, line, layout.text_bottom, whole.view(), scale, palette::kTool) ||
        put(painter, line, layout.text_bottom, brief.view(), scale, palette::kTool)) {
      break;
    }
  }
}

void draw_right(Painter& painter, Column full, const Layout& layout, const OverlayInput& input) {
  const Sighting& sighting = input.sighting;
  Column line = full;
  put(painter, line, layout.caption_bottom, "TUBE ABOVE GUIDETUBE", layout.caption_scale,
      palette::kCaption);
  TextLine when;
  when.decimal(nearest_quotient(sighting.time.count(), 1'000'000), 3).words(" s");
  TextLine numbered;
  if (input.field) {
    numbered.words("field ").integer(*input.field).words("  ").words(when.view());
    put_right_first(painter, line, layout.caption_bottom, {numbered.view(), when.view()},
                    layout.caption_scale, palette::kCaption);
  }

  const std::int32_t dial_top = layout.caption_bottom + layout.pad_px;
  const std::int32_t dial_bottom = layout.text_bottom + 2 * layout.text_scale;
  const std::int32_t radius = (dial_bottom - dial_top) / 2;
  draw_dial(painter, {full.right - radius, dial_top + radius}, radius, layout.caption_scale, input);
  full.right -= 2 * radius + layout.pad_px;

  // Room for the widest verdict is kept free first: the numbers may shrink, the verdict never does.
  constexpr std::string_view kAligned = "ALIGNED";
  line = full;
  const std::int32_t verdict_px = chip_width_px(kAligned, layout.text_scale);
  Column verdict{std::max(full.left, full.right - verdict_px + 1), full.right};
  line.right = verdict.left - kCellWidth * layout.caption_scale;
  const auto address =
      sighting.tool_known ? std::optional(sighting.tool) : std::optional<TubeAddress>();
  put_address(painter, line, layout.number_bottom, layout, address, palette::kTool, palette::kTool);
  // The box vouches for a tube that it knows, never for none.
  if (sighting.tool_known && sighting.aligned) {
    put_chip(painter, verdict, layout.number_bottom, kAligned, layout.text_scale,
             palette::kStateTracking);
  } else if (sighting.tool_known) {
    put_right(painter, verdict, layout.number_bottom, "not aligned", layout.caption_scale,
              palette::kStateDegraded);
  }
  draw_distances(painter, full, layout, sighting);
}

// Words broken at spaces into lines, the first of which may be shorter.
struct Lines {
  std::array<std::string_view, 2> words{};
  bool fits = false;
};

Lines broken(std::string_view text, std::int32_t first_px, std::int32_t other_px,
             std::size_t most_lines, std::int32_t scale) {
  Lines lines;
  std::int32_t room_px = first_px;
  for (std::size_t i = 0; i < most_lines; ++i) {
    std::size_t end = text.size();
    while (end != std::string_view::npos && end > 0 &&
           text_width_px(text.substr(0, end), scale) > room_px) {
      end = text.rfind(' ', end - 1);
    }
    if (end == std::string_view::npos || end == 0) {
      return lines;
    }
    lines.words[i] = text.substr(0, end);
    if (end == text.size()) {
      lines.fits = true;
      return lines;
    }
    text.remove_prefix(end + 1);
    room_px = other_px;
  }
  return lines;
}

// As large as it fits into the lines that stand on `bottoms`; in short where it does not.
void draw_message(Painter& painter, Column full, std::span<const std::int32_t> bottoms,
                  const Layout& layout, const Message& message) {
  for (const std::string_view text : {message.words.view(), message.in_short.view()}) {
    for (std::int32_t scale = layout.text_scale; scale >= 1; --scale) {
      Column line = full;
      const std::int32_t chip_px =
          message.headline.empty() ? 0
                                   : chip_width_px(message.headline, scale) + kCellWidth * scale;
      const Lines lines =
          broken(text, full.room_px() - chip_px, full.room_px(), bottoms.size(), scale);
      // The headline is said in any case.
      if (!lines.fits && (scale > 1 || !text.empty())) {
        continue;
      }
      if (!message.headline.empty()) {
        put_chip(painter, line, bottoms[0], message.headline, scale, message.colour);
      }
      for (std::size_t i = 0; i < bottoms.size(); ++i) {
        put(painter, line, bottoms[i], lines.words[i], scale,
            message.headline.empty() ? message.colour : palette::kWhite);
        line = full;
      }
      return;
    }
  }
}

void draw_messages(Painter& painter, Column full, const Layout& layout, const OverlayInput& input) {
  const Messages messages(input);
  const std::span<const Message> all = messages.all();
  const std::span<const std::int32_t> bottoms(layout.message_bottoms);
  if (all.size() == 1) {
    draw_message(painter, full, bottoms, layout, all[0]);
  } else if (all.size() == 2) {
    draw_message(painter, full, bottoms.first(1), layout, all[0]);
    draw_message(painter, full, bottoms.last(1), layout, all[1]);
  }
}

}  // namespace

std::int32_t readout_height_px(std::int32_t width_px) {
  return width_px >= kSmallestWidth_px ? layout_for(width_px).height_px : 0;
}

void draw_readout(Painter& painter, const OverlayInput& input) {
  const std::int32_t width = painter.width_px();
  const Layout layout = layout_for(width);
  TUBESIGHT_ASSERT(painter.height_px() == readout_height_px(width));
  painter.fill({0, 0, width - 1, painter.height_px() - 1}, palette::kBlack);
  // The right column holds the longer lines.
  const std::int32_t middle = width * 3 / 8;
  const std::int32_t numbers_end = layout.text_bottom + 2 * layout.text_scale;
  painter.fill({middle, layout.pad_px, middle + layout.caption_scale - 1, numbers_end - 1},
               palette::kUnknown);
  draw_left(painter, {layout.pad_px, middle - 2 * layout.pad_px}, layout, input.sighting);
  const Column right{middle + 2 * layout.pad_px, width - 1 - layout.pad_px};
  draw_right(painter, right, layout, input);
  draw_messages(painter, {layout.pad_px, width - 1 - layout.pad_px}, layout, input);
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
