#include "core/overlay/readout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/words.h"
#include "core/overlay/messages.h"
#include "core/overlay/palette.h"
#include "tests/core/overlay/canvas.h"

namespace tubesight::core::overlay {
namespace {

using tests::Canvas;

constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
constexpr Rgb kPaper{90, 91, 92};

// A readout's picture in one colour that no text has.
Canvas paper(std::int32_t width_px) {
  Canvas canvas(width_px, readout_height_px(width_px));
  for (std::int32_t v = 0; v < canvas.height(); ++v) {
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

OverlayInput showing(const Sighting& sighting, std::optional<std::int64_t> field = std::nullopt) {
  OverlayInput input;
  input.sighting = sighting;
  input.field = field;
  input.aligned_within_um_q8 = 2'500 * 256;
  return input;
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
  Canvas canvas = paper(635);
  Painter painter(canvas.view());

  draw_readout(painter, showing(tracking(), 184));

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

TEST(Readout, FillsItsWholePicture) {
  Canvas canvas = paper(635);
  Painter painter(canvas.view());

  draw_readout(painter, showing(tracking(), 184));

  EXPECT_TRUE(canvas.pixels_of(kPaper, canvas.height()).empty());
  EXPECT_TRUE(canvas.guards_intact());
}

TEST(Readout, TellsTheResidualOfAJudgedFieldAlone) {
  for (const bool judged : {true, false}) {
    Canvas canvas = paper(635);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.judged = judged;
    s.residual_px_q16 = 6'881;  // 0.105 px

    draw_readout(painter, showing(s));

    EXPECT_EQ(reads(canvas, "residual 0.10 px", 1, palette::kCaption), judged);
  }
}

// Pixels of the dial's arrow: blue, right of the words of the column.
std::vector<PixelPoint> arrow_of(const Canvas& canvas) {
  std::vector<PixelPoint> arrow;
  for (const PixelPoint& pixel : canvas.pixels_of(palette::kTool, canvas.height())) {
    if (pixel.u_px > canvas.width() - 52) {
      arrow.push_back(pixel);
    }
  }
  return arrow;
}

TEST(Readout, TheDialsArrowPointsAsThePictureShowsTheOffset) {
  // The dial's middle: its ring is symmetrical about it.
  for (const auto& [u, v] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {3, 2}, {-2, 3}}) {
    Canvas canvas = paper(635);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.aligned = false;
    s.offset_um_q8 = 2'400 * 256;
    s.tool_px = {300 * 65'536, 200 * 65'536};
    // A hundredth of a pixel shows the direction as well as ten.
    s.axis_px = {s.tool_px.u_q16 + u * 655, s.tool_px.v_q16 + v * 655};

    draw_readout(painter, showing(s));

    std::vector<PixelPoint> ring;
    for (const PixelPoint& pixel : canvas.pixels_of(palette::kStateDegraded, canvas.height())) {
      if (pixel.u_px > canvas.width() - 52) {
        ring.push_back(pixel);
      }
    }
    ASSERT_GT(ring.size(), 20U);
    const auto [left, right] = std::minmax_element(
        ring.begin(), ring.end(),
        [](const PixelPoint& a, const PixelPoint& b) { return a.u_px < b.u_px; });
    const double middle_u = (left->u_px + right->u_px) / 2.0;
    const double middle_v = (ring.front().v_px + ring.back().v_px) / 2.0;
    double farthest = 0.0;
    PixelPoint tip;
    const double length = std::hypot(u, v);
    for (const PixelPoint& pixel : arrow_of(canvas)) {
      const double along = ((pixel.u_px - middle_u) * u + (pixel.v_px - middle_v) * v) / length;
      if (along > farthest) {
        farthest = along;
        tip = pixel;
      }
    }
    // Nearly at the ring, whose radius is half of what lies between its sides.
    EXPECT_NEAR(farthest, (right->u_px - left->u_px) / 2.0 * 2.4 / 2.5, 2.5) << u << ", " << v;
    EXPECT_NEAR(tip.u_px - middle_u, farthest * u / length, 2.5) << u << ", " << v;
    EXPECT_NEAR(tip.v_px - middle_v, farthest * v / length, 2.5) << u << ", " << v;
  }
}

TEST(Readout, TheDialsArrowEndsAtItsEdgeHoweverLargeTheOffsetIs) {
  std::array<std::size_t, 2> pixels{};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    Canvas canvas = paper(635);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.aligned = false;
    s.offset_um_q8 = i == 0 ? 5'000 * 256 : std::numeric_limits<std::int32_t>::max();
    s.axis_px = {10 * 65'536, 0};

    draw_readout(painter, showing(s));

    pixels[i] = arrow_of(canvas).size();
    EXPECT_TRUE(canvas.guards_intact());
  }
  EXPECT_EQ(pixels[0], pixels[1]);
}

TEST(Readout, SaysNotAlignedInOtherWordsThanAligned) {
  Canvas canvas = paper(635);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.aligned = false;

  draw_readout(painter, showing(s, 184));

  EXPECT_TRUE(reads(canvas, "not aligned", 1, palette::kStateDegraded));
  EXPECT_EQ(size_of(canvas, "ALIGNED", palette::kBlack), 0);
}

TEST(Readout, ShowsDashesForWhatIsNotKnown) {
  Canvas canvas = paper(635);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.primary_known = false;
  s.tool_known = false;
  s.axis_known = false;

  draw_readout(painter, showing(s));

  EXPECT_TRUE(reads(canvas, "--", 3, palette::kUnknown));
  for (const Rgb colour : {palette::kRow, palette::kColumn, palette::kTool}) {
    EXPECT_TRUE(canvas.pixels_of(colour, canvas.height()).empty());
  }
  EXPECT_EQ(size_of(canvas, "ALIGNED", palette::kBlack), 0);
}

TEST(Readout, HeightAloneIsShownOverAVoid) {
  Canvas canvas = paper(635);
  Painter painter(canvas.view());
  Sighting s = tracking();
  s.tool_known = false;
  s.height_um_q8 = -26 * 2'560;  // -0.26 mm

  draw_readout(painter, showing(s));

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
    Canvas canvas = paper(635);
    Painter painter(canvas.view());
    Sighting s;
    s.state = c.state;
    s.reason = Reason::kDark;

    draw_readout(painter, showing(s));

    const auto at = canvas.find_text(c.words, 2, palette::kBlack);
    ASSERT_TRUE(at.has_value()) << c.words;
    EXPECT_EQ(canvas.at(at->u_px - 1, at->v_px - 1), c.colour) << c.words;
    EXPECT_TRUE(reads(canvas, "the picture shows no light: check lamp, cable", 2, c.colour))
        << c.words;
  }
}

// The first words of it: a reason may be broken into two lines.
TEST(Readout, EveryReasonIsTold) {
  for (const std::int32_t width : {320, 635, 1920}) {
    for (int code = 1; code < count_of<Reason>(); ++code) {
      Canvas canvas = paper(width);
      Painter painter(canvas.view());
      Sighting s;
      s.reason = static_cast<Reason>(code);
      s.state = s.reason >= Reason::kCoasted ? TrackState::kLost : TrackState::kDegraded;
      const std::string_view meaning = explain(s.reason);

      draw_readout(painter, showing(s));

      EXPECT_GE(size_of(canvas, meaning.substr(0, 20), colour_of(s.state)), 1)
          << meaning << ", " << width;
    }
  }
}

TEST(Readout, AContradictedClaimIsShownBesideTheReason) {
  for (const std::int32_t width : {320, 635, 1920}) {
    Canvas canvas = paper(width);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.state = TrackState::kDegraded;
    s.reason = Reason::kUncertain;
    OverlayInput input = showing(s);
    input.news.claim =
        ClaimReply{{140, -162}, ClaimVerdict::kContradicted, ClaimDoubt::kNone, {140, -161}, 7};

    draw_readout(painter, input);

    EXPECT_GE(size_of(canvas, "CONTRADICTED", palette::kBlack), 1) << width;
    EXPECT_GE(size_of(canvas,
                      width == 320 ? "claimed 140,-162, seen 140,-161"
                                   : "robot claims 140,-162, box sees 140,-161",
                      palette::kWhite),
              1)
        << width;
    EXPECT_GE(size_of(canvas, width == 320 ? "uncertain" : "the picture tells the tool's place",
                      palette::kStateDegraded),
              1)
        << width;
  }
}

TEST(Readout, EveryRefusalOfAStartIsTold) {
  for (int code = 1; code < count_of<StartRefusal>(); ++code) {
    Canvas canvas = paper(320);
    Painter painter(canvas.view());
    Sighting s;
    s.reason = Reason::kStartRefused;
    OverlayInput input = showing(s);
    input.news.refusal = static_cast<StartRefusal>(code);

    draw_readout(painter, input);

    EXPECT_TRUE(reads(canvas, "START REFUSED", 1, palette::kBlack)) << code;
    EXPECT_TRUE(reads(canvas, explain(input.news.refusal).substr(0, 20), 1, palette::kWhite))
        << code;
  }
}

// Smaller, or not at all: half an address would be a wrong address.
TEST(Readout, AddressesAreWholeAtAnyPictureSize) {
  for (const std::int32_t width : {320, 333, 400, 559, 560, 635, 768, 1119, 1280}) {
    for (const std::int32_t number : {0, 7, 120, -2000, kLow}) {
      Canvas canvas = paper(width);
      Painter painter(canvas.view());
      Sighting s = tracking();
      s.primary = {number, number};
      s.tool = {number, number};

      draw_readout(painter, showing(s, kLow));

      const std::string digits = std::to_string(number);
      const bool shown = size_of(canvas, digits, palette::kRow) > 0;
      EXPECT_EQ(shown, !canvas.pixels_of(palette::kRow, canvas.height()).empty())
          << width << ", " << number;
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
    Canvas canvas = paper(width);
    Painter painter(canvas.view());
    Sighting s = tracking();
    s.state = TrackState::kDegraded;
    s.reason = Reason::kJump;

    draw_readout(painter, showing(s, 1'234'567));

    const std::int32_t bottom = canvas.height() - 1;
    for (std::int32_t v = 0; v <= bottom; ++v) {
      for (const std::int32_t u : {0, 1, width - 2, width - 1}) {
        EXPECT_EQ(canvas.at(u, v), palette::kBlack) << width << ": " << u << ", " << v;
      }
    }
    for (std::int32_t u = 0; u < width; ++u) {
      for (const std::int32_t v : {0, 1, bottom - 1, bottom}) {
        EXPECT_EQ(canvas.at(u, v), palette::kBlack) << width << ": " << u << ", " << v;
      }
    }
  }
}

TEST(Readout, GrowsWithThePictureAndGivesWayInASmallOne) {
  EXPECT_EQ(readout_height_px(319), 0);
  EXPECT_GT(readout_height_px(320), 0);
  EXPECT_EQ(readout_height_px(1905), 3 * readout_height_px(635));
  for (std::int32_t width = 320; width < 4096; ++width) {
    ASSERT_EQ(readout_height_px(width) % 2, 0) << width;
    ASSERT_GE(readout_height_px(width + 1), readout_height_px(width));
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
