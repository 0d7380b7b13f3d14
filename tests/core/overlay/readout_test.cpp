#include "core/overlay/readout.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/base/words.h"
#include "core/overlay/palette.h"
#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;

constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
constexpr Rgb kPaper{90, 91, 92};

// A picture in one colour that no text has.
Canvas paper(std::int32_t width_px, std::int32_t height_px) {
  Canvas canvas(width_px, height_px);
  for (std::int32_t v = 0; v < height_px; ++v) {
    for (std::int32_t u = 0; u < width_px; ++u) {
      canvas.set(u, v, kPaper);
    }
  }
  return canvas;
}

Sighting tracking() {
  Sighting s;
  s.time = FieldTime(3'066'666'500);
  s.state = TrackState::kTracking;
  s.reason = Reason::kNone;
  s.tracked = 24;
  s.primary_known = true;
  s.primary = {41, 60};
  s.axis_known = true;
  s.height_um_q8 = 60'049 * 256;  // 60.049 mm
  s.tool_known = true;
  s.tool = {43, -5};
  s.offset_um_q8 = 555 * 256;  // 0.555 mm
  s.aligned = true;
  return s;
}

bool reads(const Canvas& canvas, std::string_view words, std::int32_t scale, Rgb colour) {
  return canvas.find_text(words, scale, colour).has_value();
}

// The size at which words stand, or 0.
std::int32_t size_of(const Canvas& canvas, std::string_view words, Rgb colour) {
  for (std::int32_t scale = 6; scale >= 1; --scale) {
    if (reads(canvas, words, scale, colour)) {
      return scale;
    }
  }
  return 0;
}

TEST(Readout, TellsEverythingInItsColours) {
  Canvas canvas = paper(635, 480);
  Painter painter(canvas.view());

  draw_readout(painter, tracking(), 184);

  EXPECT_TRUE(reads(canvas, "ROW", 2, palette::kRow));
  EXPECT_TRUE(reads(canvas, "41", 3, palette::kRow));
  EXPECT_TRUE(reads(canvas, "COL", 2, palette::kColumn));
  EXPECT_TRUE(reads(canvas, "60", 3, palette::kColumn));
  EXPECT_TRUE(reads(canvas, "43", 3, palette::kTool));
  EXPECT_TRUE(reads(canvas, "-5", 3, palette::kTool));
  EXPECT_TRUE(reads(canvas, "ALIGNED", 2, palette::kBlack));
  EXPECT_TRUE(reads(canvas, "TRACKING", 2, palette::kBlack));
  EXPECT_TRUE(reads(canvas, "24 tracked", 1, palette::kCaption));
  EXPECT_TRUE(reads(canvas, "offset 0.56  height 60.0 mm", 2, palette::kTool));
  EXPECT_TRUE(reads(canvas, "field 184  3.067 s", 1, palette::kCaption));
}

TEST(Readout, BlackBoxLiesAtTheVeryBottomAndLeavesTheRestAlone) {
  Canvas canvas = paper(635, 480);
  Painter painter(canvas.view());

  draw_readout(painter, tracking(), 184);

  const std::int32_t top = 480 - readout_height_px(635, 480);
  EXPECT_EQ(canvas.pixels_of(kPaper, 480).size(), static_cast<std::size_t>(635 * top));
  EXPECT_EQ(canvas.pixels_of(kPaper, top).size(), static_cast<std::size_t>(635 * top));
  // The guidetube's dark region: below the window of every recording, which ends at line 330.
  EXPECT_GE(top, 400);
}

TEST(Readout, SaysNotAlignedInOtherWordsThanAligned) {
  Canvas canvas = paper(635, 480);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.aligned = false;

  draw_readout(painter, s, 184);

  EXPECT_TRUE(reads(canvas, "not aligned", 1, palette::kStateDegraded));
  EXPECT_EQ(size_of(canvas, "ALIGNED", palette::kBlack), 0);
}

TEST(Readout, ShowsDashesForWhatIsNotKnown) {
  Canvas canvas = paper(635, 480);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.primary_known = false;
  s.tool_known = false;
  s.axis_known = false;

  draw_readout(painter, s, std::nullopt);

  EXPECT_TRUE(reads(canvas, "--", 3, palette::kUnknown));
  for (const Rgb colour : {palette::kRow, palette::kColumn, palette::kTool}) {
    EXPECT_TRUE(canvas.pixels_of(colour, 480).empty());
  }
  EXPECT_EQ(size_of(canvas, "ALIGNED", palette::kBlack), 0);
}

TEST(Readout, HeightAloneIsShownOverAVoid) {
  Canvas canvas = paper(635, 480);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.tool_known = false;
  s.height_um_q8 = -26 * 2'560;  // -0.26 mm

  draw_readout(painter, s, std::nullopt);

  EXPECT_TRUE(reads(canvas, "height -0.3 mm", 2, palette::kTool));
  EXPECT_FALSE(reads(canvas, "offset", 2, palette::kTool));
}

TEST(Readout, StateHasItsColour) {
  struct Case {
    TrackState state;
    const char* words;
    Rgb colour;
  };
  for (const Case& c : {Case{TrackState::kTracking, "TRACKING", palette::kStateTracking},
                        Case{TrackState::kDegraded, "DEGRADED", palette::kStateDegraded},
                        Case{TrackState::kLost, "LOST", palette::kStateLost},
                        Case{TrackState::kWaiting, "WAITING", palette::kStateWaiting}}) {
    Canvas canvas = paper(635, 480);
    Painter painter(canvas.view());
    Sighting s;
    s.state = c.state;
    s.reason = Reason::kDark;

    draw_readout(painter, s, std::nullopt);

    const auto at = canvas.find_text(c.words, 2, palette::kBlack);
    ASSERT_TRUE(at.has_value()) << c.words;
    EXPECT_EQ(canvas.at(at->u_px - 1, at->v_px - 1), c.colour) << c.words;
    EXPECT_TRUE(reads(canvas, "too dark", 2, c.colour)) << c.words;
  }
}

TEST(Readout, EveryReasonFitsWholeBesideItsState) {
  for (int code = 0; code < count_of<Reason>(); ++code) {
    Canvas canvas = paper(635, 480);
    Painter painter(canvas.view());
    Sighting s;
    s.reason = static_cast<Reason>(code);
    s.state = s.reason >= Reason::kCoasted ? TrackState::kLost : TrackState::kDegraded;
    const Rgb colour = s.state == TrackState::kLost ? palette::kStateLost : palette::kStateDegraded;
    EXPECT_EQ(words_of(s.reason).mark.empty(), s.reason == Reason::kNone);

    draw_readout(painter, s, std::nullopt);

    EXPECT_TRUE(reads(canvas, words_of(s.reason).mark, 2, colour)) << code;
  }
}

// Smaller, or not at all: half an address would be a wrong address.
TEST(Readout, AddressesAreWholeAtAnyPictureSize) {
  for (const std::int32_t width : {320, 333, 400, 559, 560, 635, 768, 1119, 1280}) {
    for (const std::int32_t number : {0, 7, 120, -2000, kLow}) {
      Canvas canvas = paper(width, 400);
      Painter painter(canvas.view());
      Sighting s = tracking();
      s.primary = {number, number};
      s.tool = {number, number};

      draw_readout(painter, s, kLow);

      const std::string digits = std::to_string(number);
      const bool shown = size_of(canvas, digits, palette::kRow) > 0;
      EXPECT_EQ(shown, !canvas.pixels_of(palette::kRow, 400).empty()) << width << ", " << number;
      EXPECT_EQ(shown, size_of(canvas, digits, palette::kColumn) > 0) << width << ", " << number;
      // What plants use fits every picture; only the absurd may be left out.
      EXPECT_TRUE(shown || number == kLow) << width << ", " << number;
      EXPECT_TRUE(size_of(canvas, digits, palette::kTool) > 0 || number == kLow)
          << width << ", " << number;
      EXPECT_TRUE(canvas.guards_intact());
    }
  }
}

TEST(Readout, NoTextTouchesThePicturesEdges) {
  for (const std::int32_t width : {320, 635, 640, 768, 1120, 1920}) {
    Canvas canvas = paper(width, 720);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.state = TrackState::kDegraded;
    s.reason = Reason::kJump;

    draw_readout(painter, s, 1'234'567);

    const std::int32_t top = 720 - readout_height_px(width, 720);
    for (std::int32_t v = top; v < 720; ++v) {
      for (const std::int32_t u : {0, 1, width - 2, width - 1}) {
        EXPECT_EQ(canvas.at(u, v), palette::kBlack) << width << ": " << u << ", " << v;
      }
    }
    for (std::int32_t u = 0; u < width; ++u) {
      for (const std::int32_t v : {top, top + 1, 718, 719}) {
        EXPECT_EQ(canvas.at(u, v), palette::kBlack) << width << ": " << u << ", " << v;
      }
    }
  }
}

TEST(Readout, GrowsWithThePictureAndGivesWayInASmallOne) {
  EXPECT_EQ(readout_height_px(319, 480), 0);
  EXPECT_GT(readout_height_px(320, 480), 0);
  EXPECT_GT(readout_height_px(1280, 960), readout_height_px(635, 480));
  EXPECT_EQ(readout_height_px(635, 100), 0);
  Canvas canvas = paper(200, 480);
  Painter painter(canvas.view());

  draw_readout(painter, tracking(), 1);

  EXPECT_EQ(canvas.pixels_of(kPaper, 480).size(), 200U * 480U);
}

}  // namespace
}  // namespace tubesight::core::overlay
