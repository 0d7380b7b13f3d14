// Calibrations of a known camera: from computed dots with noise, and what must be refused.

#include "core/calibration/camera_calibration.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include "core/calibration/tsai_start.h"
#include "tests/core/calibration/computed_views.h"
#include "tests/support/heap_guard.h"

namespace tubesight::core::calibration {
namespace {

using CameraCalibration = ComputedViews;

TEST_F(CameraCalibration, OfTwoStageHeightsIsTrue) {
  add_stage();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  expect_true();
  EXPECT_NEAR(state_->camera(0), 5.06, 0.0015);
  EXPECT_NEAR(outcome_.fit.sigma_px, 0.015, 0.003);
  EXPECT_FALSE(outcome_.freed.stage_axis);
  EXPECT_FALSE(outcome_.freed.distortion2);
  EXPECT_LT(outcome_.map.rms_px, 0.15);
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
}

TEST_F(CameraCalibration, WithoutNoiseFindsTheCameraToItsDigits) {
  noise_px_ = 0.0;
  add_stage();
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_LT((state_->camera - truth_).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(outcome_.left_out, 0);
  EXPECT_EQ(outcome_.verdict, Verdict::kBase);
}

TEST_F(CameraCalibration, OfAStageThatStandsAskewFreesItsAxis) {
  add_stage(0.01);

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_TRUE(outcome_.freed.stage_axis);
  expect_true();
}

TEST_F(CameraCalibration, OfATemplateThatWasMovedAsideIsRefusedOrSaysWhatThatMayMean) {
  const Eigen::Matrix3d rotation = turned(0.2, -0.2, 0.7);
  const auto add = [&](double aside_mm) {
    data_->dots.clear();
    data_->views.clear();
    add_view(rotation, {0.5, -0.3, 82.0}, true, 0.0);
    add_view(rotation, Eigen::Vector3d(0.5 - aside_mm, -0.3, 82.0) + 30.0 * rotation.col(2), true,
             30.0);
  };
  add(5.0);
  EXPECT_NE(calibrate(), CalibrationRefusal::kNone);

  // By half a millimetre it looks like a stage that leans by a degree, which would make EFL
  // shorter.
  noise_px_ = 0.005;
  add(0.5);
  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);
  EXPECT_TRUE(outcome_.freed.stage_axis);
  EXPECT_LT(state_->camera(0), truth_(0));
  expect_true();
}

TEST_F(CameraCalibration, OfALeanThatNothingTellsFromTheCenterPromisesNoMore) {
  // Square to the template, without distortion, a stage that leans by 0.2 degrees looks like a
  // centre 1.8 px away, and the residuals stay what they are.
  truth_(4) = 0.0;
  noise_px_ = 0.003;
  const Eigen::Vector3d middle(0.5, -0.3, 82.0);
  const Eigen::Matrix3d rotation = turned(0.0, 0.0, 0.7);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.0035, -0.002, 1.0).normalized();
  add_view(rotation, middle, true, 0.0);
  add_view(rotation, middle + 30.0 * axis, true, 30.0);

  const CalibrationRefusal refusal = calibrate();

  EXPECT_EQ(refusal, CalibrationRefusal::kTooUncertain);
  EXPECT_GT(std::abs(state_->camera(2) - truth_(2)), 1.0);
  expect_true();
}

TEST_F(CameraCalibration, OfFreePosesIsTrue) {
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  expect_true();
}

TEST_F(CameraCalibration, FreesTheSecondDistortionWhereTheCameraHasIt) {
  truth_(5) = 2e-4;
  add_stage();
  add_free_poses();

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_TRUE(outcome_.freed.distortion2);
  expect_true();
}

TEST_F(CameraCalibration, LeavesOutADotThatIsNone) {
  add_stage();
  data_->dots[37].seen_px += Eigen::Vector2d(3.0, -2.0);
  data_->dots[120].seen_px += Eigen::Vector2d(0.0, 1.0);

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_EQ(outcome_.left_out, 2);
  EXPECT_FALSE(data_->dots[37].used);
  EXPECT_FALSE(data_->dots[120].used);
  expect_true();
}

TEST_F(CameraCalibration, TheCentroidsBiasIsThereAndIsTakenOut) {
  noise_px_ = 0.0;
  add_stage();
  add_free_poses();
  data_->dot_radius_mm = 0.0;  // as if centroids were the centres' images

  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);

  EXPECT_GT(outcome_.fit.rms_px, 0.003);
  EXPECT_GT((state_->camera - truth_).cwiseAbs().maxCoeff(), 0.005);
}

