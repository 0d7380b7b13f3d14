#include "core/detection/blob_scan.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::core::detection {
namespace {

constexpr int kWidth_px = 96;
constexpr int kHeight_px = 80;

class BlobScanOf : public ::testing::Test {
 protected:
  BlobScanOf() { fill(0, 0, kWidth_px - 1, kHeight_px - 1, 200); }

  void fill(int left, int top, int right, int bottom, int grey) {
    for (int v = top; v <= bottom; ++v) {
      for (int u = left; u <= right; ++u) {
        set(u, v, grey);
      }
    }
  }
  void set(int u, int v, int grey) {
    pixels_[static_cast<std::size_t>(v * kWidth_px + u)] = static_cast<std::uint16_t>(grey * 256);
  }
  void disc(double u, double v, double radius, int grey) {
    for (int y = 0; y < kHeight_px; ++y) {
      for (int x = 0; x < kWidth_px; ++x) {
        if ((x - u) * (x - u) + (y - v) * (y - v) <= radius * radius) {
          set(x, y, grey);
        }
      }
    }
  }

  bool scan(const BlobLimits& limits = {}) {
    const picture::AveragedPicture picture{pixels_.data(), kWidth_px, kHeight_px};
    EXPECT_TRUE(thresholds_->measure(picture).has_value());
    EXPECT_TRUE(thresholds_->choose(0.5, 10.0));
    return scan_->scan(picture, *thresholds_, limits, *blobs_);
  }

  std::vector<std::uint16_t> pixels_ = std::vector<std::uint16_t>(kWidth_px * kHeight_px);
  std::unique_ptr<ThresholdMap> thresholds_ = std::make_unique<ThresholdMap>();
  std::unique_ptr<BlobScan> scan_ = std::make_unique<BlobScan>();
  std::unique_ptr<BlobList> blobs_ = std::make_unique<BlobList>();
};

TEST_F(BlobScanOf, ADiscHasItsCentreAndItsRadius) {
  disc(40.0, 30.0, 12.0, 20);

  ASSERT_TRUE(scan());

  ASSERT_EQ(blobs_->size(), 1);
  const Blob& blob = (*blobs_)[0];
  EXPECT_TRUE(blob.dark);
  EXPECT_NEAR(blob.ellipse.center_px.x(), 40.0, 1e-9);
  EXPECT_NEAR(blob.ellipse.center_px.y(), 30.0, 1e-9);
  EXPECT_NEAR(half_axes(blob.ellipse).x(), 12.0, 0.2);
  EXPECT_NEAR(half_axes(blob.ellipse).y(), 12.0, 0.2);
  EXPECT_NEAR(blob.fill, 1.0, 0.01);
}

TEST_F(BlobScanOf, ARectangleHasTheMomentsWrittenByHand) {
  fill(20, 30, 39, 39, 20);  // 20 x 10 pixels about (29.5, 34.5)

  ASSERT_TRUE(scan());

  ASSERT_EQ(blobs_->size(), 1);
  const Blob& blob = (*blobs_)[0];
  EXPECT_NEAR(blob.ellipse.center_px.x(), 29.5, 1e-9);
  EXPECT_NEAR(blob.ellipse.center_px.y(), 34.5, 1e-9);
  EXPECT_NEAR(blob.ellipse.shape_px2(0, 0), 400.0 / 3.0, 1e-6);  // 4 w^2 / 12
  EXPECT_NEAR(blob.ellipse.shape_px2(1, 1), 100.0 / 3.0, 1e-6);
  EXPECT_NEAR(blob.ellipse.shape_px2(0, 1), 0.0, 1e-6);
  EXPECT_NEAR(blob.fill, 0.9549, 1e-4);  // 3 / pi
}

TEST_F(BlobScanOf, PartsThatMeetFarBelowAreOneSpot) {
  // A U of two legs, joined by its last line alone: no ellipse.
  fill(20, 20, 25, 50, 20);
  fill(40, 20, 45, 50, 20);
  fill(20, 51, 45, 52, 20);

  ASSERT_TRUE(scan());

  EXPECT_TRUE(blobs_->empty());
}

TEST_F(BlobScanOf, WhatTouchesThePicturesEdgeIsLeftOut) {
  disc(5.0, 40.0, 8.0, 20);
  disc(40.0, 4.0, 8.0, 20);
  disc(90.0, 40.0, 8.0, 20);
  disc(40.0, 76.0, 8.0, 20);
  disc(40.0, 40.0, 8.0, 20);

  ASSERT_TRUE(scan());

  ASSERT_EQ(blobs_->size(), 1);
  EXPECT_NEAR((*blobs_)[0].ellipse.center_px.x(), 40.0, 1e-9);
}

TEST_F(BlobScanOf, LimitsLeaveOutWhatIsTooSmallOrTooSlim) {
  disc(20.0, 20.0, 3.0, 20);
  fill(30, 60, 69, 62, 20);
  disc(60.0, 30.0, 10.0, 20);
  BlobLimits limits;
  limits.least_area_px2 = 50.0;

  ASSERT_TRUE(scan(limits));

  ASSERT_EQ(blobs_->size(), 1);
  EXPECT_NEAR((*blobs_)[0].ellipse.center_px.x(), 60.0, 1e-9);
}

TEST_F(BlobScanOf, ASpotFromASecondThresholdIsKeptOnce) {
  disc(40.0, 30.0, 12.0, 20);

  ASSERT_TRUE(scan());
  ASSERT_TRUE(scan());

  EXPECT_EQ(blobs_->size(), 1);
}

TEST_F(BlobScanOf, ABrightSpotWithinADarkOneIsTold) {
  disc(48.0, 40.0, 30.0, 20);
  disc(48.0, 40.0, 8.0, 200);

  ASSERT_TRUE(scan());

  ASSERT_EQ(blobs_->size(), 1);  // the ring is no ellipse
  EXPECT_FALSE((*blobs_)[0].dark);
  EXPECT_NEAR(half_axes((*blobs_)[0].ellipse).x(), 8.0, 0.2);
}

TEST(ThresholdMap, FollowsTheLightAndTakesAFlatPlacesSideFromItsEdge) {
  // A disc of 60 px across in light that fades to two thirds: inside all is dark, outside all
  // bright.
  constexpr int kSide_px = 160;
  std::vector<std::uint16_t> pixels(kSide_px * kSide_px);
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) {
      const double light = 1.0 - 0.33 * u / kSide_px;
      const bool inside = (u - 80) * (u - 80) + (v - 80) * (v - 80) <= 30 * 30;
      pixels[static_cast<std::size_t>(v * kSide_px + u)] =
          static_cast<std::uint16_t>(256.0 * light * (inside ? 10.0 : 200.0));
    }
  }
  const picture::AveragedPicture picture{pixels.data(), kSide_px, kSide_px};
  const auto map = std::make_unique<ThresholdMap>();
  ASSERT_TRUE(map->measure(picture).has_value());
  ASSERT_TRUE(map->choose(0.5, 10.0));

  int wrong = 0;
  std::vector<std::uint16_t> line(kSide_px);
  for (int v = 0; v < kSide_px; ++v) {
    map->line(v, line);
    for (int u = 0; u < kSide_px; ++u) {
      const double off = std::hypot(u - 80, v - 80);
      const bool dark = picture.line(v)[u] < line[static_cast<std::size_t>(u)];
      wrong += off < 29.0 && !dark ? 1 : 0;
      wrong += off > 31.0 && off < 60.0 && dark ? 1 : 0;
    }
  }

  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace tubesight::core::detection
