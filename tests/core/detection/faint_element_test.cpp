// What little light shows at one place of a sheet: drawn by hand, with noise, as a lamp that comes
// in flat leaves it.

#include "core/detection/faint_element.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/core/detection/drawn_light.h"

namespace tubesight::core::detection {
namespace {

constexpr double kHalfWidth_px = 20.0;
constexpr double kHalfHeight_px = 12.0;
constexpr double kCenterU_px = 60.3;
constexpr double kCenterV_px = 45.6;
constexpr double kSheet = 18.0;  // grey levels above the picture's darkest

/// A picture of a sheet with one place that `inside` colours: by x and y in radii from its middle.
struct DrawnPlace : DrawnLight {
  template <typename Inside>
  explicit DrawnPlace(Inside inside, double noise = 2.0)
      : DrawnLight(120, 90, noise, [&](double u, double v) {
          return inside((u - kCenterU_px) / kHalfWidth_px, (v - kCenterV_px) / kHalfHeight_px);
        }) {}
};

Ellipse expected(double off_px = 0.0) {
  Ellipse ellipse;
  ellipse.center_px << kCenterU_px + off_px, kCenterV_px;
  ellipse.shape_px2 << kHalfWidth_px * kHalfWidth_px, 0.0, 0.0, kHalfHeight_px * kHalfHeight_px;
  return ellipse;
}

/// A bore that a lamp fills from the left: its right end is as bright as the sheet.
double filled_bore(double x, double y) { return x * x + y * y < 1.0 ? 13.0 + 6.0 * x : kSheet; }

/// A flush plug: a thin dark ring, and a face a little darker than the sheet.
double flush_plug(double x, double y) {
  const double radius = std::hypot(x, y);
  return radius > 1.0 ? kSheet : radius > 0.96 ? 0.55 * kSheet : 15.5;
}

/// A plug rolled in, seen from the side: its bright face and dark hole stand to the left of the
/// dark gap around it.
double rolled_plug(double x, double y) {
  if (std::hypot(x + 0.4, y) < 0.55) {
    return 1.0;
  }
  if (std::hypot(x + 0.4, y) < 0.9) {
    return 26.0;
  }
  return std::hypot(x, y) < 1.0 ? 3.0 : kSheet;
}

double bare_sheet(double x, double /*y*/) { return kSheet + 2.0 * x; }

TEST(FaintElement, ABoreFilledWithLightIsOpen) {
  const FaintLook look = look_at_faint(DrawnPlace(filled_bore).view(), expected());

  EXPECT_TRUE(is_open(look));
  EXPECT_FALSE(is_none(look));
  EXPECT_EQ(look.seen, 1.0);
  EXPECT_NEAR(look.light, kSheet, 1.0);
  // The inside at its dark end: 13 - 6 * 0.75 of 18.
  EXPECT_NEAR(look.dark, 8.5 / 18.0, 0.06);
  // A slope of 6 grey levels a radius, over some 10 at that end.
  EXPECT_NEAR(look.slope, 0.6, 0.15);
}

TEST(FaintElement, ABoreDarkAllOverIsOpen) {
  const auto dark = [](double x, double y) { return x * x + y * y < 1.0 ? 7.0 : kSheet; };

  EXPECT_TRUE(is_open(look_at_faint(DrawnPlace(dark).view(), expected())));
}

TEST(FaintElement, TwoPixelsBesideItIsOpenYet) {
  const DrawnPlace place(filled_bore);

  EXPECT_TRUE(is_open(look_at_faint(place.view(), expected(2.0))));
  EXPECT_TRUE(is_open(look_at_faint(place.view(), expected(-2.0))));
}

TEST(FaintElement, AFlushPlugIsNotOpen) {
  EXPECT_FALSE(is_open(look_at_faint(DrawnPlace(flush_plug).view(), expected())));
}

TEST(FaintElement, APlugWithTheBoresMeanIsNotOpen) {
  const auto plug = [](double x, double y) { return x * x + y * y < 1.0 ? 13.0 : kSheet; };
  const FaintLook look = look_at_faint(DrawnPlace(plug).view(), expected());

  EXPECT_GT(look.contrast, 3.0);  // seen, and by far
  EXPECT_FALSE(is_open(look));
}

TEST(FaintElement, APlugDarkerThanTheSheetIsNotOpenInGoodLight) {
  const auto plug = [](double x, double y) {
    return x * x + y * y < 1.0 ? 150.0 + 30.0 * x : 180.0;
  };
  const auto dim = [&](double x, double y) { return 0.1 * plug(x, y); };

  EXPECT_FALSE(is_open(look_at_faint(DrawnPlace(plug).view(), expected())));
  // Of the same form in little light it may be a bore.
  EXPECT_TRUE(is_open(look_at_faint(DrawnPlace(dim, 0.3).view(), expected())));
}

TEST(FaintElement, ARolledPlugIsNone) {
  const FaintLook look = look_at_faint(DrawnPlace(rolled_plug).view(), expected());

  EXPECT_FALSE(is_open(look));
  EXPECT_GT(look.uneven, 0.5);
}

TEST(FaintElement, BareSheetIsNone) {
  const FaintLook look = look_at_faint(DrawnPlace(bare_sheet).view(), expected());

  EXPECT_FALSE(is_open(look));
}

TEST(FaintElement, BehindAGuidetubeIsNeither) {
  for (const auto drawn : {filled_bore, flush_plug}) {
    DrawnPlace place(drawn);
    place.cover(0, 0, 62, 90, 1.0);
    const FaintLook look = look_at_faint(place.view(), expected());

    EXPECT_FALSE(is_open(look));
    EXPECT_FALSE(is_none(look));
  }
}

TEST(FaintElement, AGuidetubeThatHidesAllOfTheInsideIsNotOpen) {
  for (const auto drawn : {filled_bore, flush_plug}) {
    DrawnPlace place(drawn);
    // Its end a little beyond the outline on the right, which shows a rise there alone.
    place.cover(0, 0, 78, 90, 3.0);

    EXPECT_FALSE(is_open(look_at_faint(place.view(), expected())));
  }
}

TEST(FaintElement, WhatThePictureCutsOffIsNotOpen) {
  const DrawnPlace place(filled_bore);
  Ellipse beyond = expected();
  beyond.center_px << 3.0, 45.6;
  const FaintLook look = look_at_faint(place.view(), beyond);

  EXPECT_LT(look.seen, 0.75);
  EXPECT_FALSE(is_open(look));
  beyond.center_px << -80.0, 45.6;
  EXPECT_EQ(look_at_faint(place.view(), beyond).seen, 0.0);
}

TEST(FaintElement, NoiseAloneIsNotOpen) {
  const auto even = [](double, double) { return 3.0; };

  EXPECT_FALSE(is_open(look_at_faint(DrawnPlace(even).view(), expected())));
}

TEST(FaintElement, MovesToTheOutlineFromAFewPixelsOff) {
  const DrawnPlace place(filled_bore, 0.5);

  const Ellipse moved = move_to_contrast(place.view(), expected(4.0));

  EXPECT_LT((moved.center_px - expected().center_px).norm(), 2.0);
  EXPECT_EQ(moved.shape_px2, expected().shape_px2);
}

}  // namespace
}  // namespace tubesight::core::detection
