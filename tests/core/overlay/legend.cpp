#include "tests/core/overlay/legend.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/overlay/dial.h"
#include "core/overlay/font.h"
#include "core/overlay/labels.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/marks.h"
#include "core/overlay/palette.h"
#include "core/overlay/still_marks.h"

namespace tubesight::tests {
namespace {

using core::ImagePoint;
using core::TubeSighting;
using core::TubeState;
using core::overlay::Click;
using core::overlay::ClickVerdict;
using core::overlay::Estimate;
using core::overlay::HalfSize;
using core::overlay::MarkScale;
using core::overlay::OverlayInput;
using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;
using core::overlay::RimMark;
namespace palette = core::overlay::palette;

constexpr std::int32_t kColumn_px = 640;
constexpr std::int32_t kCellHeight_px = 64;
constexpr std::int32_t kSampleWidth_px = 108;
constexpr std::int32_t kTitle_px = 28;
constexpr std::int32_t kTextScale = 2;
constexpr HalfSize kRim{22, 16};
constexpr MarkScale kScale(640);

ImagePoint point(PixelPoint at) { return {at.u_px * 65'536, at.v_px * 65'536}; }
PixelPoint moved(PixelPoint at, std::int32_t u, std::int32_t v) {
  return {at.u_px + u, at.v_px + v};
}

struct Entry {
  std::string_view meaning;
  void (*draw)(Painter&, PixelPoint);  ///< at the sample's middle
  bool on_tube = true;                 ///< over a tube-end, as a rule
};

template <ClickVerdict verdict>
void draw_pin(Painter& painter, PixelPoint at) {
  core::overlay::draw_click(painter, kScale, {point(moved(at, 0, 12)), {40, 61}, verdict});
}

template <TubeState state>
void draw_expected(Painter& painter, PixelPoint at) {
  const std::array<Estimate, 1> estimates{Estimate{{40, 61}, point(moved(at, 0, -6)), state}};
  core::overlay::draw_estimates(painter, kScale, estimates);
}

template <std::int32_t quality, bool plug>
void draw_measured(Painter& painter, PixelPoint at) {
  core::overlay::draw_tube(painter, kScale, TubeSighting{{40, 61}, point(at), quality, plug});
}

template <bool aligned>
void draw_offset_dial(Painter& painter, PixelPoint at) {
  painter.fill({at.u_px - 28, at.v_px - 28, at.u_px + 28, at.v_px + 28}, palette::kBlack);
  OverlayInput input;
  input.sighting.tool_known = input.sighting.axis_known = true;
  input.sighting.aligned = aligned;
  input.sighting.offset_um_q8 = (aligned ? 1'900 : 6'000) * 256;
  input.sighting.axis_px = {aligned ? -65'536 : 65'536, 32'768};
  input.aligned_within_um_q8 = 2'500 * 256;
  core::overlay::draw_dial(painter, at, 24, 1, input);
}

// An ellipse of stretches, coarse enough to need no sine.
template <RimMark finding>
void draw_rim(Painter& painter, PixelPoint at) {
  constexpr std::array<std::array<std::int32_t, 2>, 13> kCircle{{{100, 0},
                                                                 {87, 50},
                                                                 {50, 87},
                                                                 {0, 100},
                                                                 {-50, 87},
                                                                 {-87, 50},
                                                                 {-100, 0},
                                                                 {-87, -50},
                                                                 {-50, -87},
                                                                 {0, -100},
                                                                 {50, -87},
                                                                 {87, -50},
                                                                 {100, 0}}};
  PixelPoint before;
  for (std::size_t i = 0; i < kCircle.size(); ++i) {
    const PixelPoint here =
        moved(at, kCircle[i][0] * kRim.u_px / 100, kCircle[i][1] * kRim.v_px / 100);
    if (i > 0) {
      core::overlay::draw_rim_stretch(painter, kScale, before, here, finding);
    }
    before = here;
  }
  core::overlay::draw_rim_centre(painter, kScale, at, finding);
}

constexpr std::array<Entry, 19> kOfReplay{{
    {"tube-end measured and used", draw_measured<9000, false>},
    {"tube-end measured, not believed", draw_measured<0, false>},
    {"plug recognised", draw_measured<9000, true>},
    {"primary tube: next row R, next column C",
     [](Painter& painter, PixelPoint at) {
       const PixelPoint here = moved(at, -24, -18);
       core::overlay::draw_axes(painter, kScale, point(here), point(moved(here, 0, 48)),
                                point(moved(here, 70, 0)));
     },
     false},
    {"tube above the guidetube, not vouched for",
     [](Painter& painter, PixelPoint at) {
       core::overlay::draw_tool(painter, kScale, at, kRim, false);
     }},
    {"the same, aligned: the box vouches for it",
     [](Painter& painter, PixelPoint at) {
       core::overlay::draw_tool(painter, kScale, at, kRim, true);
     }},
    {"where the guidetube's axis meets the sheet",
     [](Painter& painter, PixelPoint at) { core::overlay::draw_axis_point(painter, kScale, at); }},
    {"offset: from the tube's centre to the axis",
     [](Painter& painter, PixelPoint at) {
       core::overlay::draw_offset(painter, kScale, point(at), point(moved(at, 36, 16)));
       core::overlay::draw_axis_point(painter, kScale, moved(at, 36, 16));
     }},
    {"dial: offset beyond the ring: not aligned", draw_offset_dial<false>, false},
    {"dial: offset within the ring: aligned", draw_offset_dial<true>, false},
    {"click whose start was taken", draw_pin<ClickVerdict::kTaken>},
    {"click whose start was refused", draw_pin<ClickVerdict::kRefused>},
    {"click that the start was refused for", draw_pin<ClickVerdict::kBlamed>},
    {"tube claimed by the robot: contradicted",
     [](Painter& painter, PixelPoint at) {
       core::overlay::draw_contradicted_claim(painter, kScale, at);
     }},
    {"search window",
     [](Painter& painter, PixelPoint at) {
       core::overlay::draw_search_window(painter, kScale,
                                         {at.u_px - 40, at.v_px - 20, at.u_px + 40, at.v_px + 20});
     },
     false},
    {"optimum point: where the light is best",
     [](Painter& painter, PixelPoint at) { core::overlay::draw_optimum(painter, kScale, at); },
     false},
    {"expected here: an open tube-end", draw_expected<TubeState::kOpen>},
    {"expected here: a listed plug", draw_expected<TubeState::kPlugged>},
    {"expected here: no tube", draw_expected<TubeState::kAbsent>, false},
}};

constexpr std::array<Entry, 9> kOfStills{{
    {"rim measured and used (look: by its edge)", draw_rim<RimMark::kUsed>},
    {"rim not believed (look: by its pixels)", draw_rim<RimMark::kRejected>},
    {"closed: nothing dark inside, a plug", draw_rim<RimMark::kClosed>, false},
    {"expected here, and not measured", draw_rim<RimMark::kNotMeasured>},
    {"points of the edge that was found",
     [](Painter& painter, PixelPoint at) {
       for (std::int32_t i = -3; i <= 3; ++i) {
         core::overlay::draw_edge_point(painter, kScale, moved(at, 6 * i, i * i - kRim.v_px));
       }
     }},
    {"a tube-end's address: row, column",
     [](Painter& painter, PixelPoint at) {
       const std::array<Estimate, 1> tubes{Estimate{{40, 61}, point(moved(at, 0, -10)), {}}};
       core::overlay::draw_addresses(painter, kScale, tubes);
     }},
    {"look: an element's centre",
     [](Painter& painter, PixelPoint at) {
       painter.cross_hair(at, 0, kScale.px(2), kScale.px(1), palette::kWhite);
     }},
    {"look: neighbours in a row",
     [](Painter& painter, PixelPoint at) {
       painter.line(moved(at, -40, 3), moved(at, 40, -3), kScale.px(1), palette::kRow);
     },
     false},
    {"look: neighbours in a column",
     [](Painter& painter, PixelPoint at) {
       painter.line(moved(at, -3, -24), moved(at, 3, 24), kScale.px(1), palette::kColumn);
     },
     false},
}};

void draw_sample(Painter& painter, PixelPoint corner, const Entry& entry) {
  constexpr Rgb kPlate{84, 84, 84};
  constexpr Rgb kBore{16, 16, 16};
  const PixelPoint middle = moved(corner, kSampleWidth_px / 2, kCellHeight_px / 2);
  painter.fill({corner.u_px + 4, corner.v_px + 2, corner.u_px + kSampleWidth_px - 4,
                corner.v_px + kCellHeight_px - 3},
               kPlate);
  for (std::int32_t v = -kRim.v_px; entry.on_tube && v <= kRim.v_px; ++v) {
    for (std::int32_t u = -kRim.u_px; u <= kRim.u_px; ++u) {
      if (u * u * kRim.v_px * kRim.v_px + v * v * kRim.u_px * kRim.u_px <=
          kRim.u_px * kRim.u_px * kRim.v_px * kRim.v_px) {
        painter.pixel(moved(middle, u, v), kBore);
      }
    }
  }
  entry.draw(painter, middle);
  painter.text(moved(corner, kSampleWidth_px + 8,
                     (kCellHeight_px - core::overlay::kCapitalHeight * kTextScale) / 2),
               entry.meaning, kTextScale, palette::kWhite);
}

// Returns the line below the last sample.
std::int32_t draw_section(Painter& painter, std::int32_t top, std::string_view title,
                          std::span<const Entry> entries) {
  painter.text({6, top + 8}, title, kTextScale, palette::kColumn);
  top += kTitle_px;
  // Down the left column first.
  const std::size_t rows = (entries.size() + 1) / 2;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    draw_sample(painter,
                {static_cast<std::int32_t>(i / rows) * kColumn_px,
                 top + static_cast<std::int32_t>(i % rows) * kCellHeight_px},
                entries[i]);
  }
  return top + static_cast<std::int32_t>(rows) * kCellHeight_px;
}

constexpr std::int32_t rows_of(std::size_t entries) {
  return static_cast<std::int32_t>((entries + 1) / 2);
}

}  // namespace

Picture draw_legend() {
  constexpr std::int32_t kWidth = 2 * kColumn_px;
  constexpr std::int32_t kHeight =
      2 * kTitle_px + (rows_of(kOfReplay.size()) + rows_of(kOfStills.size())) * kCellHeight_px;
  Picture picture{kWidth, kHeight, std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight)};
  Painter painter({picture.bytes.data(), kWidth, kHeight, 3 * kWidth});
  const std::int32_t next = draw_section(painter, 0, "tubesight replay --overlay", kOfReplay);
  draw_section(painter, next, "tubesight pose --overlay, tubesight look --overlay", kOfStills);
  return picture;
}

}  // namespace tubesight::tests