TEST_F(CameraCalibration, PromisesTheErrorThatItHas) {
  // The mean of squared errors by the covariance, over sessions: 5 for 5 parameters.
  double sum = 0.0;
  constexpr int kSessions = 10;
  for (int session = 0; session < kSessions; ++session) {
    data_->dots.clear();
    data_->views.clear();
    add_stage();
    ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);
    const Eigen::Matrix<double, 5, 1> error = (state_->camera - truth_).head<5>();
    math::Cholesky<5> factor;
    ASSERT_TRUE(factor.factor(outcome_.fit.camera_covariance.topLeftCorner<5, 5>()));
    sum += error.dot(factor.solve(error)) / 5.0;
  }
  EXPECT_GT(sum / kSessions, 0.45);
  EXPECT_LT(sum / kSessions, 1.8);
}

TEST_F(CameraCalibration, OfOneViewIsRefused) {
  add_view(turned(20.0, 0.0, 0.0), {0.0, 0.0, 95.0});
  EXPECT_EQ(calibrate(), CalibrationRefusal::kOneView);
}

TEST_F(CameraCalibration, OfEqualHeightsIsRefused) {
  add_stage(0.0, 5.0, 5.0);
  EXPECT_EQ(calibrate(), CalibrationRefusal::kEqualHeights);
}

TEST_F(CameraCalibration, OfSwappedHeightsIsRefused) {
  add_stage(0.0, 30.0, 0.0);
  EXPECT_EQ(calibrate(), CalibrationRefusal::kNoStart);
}

TEST_F(CameraCalibration, OfParallelPlanesWithoutHeightsIsRefused) {
  add_view(turned(0.2, -0.2, 0.7), {0.5, -0.3, 82.0});
  add_view(turned(0.2, -0.2, 0.7), {0.5, -0.3, 112.0});
  EXPECT_NE(calibrate(), CalibrationRefusal::kNone);
}

TEST_F(CameraCalibration, OfTwoLikePosesIsRefused) {
  add_view(turned(25.0, 0.0, 3.0), {0.0, 2.0, 95.0});
  add_view(turned(25.1, 0.0, 3.0), {0.1, 2.0, 95.0});
  EXPECT_EQ(calibrate(), CalibrationRefusal::kUndetermined);
}

TEST_F(CameraCalibration, OfPosesThatDifferByATurnInThePlaneIsRefusedHoweverLowTheNoise) {
  noise_px_ = 0.001;
  add_view(turned(25.0, 0.0, 3.0), {0.0, 2.0, 95.0});
  add_view(turned(25.0, 0.0, 90.0), {3.0, 0.0, 100.0});
  add_view(turned(24.0, 1.0, 45.0), {-2.0, 1.0, 105.0});
  EXPECT_EQ(calibrate(), CalibrationRefusal::kUndetermined);
}

TEST_F(CameraCalibration, OfTwoPosesTiltedToDifferentSidesIsTaken) {
  add_view(turned(25.0, 0.0, 3.0), {0.0, 2.0, 95.0});
  add_view(turned(0.0, 30.0, 40.0), {-2.0, 1.0, 105.0});
  ASSERT_EQ(calibrate(), CalibrationRefusal::kNone);
  expect_true();
}

TEST_F(CameraCalibration, OfAMirroredTemplateIsRefused) {
  add_stage();
  for (SeenDot& dot : data_->dots) {
    dot.place_mm.x() = -dot.place_mm.x();
  }
  EXPECT_EQ(calibrate(), CalibrationRefusal::kNoStart);
}

TEST_F(CameraCalibration, OfATemplatePrintedOutOfScaleIsRefused) {
  add_stage();
  for (SeenDot& dot : data_->dots) {
    dot.place_mm.y() *= dot.place_mm.y() > 35.0 ? 1.02 : 1.0;
  }
  EXPECT_NE(calibrate(), CalibrationRefusal::kNone);
}

/// A template as a printer may stretch it, and nobody was told. Prints the rows of
/// docs/calibration.md.
class StretchedTemplate : public CameraCalibration {
 protected:
  StretchedTemplate() { noise_px_ = 0.02; }

