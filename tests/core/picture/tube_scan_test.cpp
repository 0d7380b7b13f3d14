#include "core/picture/tube_scan.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/core/pose/still_picture.h"

namespace tubesight::core::picture {
namespace {

using pose::kStillPlace;
using pose::kUnderTube;
using pose::StillPicture;

class TubeScanOf : public ::testing::Test {
 protected:
  TubeScanOf() { still_.sheet->look.noise = 2.0; }

  AveragedPicture draw() {
    still_.draw(kStillPlace);
    return still_.averaged();
  }

  /// Points lie where the drawing has the rim: the bore's radius from the tube's centre.
  void expect_on_rim(const Rim& rim, TubeAddress address) {
    const auto center = still_.sheet->center_of(address);
    const double radius_mm = still_.settings->tubesheet.bore_mm / 2.0;
    for (const RimPoint& point : rim.points) {
      const auto at = still_.sheet->sheet_point(kStillPlace, {point.u_px, point.v_px});
      ASSERT_TRUE(at.has_value());
      EXPECT_NEAR(std::hypot((*at)[0] - center[0], (*at)[1] - center[1]), radius_mm, 0.35);
    }
  }

  StillPicture still_;
  Rim rim_;
};

TEST_F(TubeScanOf, AnOpenTubeEndFindsItsRimFromAnywhereInTheDark) {
  const AveragedPicture picture = draw();
  const auto at = still_.sheet->image_of(kStillPlace, kUnderTube);
  for (const double du : {-15.0, 0.0, 15.0}) {
    for (const double dv : {-10.0, 0.0, 10.0}) {
      const TubeScan scan = scan_tube(picture, at[0] + du, at[1] + dv, {}, rim_);

      ASSERT_EQ(scan.refusal, ScanRefusal::kNone) << du << ' ' << dv;
      EXPECT_GT(rim_.points.size(), 40);
      expect_on_rim(rim_, kUnderTube);
    }
  }
}

TEST_F(TubeScanOf, AFilletWeldFindsTheInnerEdge) {
  still_.sheet->look.fillet = true;
  const AveragedPicture picture = draw();
  const auto at = still_.sheet->image_of(kStillPlace, kUnderTube);

  const TubeScan scan = scan_tube(picture, at[0] + 5.0, at[1], {}, rim_);

  ASSERT_EQ(scan.refusal, ScanRefusal::kNone);
  expect_on_rim(rim_, kUnderTube);
}

TEST_F(TubeScanOf, APlaceOnTheSheetIsRefused) {
  const AveragedPicture picture = draw();
  const auto a = still_.sheet->image_of(kStillPlace, TubeAddress{20, 10});
  const auto b = still_.sheet->image_of(kStillPlace, TubeAddress{21, 11});

  const TubeScan scan = scan_tube(picture, (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, {}, rim_);

  EXPECT_NE(scan.refusal, ScanRefusal::kNone);
}

TEST_F(TubeScanOf, APlaceOutsideThePictureIsRefused) {
  const AveragedPicture picture = draw();

  EXPECT_EQ(scan_tube(picture, -5.0, 100.0, {}, rim_).refusal, ScanRefusal::kOutside);
  EXPECT_EQ(scan_tube(picture, 100.0, 5000.0, {}, rim_).refusal, ScanRefusal::kOutside);
}

TEST_F(TubeScanOf, AFlatPictureHasNoBoundary) {
  still_.sheet->look.gain = 0.0;
  still_.sheet->look.offset = 100.0;
  const AveragedPicture picture = draw();

  EXPECT_EQ(scan_tube(picture, 300.0, 200.0, {}, rim_).refusal, ScanRefusal::kNoBoundary);
}

}  // namespace
}  // namespace tubesight::core::picture
