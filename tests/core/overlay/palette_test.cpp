#include "core/overlay/palette.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace tubesight::core::overlay {
namespace {

using Linear = std::array<double, 3>;

double linear(std::uint8_t value) {
  const double share = value / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

// What is left of a colour for eyes without one kind of cone: the plane that red and green are
// projected to, by Vienot, Brettel and Mollon, "Digital video colourmaps for checking the
// legibility of displays by dichromats" (1999), in linear RGB: both channels become one.
Linear seen_by(const Rgb& colour, double red_share) {
  const double red = linear(colour.red);
  const double green = linear(colour.green);
  const double mixed = red_share * red + (1.0 - red_share) * green;
  return {mixed, mixed, linear(colour.blue)};
}

// Difference of lightness and of the one hue that is left, by the cube root, which is about how
// differences are seen; black to white is 100 in lightness.
double difference(const Linear& a, const Linear& b) {
  const auto lightness = [](const Linear& c) {
    return 100.0 * std::cbrt(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
  };
  const auto hue = [](const Linear& c) { return 100.0 * (std::cbrt(c[0]) - std::cbrt(c[2])); };
  return std::hypot(lightness(a) - lightness(b), hue(a) - hue(b));
}

// Shares of red for eyes without the cones for long and for middle waves.
constexpr std::array<double, 2> kDichromats{0.11238, 0.29275};

// Those that meet in one place of the picture or stand for each other in the readout. A just
// noticeable difference is about 2.
TEST(Palette, MarksThatMeetDifferForColourBlindEyes) {
  using namespace palette;
  struct Pair {
    const char* what;
    Rgb one;
    Rgb other;
  };
  for (const double red_share : kDichromats) {
    for (const Pair& pair :
         {Pair{"row and column", kRow, kColumn}, Pair{"row and tool", kRow, kTool},
          Pair{"column and tool", kColumn, kTool}, Pair{"axis and tool", kAxis, kTool},
          Pair{"used and rejected", kUsed, kRejected}, Pair{"used and plug", kUsed, kPlug},
          Pair{"rejected and plug", kRejected, kPlug},
          Pair{"click taken and refused", kClick, kClickRefused},
          Pair{"claim and tool", kClaim, kTool}, Pair{"claim and column", kClaim, kColumn},
          Pair{"tracking and lost", kStateTracking, kStateLost},
          Pair{"degraded and lost", kStateDegraded, kStateLost},
          Pair{"tracking and waiting", kStateTracking, kStateWaiting}}) {
      EXPECT_GT(difference(seen_by(pair.one, red_share), seen_by(pair.other, red_share)), 10.0)
          << pair.what << ", " << red_share;
    }
  }
}

TEST(Palette, LettersAreReadableOnBlack) {
  using namespace palette;
  for (const Rgb& colour :
       {kCaption, kRow, kColumn, kTool, kStateTracking, kStateDegraded, kStateLost, kStateWaiting,
        kClick, kClickRefused, kEstimateOpen, kEstimatePlugged}) {
    const double luminance =
        0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
    // The contrast that WCAG 2.1 asks of text, 4.5 to 1.
    EXPECT_GT((luminance + 0.05) / 0.05, 4.5)
        << int{colour.red} << ", " << int{colour.green} << ", " << int{colour.blue};
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
