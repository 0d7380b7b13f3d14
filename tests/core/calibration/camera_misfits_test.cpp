// What a camera's model does not hold, or a template is not: found, told, or refused.

#include <cmath>

#include <gtest/gtest.h>

#include "core/calibration/camera_type.h"
#include "core/calibration/lens_misfit.h"
#include "core/calibration/picture_cover.h"
#include "tests/core/calibration/computed_views.h"

namespace tubesight::core::calibration {
namespace {

using Place = Eigen::Vector3d;

class CameraMisfits : public ComputedViews {
 protected:
  /// How far the calibrated map is off over the picture.
  [[nodiscard]] double map_error_px() const {
    return map_difference(data_->sensor, state_->camera, truth_, tangential_).rms_px;
  }
  /// Refused, or said to be good for tracking alone and no worse than it says.
  void expect_no_more_than_tracking() {
    if (calibrate() == CalibrationRefusal::kNone) {
      EXPECT_EQ(outcome_.verdict, Verdict::kTracking);
      EXPECT_LT(map_error_px(), 1.0);
    }
  }
  /// The template square to the camera at 82 mm + `height_mm`.
  void add_height(double height_mm) {
    const Eigen::Matrix3d rotation = turned(0.2, -0.2, 0.7);
    add_view(rotation, Place(0.5, -0.3, 82.0) + height_mm * rotation.col(2), true, height_mm);
  }
};

TEST_F(CameraMisfits, TangentialDistortionIsToldWithWhatTheMapMissesByIt) {
  tangential_ = {5e-4, -3e-4};
  add_stage();
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_TRUE(outcome_.freed.tangential);
  EXPECT_FALSE(outcome_.tangential.rival);
  EXPECT_NEAR(outcome_.tangential.p.x(), 5e-4, 1e-5);
  EXPECT_NEAR(outcome_.tangential.p.y(), -3e-4, 1e-5);
  EXPECT_NEAR(outcome_.tangential.map.rms_px, map_error_px(), 0.05);
  EXPECT_GT(map_error_px(), 0.2);
  EXPECT_EQ(outcome_.verdict, Verdict::kTracking);
  EXPECT_EQ(state_->tangential.norm(), 0.0) << "the settings have no place for it";
}

TEST_F(CameraMisfits, TwoHeightsDoNotTellItFromAStageThatLeans) {
  tangential_ = {5e-4, -3e-4};
  add_stage();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_TRUE(outcome_.tangential.rival);
  EXPECT_NEAR(outcome_.tangential.map.rms_px, map_error_px(), 0.1);
  EXPECT_EQ(outcome_.verdict, Verdict::kTracking);
}

TEST_F(CameraMisfits, ABowOfTheTemplateIsFoundAndTakenOut) {
  printed_ = [](const Place& p) {
    return Place(p + Place(0, 0, 0.3 * std::pow(p.x() / 36 - 1, 2)));
  };
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_TRUE(outcome_.freed.bow);
  EXPECT_NEAR(state_->bow_mm(0), 0.3, 0.01);
  EXPECT_NEAR(state_->bow_mm(2), 0.0, 0.01);
  expect_true();
  EXPECT_LT(map_error_px(), 0.1);
}

TEST_F(CameraMisfits, AFlatTemplateIsTakenAsFlat) {
  add_stage();
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_FALSE(outcome_.freed.bow);
  EXPECT_FALSE(outcome_.freed.tangential);
  EXPECT_FALSE(outcome_.patterned);
}

TEST_F(CameraMisfits, ATemplatePrintedInWavesIsRefused) {
  printed_ = [](const Place& p) { return Place(p + Place(0.1 * std::sin(p.x() / 12), 0, 0)); };
  add_stage();
  EXPECT_EQ(calibrate(), CalibrationRefusal::kPattern);
}

TEST_F(CameraMisfits, ATemplatePrintedAskewIsNoMoreThanForTracking) {
  printed_ = [](const Place& p) { return Place(p + Place(0.003 * p.y(), 0, 0)); };
  add_free_poses();
  expect_no_more_than_tracking();
}

TEST_F(CameraMisfits, ATemplatePrintedWiderThanHighIsNoMoreThanForTracking) {
  printed_ = [](const Place& p) { return Place(1.01 * p.x(), p.y(), p.z()); };
  add_free_poses();
  expect_no_more_than_tracking();
}

TEST_F(CameraMisfits, AFocusThatChangedBetweenThreeHeightsIsRefused) {
  add_height(0.0);
  add_height(15.0);
  truth_(0) *= 1.003;
  add_height(30.0);
  EXPECT_EQ(calibrate(), CalibrationRefusal::kPattern);
}

TEST_F(CameraMisfits, AFocusThatChangedIsSeenWhenTheStageComesBack) {
  add_height(0.0);
  add_height(30.0);
  truth_(0) *= 1.003;
  add_height(0.0);
  EXPECT_EQ(calibrate(), CalibrationRefusal::kPattern);
}

TEST_F(CameraMisfits, AFocusThatChangedBetweenTwoHeightsIsNeverGoodForABase) {
  noise_px_ = 0.002;
  add_height(0.0);
  truth_(0) *= 1.003;
  add_height(30.0);

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone) << "nothing shows it";

