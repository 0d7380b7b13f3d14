// Halves of one calibration: those of a sound one agree, others do not.

#include "core/calibration/halves.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/calibration/next_view.h"
#include "core/calibration/tip_uncertainty.h"

namespace tubesight::core::calibration {
namespace {

class Halves : public ::testing::Test {
 protected:
  Halves() {
    data_->sensor = {0.0084 * 768 / 635, 0.0098, 635.0, 480.0};
    data_->dot_radius_mm = 2.0;
    truth_ << 5.06, 1.021, 324.3, 233.8, 0.0092, 0.0;
  }

  /// Eight lines of eight dots about the middle of the template, which bows by `bow_mm` at its
  /// edge.
  void add_view(double about_x_deg, double about_y_deg, double away_mm, bool staged = false,
                double height_mm = 0.0, double bow_mm = 0.0) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    TargetPose pose;
    pose.R_camera_target = (Eigen::AngleAxisd(about_x_deg * kDegree, Eigen::Vector3d::UnitX()) *
                            Eigen::AngleAxisd(about_y_deg * kDegree, Eigen::Vector3d::UnitY()))
                               .toRotationMatrix();
    pose.t_camera_target = Eigen::Vector3d(0.5, -0.3, away_mm) -
                           pose.R_camera_target * Eigen::Vector3d(28.0, 28.0, 0.0);
    CalibrationView view;
    view.first = data_->dots.size();
    view.staged = staged;
    view.height_mm = height_mm;
    view.count = 64;
    for (int i = 0; i < view.count; ++i) {
      SeenDot dot;
      dot.place_mm << 8.0 * (i % 8), 8.0 * (i / 8), 0.0;
      const double edge = (dot.place_mm.x() - 28.0) / 28.0;
      const Eigen::Vector3d true_mm =
          dot.place_mm + Eigen::Vector3d(0.0, 0.0, bow_mm * edge * edge);
      dot.seen_px = centroid_of(data_->sensor, truth_, pose, true_mm, 2.0) +
                    0.01 * Eigen::Vector2d(spread_(random_), spread_(random_));
      ASSERT_TRUE(data_->dots.try_push_back(dot));
    }
    ASSERT_TRUE(data_->views.try_push_back(view));
  }

  void add_poses(int count) {
    for (int i = 0; i < count; ++i) {
      add_view(25.0 * std::cos(2.4 * i), 25.0 * std::sin(2.4 * i), 95.0 + i);
    }
  }

  HalvesOutcome compare() {
    outcome_ = calibrate_camera(*data_, *state_, scratch_->fit);
    EXPECT_EQ(outcome_.refusal, CalibrationRefusal::kNone);
    return compare_halves(*data_, *state_, outcome_.freed, *scratch_);
  }