  /// On a stage, turned by so much in the picture; without that in free poses.
  void calibrate_stretched(const char* what, std::optional<double> turn_deg, double across,
                           double down, CalibrationRefusal refusal = CalibrationRefusal::kNone) {
    data_->dots.clear();
    data_->views.clear();
    stretch_ << across, down, 1.0;
    turn_deg_ = turn_deg.value_or(0.0);
    turn_deg ? add_stage() : add_free_poses();
    ASSERT_EQ(calibrate(), refusal) << what;
    std::printf("%-8s turned %2.0f  EFL %.4f +- %.4f mm, h_sx %.4f, map %.2f px, sigma %.3f px\n",
                what, turn_deg.value_or(-1.0), state_->camera(0),
                std::sqrt(outcome_.fit.camera_covariance(0, 0)), state_->camera(1),
                outcome_.map.rms_px, outcome_.fit.sigma_px);
  }
  [[nodiscard]] double off_mm() const { return state_->camera(0) - truth_(0); }
};

TEST_F(StretchedTemplate, OfAStageThatStandsStraightShowsNothing) {
  calibrate_stretched("as told", 0.7, 1.0, 1.0);
  EXPECT_LT(std::abs(off_mm()), 0.0015);
  calibrate_stretched("larger", 0.7, 1.002, 1.002);
  EXPECT_NEAR(off_mm(), 0.002 * 5.06, 0.0015);
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
  calibrate_stretched("wider", 0.7, 1.002, 1.0);
  EXPECT_NEAR(state_->camera(1), 1.002 * 1.021, 0.0005) << "it is taken for the horizontal scale";
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
  calibrate_stretched("longer", 0.7, 1.0, 1.002);
  EXPECT_NEAR(state_->camera(1), 1.021 / 1.002, 0.0005);
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
}

TEST_F(StretchedTemplate, OfAStageThatStandsTurnedIsSeenInOneDirection) {
  calibrate_stretched("as told", 30.0, 1.0, 1.0);
  EXPECT_LT(std::abs(off_mm()), 0.0015);
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
  calibrate_stretched("larger", 30.0, 1.002, 1.002);
  EXPECT_NEAR(off_mm(), 0.002 * 5.06, 0.0015);
  EXPECT_NE(outcome_.verdict, Verdict::kTracking);
  calibrate_stretched("wider", 30.0, 1.002, 1.0, CalibrationRefusal::kPattern);
  calibrate_stretched("longer", 30.0, 1.0, 1.002, CalibrationRefusal::kPattern);
}

TEST_F(StretchedTemplate, OfFreePosesIsHarmedByOneDirectionAlone) {
  calibrate_stretched("as told", {}, 1.0, 1.0);
  EXPECT_LT(std::abs(off_mm()), 0.002);
  calibrate_stretched("larger", {}, 1.002, 1.002);
  EXPECT_LT(std::abs(off_mm()), 0.002);
  for (const auto& [what, across, down] :
       {std::tuple{"wider", 1.002, 1.0}, std::tuple{"longer", 1.0, 1.002}}) {
    calibrate_stretched(what, {}, across, down);
    EXPECT_GT(outcome_.fit.sigma_px, 0.035) << what;
    EXPECT_GT(outcome_.map.rms_px, 0.3) << what;
    EXPECT_EQ(outcome_.verdict, Verdict::kTracking) << what;
  }
}

TEST_F(CameraCalibration, OfALooseLensIsRefused) {
  const Eigen::Matrix3d rotation = turned(0.2, -0.2, 0.7);
  add_view(rotation, {0.5, -0.3, 82.0}, true, 0.0);
  truth_(2) += 8.0;  // the lens tipped between the heights
  truth_(4) *= 1.3;
  add_view(rotation, {0.5, -0.3, 112.0}, true, 30.0);
  const CalibrationRefusal refusal = calibrate();
  EXPECT_TRUE(refusal != CalibrationRefusal::kNone || outcome_.verdict == Verdict::kTracking);
}

TEST_F(CameraCalibration, AsksForNoMemory) {
  add_stage();
  std::int64_t allocations = 0;
  {
    const tests::HeapGuard guard;
    static_cast<void>(calibrate());
    allocations = guard.calls().allocations;
  }
  EXPECT_EQ(allocations, 0);
}

TEST_F(CameraCalibration, StartsNearTheCamera) {
  truth_(4) = 0.002;
  add_stage();
  ASSERT_TRUE(start_from_views(*data_, *state_));
  EXPECT_NEAR(state_->camera(0), 5.06, 0.4);
  EXPECT_NEAR(state_->poses[1].t_camera_target.z() - state_->poses[0].t_camera_target.z(), 30.0,
              3.0);
}

}  // namespace
}  // namespace tubesight::core::calibration