  EXPECT_NEAR(outcome_.unseen_lens, 112.0 / 30.0, 0.1);
  EXPECT_NEAR(state_->camera(0) / 5.06 - 1.0, 0.003 * outcome_.unseen_lens, 0.002)
      << "what is told of it";
  EXPECT_LT(outcome_.judged_px, 0.05);
  EXPECT_EQ(outcome_.verdict, Verdict::kPose);
}

TEST_F(CameraMisfits, AThirdViewBackAtTheFirstHeightVouchesForTheLens) {
  noise_px_ = 0.002;
  add_height(0.0);
  add_height(30.0);
  add_height(0.0);

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_EQ(outcome_.unseen_lens, 0.0);
  EXPECT_EQ(outcome_.verdict, Verdict::kBase);
}

TEST_F(CameraMisfits, HeightsInAnotherUnitAreRefusedWhereTheLensIsKnown) {
  data_->lens_mm = 5.2;
  add_stage();
  EXPECT_EQ(calibrate(), CalibrationRefusal::kNone) << "the data sheet's EFL is not exact";
  for (const double factor : {25.4, 0.1}) {
    data_->views.clear();
    data_->dots.clear();
    add_stage(0.0, 0.0, 30.0 * factor);
    const CalibrationRefusal refusal = calibrate();
    EXPECT_TRUE(refusal == CalibrationRefusal::kOtherLens ||
                refusal == CalibrationRefusal::kNoStart)
        << factor << ": " << static_cast<int>(refusal);
  }
}

TEST_F(CameraMisfits, APictureWithoutDotsInHalfOfItIsToldWithItsUncertainty) {
  add_stage();
  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);
  EXPECT_LT(uncovered_part(*data_, state_->camera, outcome_.fit.camera_covariance).share, 0.2);
  const double whole = outcome_.map.rms_px;
  for (SeenDot& dot : data_->dots) {
    dot.used = dot.seen_px.x() < 320.0;
  }
  const FitOutcome half = fit_camera({}, *data_, *state_, *scratch_);

  const UncoveredPart part = uncovered_part(*data_, state_->camera, half.camera_covariance);

  EXPECT_GT(part.share, 0.37) << "what is right of 320 px + 80 px";
  EXPECT_GT(part.u_px, 400.0);
  EXPECT_GT(part.rms_px, 1.5 * whole);
}

