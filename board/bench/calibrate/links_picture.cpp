#include "board/bench/calibrate/links_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "board/bench/calibrate/plan_picture.h"
#include "core/overlay/font.h"
#include "core/overlay/palette.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::LinkCalibration;
using core::calibration::LinkMiss;
using core::calibration::LinkMisses;
using core::overlay::Painter;
using core::overlay::PixelPoint;
namespace palette = core::overlay::palette;

constexpr std::int32_t kMargin_px = 8;
constexpr std::int32_t kLine_px = 14;
constexpr std::int32_t kNames_px = 60;    // the column of the links' names
constexpr std::int32_t kColumn_px = 130;  // of one number's bars; four fit the narrowest plan
constexpr std::int32_t kRow_px = 22;
constexpr std::int32_t kSigma_px = 20;  // of a bar, for one sigma of what was expected
constexpr double kMostSigmas = 3.0;     // three fit a column
// A number whose sigma fell to this share of what was expected is told by the pairs.
constexpr double kTold = 0.5;

/// One number: a band of what was expected, one sigma either way, the number found as a bar and one
/// sigma of it as a line over the bar's end. Bright where the pairs tell it, grey where not.
void draw_bar(Painter& painter, PixelPoint middle, double value, double sigma, double expected) {
  const auto at = [&](double number) {
    return middle.u_px + static_cast<std::int32_t>(std::lround(
                             kSigma_px * std::clamp(number / expected, -kMostSigmas, kMostSigmas)));
  };
  const bool told = sigma < kTold * expected;
  const std::int32_t half = kRow_px / 2 - 3;
  painter.outline({at(-expected), middle.v_px - half, at(expected), middle.v_px + half}, 1,
                  palette::kUnknown);
  painter.fill({std::min(middle.u_px, at(value)), middle.v_px - half + 3,
                std::max(middle.u_px, at(value)), middle.v_px + half - 3},
               told ? palette::kColumn : palette::kUnknown);
  painter.line({at(value - sigma), middle.v_px}, {at(value + sigma), middle.v_px}, 2,
               told ? palette::kWhite : palette::kCaption);
  painter.line({middle.u_px, middle.v_px - half}, {middle.u_px, middle.v_px + half}, 1,
               palette::kCaption);
}

/// A row of bars a link, and one of the tip.
class LinkBars {
 public:
  explicit LinkBars(const LinkCalibration& links) : links_(links) {}

  [[nodiscard]] std::int32_t height_px() const {
    return 3 * kLine_px + kRow_px * (joints() + 2) + kMargin_px;
  }

  void draw(Painter& painter, std::int32_t top_px) const {
    painter.text({kMargin_px, top_px},
                 "links less those on paper, frame: one sigma of what was expected", 1,
                 palette::kWhite);
    painter.text({kMargin_px, top_px + kLine_px},
                 "yellow: told by the pairs, grey: not, line: one sigma", 1, palette::kWhite);
    std::int32_t at = 0;
    std::int32_t line_px = top_px + 3 * kLine_px;
    draw_names(painter, line_px - kLine_px, {"a", "d", "twist", "zero"});
    for (std::int32_t i = 0; i < joints(); ++i) {
      std::string name;
      drivers::print(name, "link %d", i + 1);
      draw_row(painter, line_px, name, at, core::calibration::kLinkNumbers);
      at += core::calibration::kLinkNumbers;
      line_px += kRow_px;
    }
    draw_names(painter, line_px + kRow_px - kLine_px, {"x", "y", "z", ""});
    draw_row(painter, line_px + kRow_px, "tip", at, links_.count - at);
  }

 private:
  [[nodiscard]] std::int32_t joints() const {
    return links_.count / core::calibration::kLinkNumbers;
  }

  [[nodiscard]] static std::int32_t middle_of(std::int32_t column) {
    return kMargin_px + kNames_px + kColumn_px * column + kColumn_px / 2;
  }

  static void draw_names(Painter& painter, std::int32_t line_px,
                         const std::array<const char*, 4>& names) {
    std::int32_t column = 0;
    for (const char* const name : names) {
      painter.text({middle_of(column) - core::overlay::text_width_px(name, 1) / 2, line_px}, name,
                   1, palette::kCaption);
      ++column;
    }
  }

  void draw_row(Painter& painter, std::int32_t line_px, const std::string& name, std::int32_t from,
                std::int32_t count) const {
    painter.text({kMargin_px, line_px + (kRow_px - core::overlay::kCapitalHeight) / 2}, name, 1,
                 palette::kWhite);
    for (std::int32_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(from + i);
      draw_bar(painter, {middle_of(i), line_px + kRow_px / 2}, links_.values[at], links_.sigmas[at],
               links_.expected[at]);
    }
  }

  const LinkCalibration& links_;
};

}  // namespace

bool write_links_picture(const std::string& path, const NamedPairs& pairs,
                         const LinkCalibration& links, const LinkMisses& misses,
                         std::string& message) {
  PlanPicture picture;
  for (const LinkMiss& miss : misses) {
    picture.marks.push_back(
        {PlanMark::kPair, pairs.pairs[miss.pair].T_sheet_tool.translation_mm().head<2>(),
         miss.base_alone_mm.head<2>(), pairs.names[static_cast<std::size_t>(miss.pair)],
         miss.with_links_mm.head<2>()});
  }
  std::string alone;
  std::string with_links;
  drivers::print(alone, "white: misses by the base alone, %.2f mm RMS, 200 times as long",
                 links.base_alone_mm);
  drivers::print(with_links, "green: with the links, %.2f mm RMS", links.with_links_mm);
  picture.caption = {"half of the pairs foretells the other half", alone, with_links};
  const LinkBars bars(links);
  if (links.count > 0) {
    picture.foot = {bars.height_px(),
                    [&bars](Painter& painter, std::int32_t top_px) { bars.draw(painter, top_px); }};
  }
  return write_plan(path, picture, message);
}

}  // namespace tubesight::board
