// A place of a sheet beside four tube-ends in a row: drawn by hand, with noise, each as one of the
// kinds that a sheet shows.

#include "core/detection/portrait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/detection/verdict.h"
#include "tests/core/detection/drawn_light.h"

namespace tubesight::core::detection {
namespace {

constexpr double kHalfWidth_px = 20.0;
constexpr double kHalfHeight_px = 12.0;
constexpr double kSheet = 18.0;  // grey levels above the picture's darkest
constexpr std::array<double, 5> kPlacesU_px = {40.3, 110.3, 180.3, 250.3, 320.3};
constexpr double kPlacesV_px = 45.6;
constexpr std::size_t kDoubtful = 2;  // the one in the middle

/// Light by x and y in radii from a place's middle.
using Look = double (*)(double x, double y);

/// A bore with a bright rim, lit from the left, and its shadow on the right.
double bore(double x, double y) {
  const double radius = std::hypot(x, y);
  if (radius < 1.0) {
    return 7.0 + 5.0 * x;
  }
  return radius < 1.15 ? 26.0 : radius < 1.4 && x > 0.5 ? 11.0 : kSheet;
}

double bare_sheet(double x, double /*y*/) { return kSheet + 2.0 * x; }

/// A flush plug: a thin dark ring.
double flush_plug(double x, double y) {
  const double radius = std::hypot(x, y);
  return radius > 1.0 || radius < 0.95 ? kSheet : 0.6 * kSheet;
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

struct DrawnRow : DrawnLight {
  /// `light`: of the lamp on the place in the middle, the others' being 1.
  explicit DrawnRow(Look look, double light = 1.0, double noise = 0.5)
      : DrawnLight(360, 90, noise, [&](double u, double v) {
          const auto place =
              std::min<std::size_t>(4, static_cast<std::size_t>(std::lround(u) / 70));
          const double x = (u - kPlacesU_px[place]) / kHalfWidth_px;
          const double y = (v - kPlacesV_px) / kHalfHeight_px;
          return place == kDoubtful ? light * look(x, y) : bore(x, y);
        }) {}
};

Sitting sitting(std::size_t place, double off_px = 0.0) {
  Sitting sitting;
  sitting.center_px << kPlacesU_px[place] + off_px, kPlacesV_px;
  sitting.radius_px << kHalfWidth_px, 0.0, 0.0, kHalfHeight_px;
  return sitting;
}

/// The place in the middle by its neighbours.
struct Judged {
  explicit Judged(const DrawnRow& row, double off_px = 0.0) {
    const auto gallery = std::make_unique<PortraitGallery>();
    const std::array sitters = {sitting(0), sitting(1), sitting(3), sitting(4)};
    EXPECT_TRUE(gallery->hang(row.view(), sitters));
    whole = gallery->compare(row.view(), sitting(kDoubtful, off_px), 3.0);
    half = gallery->compare_halves(row.view(), sitting(kDoubtful, off_px));
    verdict = judge(whole, half, kHalfHeight_px, false);
  }
  Resemblance whole;
  HalfResemblance half;
  Verdict verdict = Verdict::kUnsure;
};

TEST(Portrait, ATubeEndLooksAsThoseAroundIt) {
  const Judged judged((DrawnRow(bore)));

  EXPECT_EQ(judged.verdict, Verdict::kAlike);
  EXPECT_GT(judged.whole.alike, 0.95);
  EXPECT_EQ(judged.whole.seen, 1.0);
  EXPECT_NEAR(judged.whole.depth, 1.0, 0.1);
  EXPECT_NEAR(judged.whole.evenness, 1.0, 0.1);
  EXPECT_LT(judged.whole.shift_px.norm(), 0.5);
}

TEST(Portrait, ATubeEndIsKnownAtAContrastOfHalfAPixelsNoise) {
  // A tenth of the light: the sheet over the bore's middle is 1.1 grey levels.
  const Judged judged(DrawnRow(bore, 0.1, 0.5), 1.0);

  EXPECT_EQ(judged.verdict, Verdict::kAlike);
  EXPECT_GT(judged.whole.without_noise, judged.whole.alike);
}

TEST(Portrait, ATubeEndIsFoundNearerToWhereItStands) {
  const Judged judged(DrawnRow(bore), 2.0);

  EXPECT_EQ(judged.verdict, Verdict::kAlike);
  // Not all the way: that it stands where it is expected counts, too.
  EXPECT_NEAR(judged.whole.shift_px.x(), -2.0, 1.01);
  EXPECT_NEAR(judged.whole.shift_px.y(), 0.0, 0.01);
}

TEST(Portrait, BareSheetIsNone) {
  EXPECT_EQ(Judged(DrawnRow(bare_sheet)).verdict, Verdict::kNone);
  EXPECT_EQ(Judged(DrawnRow(bare_sheet, 0.1, 2.0)).verdict, Verdict::kNone);
}

TEST(Portrait, PlugsAreNotAlike) {
  for (const double light : {1.0, 0.3}) {
    EXPECT_NE(Judged(DrawnRow(flush_plug, light)).verdict, Verdict::kAlike) << light;
    EXPECT_NE(Judged(DrawnRow(rolled_plug, light)).verdict, Verdict::kAlike) << light;
  }
}

TEST(Portrait, ATubeEndHalfBehindAGuidetubeIsHidden) {
  DrawnRow row(bore);
  row.cover(140, 0, 178, 90, 1.0);

  const Judged judged(row);

  EXPECT_EQ(judged.verdict, Verdict::kHidden);
  EXPECT_GT(judged.half.alike, 0.9);
}

TEST(Portrait, WhatElseIsHalfBehindAGuidetubeIsNoTubeEnd) {
  for (const Look look : {bare_sheet, flush_plug, rolled_plug}) {
    DrawnRow row(look);
    row.cover(140, 0, 178, 90, 1.0);
    const Judged judged(row);

    EXPECT_NE(judged.verdict, Verdict::kHidden);
    EXPECT_NE(judged.verdict, Verdict::kAlike);
  }
}

TEST(Portrait, ASpotWithoutAnEdgeHasToBeMoreThanAsDeepAsATubeEnd) {
  Resemblance whole;
  whole.seen = 1.0;
  whole.alike = 0.72;
  whole.without_noise = 0.72;
  whole.sigmas = 9.0;
  whole.depth = 0.9;
  whole.evenness = 0.4;
  const HalfResemblance half = {0.91, 1.6};

  EXPECT_EQ(judge(whole, half, 7.0, false), Verdict::kUnsure);
  EXPECT_EQ(judge(whole, half, 7.0, true), Verdict::kPlug);
}

TEST(Portrait, WithoutNeighboursThereIsNothingToCompareWith) {
  const DrawnRow row(bore);
  PortraitGallery gallery;

  EXPECT_FALSE(gallery.hang(row.view(), std::array{sitting(0)}));
  EXPECT_FALSE(gallery.hang(row.view(), std::array{sitting(0), sitting(1, -500.0)}));
}

TEST(Portrait, ASittingShowsTheEllipseTurnedAsItsNeighbours) {
  Ellipse ellipse;
  ellipse.center_px << 12.0, 34.0;
  ellipse.shape_px2 << 90.0, 25.0, 25.0, 60.0;
  for (const double side : {1.0, -1.0}) {
    Eigen::Matrix2d turned;
    turned << 0.6, -side * 0.8, 0.8, side * 0.6;
    const Eigen::Matrix2d radius_px = root_of(ellipse.shape_px2) * turned;

    const Sitting sitting = sitting_of(ellipse, 1.7 * radius_px);

    EXPECT_EQ(sitting.center_px, ellipse.center_px);
    EXPECT_TRUE(sitting.radius_px.isApprox(radius_px, 1e-9)) << sitting.radius_px;
  }
}

}  // namespace
}  // namespace tubesight::core::detection