TEST_F(CameraMisfits, OneTiltedViewTellsSomethingAndIsRefused) {
  add_view(turned(25.0, 0.0, 3.0), {0.0, 2.0, 95.0});

  EXPECT_EQ(calibrate(), CalibrationRefusal::kOneView);

  EXPECT_TRUE(outcome_.assumed);
  const double sigma = std::sqrt(outcome_.fit.camera_covariance(0, 0));
  EXPECT_LT(std::abs(state_->camera(0) - truth_(0)), 3.0 * sigma);
  EXPECT_GT(std::sqrt(outcome_.fit.camera_covariance(2, 2)), 10.0) << "the centre was assumed";
  EXPECT_GT(outcome_.map.rms_px, 10.0);
}

TEST_F(CameraMisfits, OneSquareViewTellsNothing) {
  add_view(turned(0.2, -0.2, 0.7), {0.0, 2.0, 95.0});

  EXPECT_EQ(calibrate(), CalibrationRefusal::kOneView);

  EXPECT_FALSE(outcome_.assumed);
}

/// A hundred known points in space, 20 mm deep, in one view.
class SolidPoints : public CameraMisfits {
 protected:
  SolidPoints() {
    data_->dot_radius_mm = 0.0;
    add_view(turned(8.0, -5.0, 12.0), {0.5, -0.3, 85.0});
    TargetPose pose;
    pose.R_camera_target = turned(8.0, -5.0, 12.0);
    pose.t_camera_target = Place(0.5, -0.3, 95.0) - pose.R_camera_target * Place(36.0, 36.0, 0.0);
    int i = 0;
    for (SeenDot& dot : data_->dots) {
      dot.place_mm.z() = 10.0 * (i++ * 7 % 3) - 10.0;
      dot.seen_px = centroid_of(data_->sensor, truth_, pose, dot.place_mm, 0.0) +
                    noise_px_ * Eigen::Vector2d(spread_(random_), spread_(random_));
    }
  }
};

TEST_F(SolidPoints, OfOneViewTellAllOfACamera) {
  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  expect_true();
  EXPECT_NEAR(state_->camera(0), 5.06, 0.02);
}

TEST_F(SolidPoints, MirroredAreRefused) {
  for (SeenDot& dot : data_->dots) {
    dot.place_mm.z() = -dot.place_mm.z();
  }
  EXPECT_NE(calibrate(), CalibrationRefusal::kNone);
}

TEST(MapDifference, OfATurnIsNone) {
  const Sensor sensor{0.0102, 0.0098, 635.0, 480.0};
  CameraValues camera;
  camera << 5.06, 1.021, 324.3, 233.8, 0.0, 0.0;
  CameraValues lens = camera;
  lens(2) += 1.0;  // without distortion a shifted centre is a turn, but for the picture's plane
  EXPECT_LT(map_difference(sensor, camera, lens).rms_px, 0.3);
  EXPECT_GT(map_difference(sensor, camera, lens).rms_px, 0.01);
  lens = camera;
  lens(0) *= 1.01;
  EXPECT_GT(map_difference(sensor, camera, lens).rms_px, 1.0);
  EXPECT_LT(map_difference(sensor, camera, lens, {0.0, 0.0}, MapGauge::kTurnAndFocal).rms_px, 1e-9);
}

TEST(CameraType, CountsWhatUnitsDifferBy) {
  const Sensor sensor{0.0102, 0.0098, 635.0, 480.0};
  CameraValues camera;
  camera << 5.06, 1.021, 324.3, 233.8, 0.0092, 0.0;
  CalibrationOutcome outcome;
  outcome.verdict = Verdict::kBase;

  widen_to_type(sensor, camera, {}, outcome);

  EXPECT_EQ(outcome.verdict, Verdict::kTracking);
  EXPECT_NEAR(std::sqrt(outcome.fit.camera_covariance(0, 0)), 0.0506, 1e-6);
  EXPECT_NEAR(std::sqrt(outcome.fit.camera_covariance(3, 3)), 4.0, 1e-6);
  EXPECT_GT(outcome.map.rms_px, 0.2);
  EXPECT_LT(outcome.map.rms_px, 1.0);
}

}  // namespace
}  // namespace tubesight::core::calibration