  CameraValues truth_;
  std::mt19937 random_{5};
  std::normal_distribution<double> spread_{0.0, 1.0};
  CalibrationOutcome outcome_;
  std::unique_ptr<CalibrationData> data_ = std::make_unique<CalibrationData>();
  std::unique_ptr<CalibrationState> state_ = std::make_unique<CalibrationState>();
  std::unique_ptr<HalvesScratch> scratch_ = std::make_unique<HalvesScratch>();
};

TEST_F(Halves, OfASoundCalibrationAgree) {
  add_poses(6);

  const HalvesOutcome halves = compare();

  EXPECT_TRUE(halves.told);
  EXPECT_LT(halves.sigmas(), kMostHalvesSigmas);
  EXPECT_GT(halves.promised_px, outcome_.map.rms_px);
  EXPECT_EQ(lowered_by(halves, Verdict::kBase, 0.03), Verdict::kBase);
}

TEST_F(Halves, OfTwoHeightsAloneAreComparedByDots) {
  add_view(0.2, -0.2, 82.0, true, 0.0);
  add_view(0.2, -0.2, 112.0, true, 30.0);

  const HalvesOutcome halves = compare();

  EXPECT_TRUE(halves.told);
  EXPECT_NE(halves.split, HalvesSplit::kViews);
  EXPECT_LT(halves.sigmas(), kMostHalvesSigmas);
}

TEST_F(Halves, OfALensThatWasTurnedBetweenTheViewsDisagree) {
  for (int i = 0; i < 8; ++i) {
    truth_(2) = i % 2 == 0 ? 324.3 : 325.0;
    add_view(25.0 * std::cos(2.4 * i), 25.0 * std::sin(2.4 * i), 95.0 + i);
  }

  const HalvesOutcome halves = compare();

  ASSERT_TRUE(halves.told);
  EXPECT_EQ(halves.split, HalvesSplit::kViews);
  EXPECT_GT(halves.sigmas(), kMostHalvesSigmas);
  EXPECT_GT(halves.off_px, 0.3);
}

TEST_F(Halves, OfABowedTemplateOnAStageAgree) {
  // The bow is counted from the middle of the whole template: that of one side alone has the
  // template lean, and a stage with it.
  add_view(0.0, 0.0, 82.0, true, 0.0, 0.3);
  add_view(0.0, 0.0, 112.0, true, 30.0, 0.3);
  for (int i = 0; i < 4; ++i) {
    add_view(25.0 * std::cos(1.6 * i), 25.0 * std::sin(1.6 * i), 95.0 + i, false, 0.0, 0.3);
  }

  const HalvesOutcome halves = compare();

  EXPECT_TRUE(outcome_.freed.bow);
  EXPECT_FALSE(outcome_.freed.stage_axis);
  EXPECT_TRUE(halves.told);
  EXPECT_LT(halves.sigmas(), kMostHalvesSigmas) << static_cast<int>(halves.split);
}

TEST_F(Halves, ThatContradictEachOtherLowerTheVerdict) {
  HalvesOutcome halves;
  halves.told = true;
  halves.off_px = 0.3;
  halves.promised_px = 0.1;
  EXPECT_EQ(lowered_by(halves, Verdict::kBase, 0.04), Verdict::kPose);
  EXPECT_EQ(lowered_by(halves, Verdict::kBase, 0.01), Verdict::kPose);
  EXPECT_EQ(lowered_by(halves, Verdict::kPose, 0.06), Verdict::kTracking);
  halves.off_px = 0.9;
  EXPECT_EQ(lowered_by(halves, Verdict::kBase, 0.04), Verdict::kTracking);
  halves.told = false;
  EXPECT_EQ(lowered_by(halves, Verdict::kBase, 0.04), Verdict::kBase);
}

TEST_F(Halves, TheNextViewBringsWhatItPromises) {
  // Four views to one side leave much open; the view found is taken, and the map is then known as
  // was told.
  for (int i = 0; i < 4; ++i) {
    add_view(20.0 + i, 2.0 * i, 95.0 + i);
  }
  static_cast<void>(compare());
  const double before_px = outcome_.map.rms_px;

  const NextViewOutcome next = find_next_view(*data_, *state_, outcome_, *scratch_);

  ASSERT_TRUE(next.told);
  EXPECT_LT(next.map_rms_px, 0.7 * before_px);
  const std::array<std::array<double, 2>, 5> turns = {
      {{30.0, 0.0}, {-30.0, 0.0}, {0.0, -30.0}, {0.0, 30.0}, {0.0, 0.0}}};
  const auto& turn = turns[static_cast<std::size_t>(next.view)];
  add_view(turn[0], turn[1], 96.0);
  static_cast<void>(compare());
  EXPECT_NEAR(outcome_.map.rms_px, next.map_rms_px, 0.25 * next.map_rms_px);
}

TEST(TipUncertainty, OfAFocalLengthAloneIsAlongTheGap) {
  // Docked, a focal length too long by a share puts sheet and tip too far away by that share, which
  // is one another's; of the gap below the sheet that share remains, and nothing of it across but
  // the lever's.
  const Sensor sensor{0.01, 0.01, 640.0, 480.0};
  CameraValues camera;
  camera << 5.0, 1.0, 319.5, 239.5, 0.0, 0.0;
  math::Matrix6d covariance = math::Matrix6d::Zero();
  covariance(0, 0) = 0.05 * 0.05;  // a hundredth

  const TipUncertainty tip = tip_uncertainty(sensor, camera, covariance, {}, 40.0);

  ASSERT_TRUE(tip.told());
  EXPECT_NEAR(tip.along_mm, 0.4, 0.001);
  EXPECT_LT(tip.across_mm, 0.001);
  EXPECT_GT(tip.all_across_mm, 0.005);
  EXPECT_LT(tip.all_across_mm, 0.1);
}

TEST(TipUncertainty, IsNotToldWhereTheSheetIsTooFewTubes) {
  const Sensor sensor{0.01, 0.01, 640.0, 480.0};
  CameraValues camera;
  camera << 50.0, 1.0, 319.5, 239.5, 0.0, 0.0;
  EXPECT_FALSE(tip_uncertainty(sensor, camera, math::Matrix6d::Identity(), {}, 10.0).told());
}

}  // namespace
}  // namespace tubesight::core::calibration
