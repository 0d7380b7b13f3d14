#include "core/calibration/docking_focal.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/pose/pose_test_support.h"

namespace tubesight::core::calibration {
namespace {

const tests::ToolPlace kDocked{762.0, 457.2, 0.0, 33.0, 0.0, 0.0};

/// The EFL by the scene's rims when it is taken to be `ratio` times the true one at first, found
/// `rounds` times.
DockingFocal found(pose::PoseScene& scene, double ratio, int rounds) {
  CameraSettings camera = scene.settings().camera;
  camera.focal_length_mm *= ratio;
  DockingFocal focal;
  for (int round = 0; round < rounds; ++round) {
    auto model = pose::make_pose_model(camera, scene.settings().tool, scene.settings().tubesheet);
    EXPECT_TRUE(model.has_value());
    pose::PoseOptions options;
    options.max_rms_px = 4.0;
    const auto outcome = pose::estimate_pose(*model, *scene.rims, options, *scene.workspace);
    EXPECT_TRUE(outcome.has_value());
    focal = focal_by_docking(*model, *scene.rims, outcome.estimate, *scene.workspace);
    EXPECT_TRUE(focal.solved);
    camera.focal_length_mm = focal.focal_length_mm;
  }
  return focal;
}

TEST(DockingFocal, IsTheCamerasOwnWhateverWasTakenBefore) {
  pose::PoseScene scene;
  scene.see(kDocked, 20, {});
  const double right = scene.settings().camera.focal_length_mm;
  for (const double ratio : {0.97, 1.03}) {
    EXPECT_NEAR(found(scene, ratio, 4).focal_length_mm, right, 2e-4 * right) << ratio;
  }
}

TEST(DockingFocal, PromisesTheErrorThatItHas) {
  pose::PoseScene scene;
  tests::RimLook look;
  look.points = 32;
  look.noise_px = 0.1;
  look.center_sigma_mm = 0.03;
  double square = 0.0;
  constexpr int kRuns = 16;
  for (int seed = 1; seed <= kRuns; ++seed) {
    scene.see(kDocked, 25, look, static_cast<std::uint64_t>(seed));
    const DockingFocal focal = found(scene, 1.0, 1);
    const double error = focal.focal_length_mm - scene.settings().camera.focal_length_mm;
    square += error * error / (focal.sigma_mm * focal.sigma_mm) / kRuns;
    EXPECT_LT(focal.sigma_mm, 0.03);
  }
  EXPECT_GT(square, 0.4);
  EXPECT_LT(square, 2.2);
}

TEST(DockingFocal, IsLeftOpenByACameraThatLooksSquare) {
  pose::PoseScene scene;
  tests::RimLook look;
  look.points = 32;
  look.noise_px = 0.1;
  look.center_sigma_mm = 0.03;
  scene.see(kDocked, 12, look);
  const double aslant = found(scene, 1.0, 1).sigma_mm;
  // The tool of these settings leans by 48 degrees before the camera; leaning so on the sheet, the
  // camera looks square at it.
  scene.see({762.0, 457.2, 0.0, 0.0, 0.0, 48.0}, 12, look);
  const double square = found(scene, 1.0, 1).sigma_mm;
  EXPECT_GT(square, 5.0 * aslant);
}

TEST(DockingFocal, OfSeveralDockingsIsTheirWeighedMean) {
  std::vector<DockingFocal> list(2);
  list[0] = {true, 5.00, 0.01, math::Vector6d::Zero()};
  list[1] = {true, 5.01, 0.02, math::Vector6d::Zero()};
  const DockingFocal both = combined_focal(list);
  EXPECT_NEAR(both.focal_length_mm, 5.002, 1e-12);
  EXPECT_NEAR(both.sigma_mm, 0.01 / std::sqrt(1.25), 1e-9);

  list[1].focal_length_mm = 5.2;  // they contradict each other: 200 = 8.94 sigma of the two
  const DockingFocal apart = combined_focal(list);
  EXPECT_NEAR(apart.sigma_mm / both.sigma_mm, 0.2 / std::hypot(0.01, 0.02), 1e-6);
}

TEST(DockingFocal, CarriesWhatIsWrongWithTheTypesOthers) {
  DockingFocal focal{true, 5.0, 0.01, math::Vector6d::Zero()};
  focal.by_camera(2) = 0.002;  // mm to the pixel of c_u
  math::Matrix6d type = math::Matrix6d::Zero();
  type(0, 0) = 99.0;
  type(2, 2) = 4.0;

  const math::Matrix6d covariance = camera_covariance(focal, type);

  EXPECT_NEAR(covariance(0, 0), 1e-4 + 16e-6, 1e-12);
  EXPECT_NEAR(covariance(0, 2), 0.008, 1e-12);
  EXPECT_NEAR(covariance(2, 0), 0.008, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 4.0, 1e-12);
}

TEST(DockingFocal, OfACameraThatMayBeTurnedCountsWhatNoTurnMakesUpFor) {
  const pose::PoseScene scene;
  const CameraSettings& settings = scene.settings().camera;
  CameraValues camera;
  camera << settings.focal_length_mm, settings.horizontal_scale, settings.center_px[0],
      settings.center_px[1], settings.distortion_per_mm2, settings.distortion2_per_mm4;
  const Sensor sensor = sensor_of(settings);
  math::Matrix6d centre = math::Matrix6d::Zero();
  centre(3, 3) = 4.0;  // 2 px: a turn of 0.2 degrees, and its bend at the picture's edge
  EXPECT_NEAR(map_uncertainty(sensor, camera, centre).rms_px, 2.3, 0.3);
  EXPECT_LT(map_beside_turn(sensor, camera, centre).rms_px, 0.6);

  math::Matrix6d focal = math::Matrix6d::Zero();
  focal(0, 0) = 1e-4;  // no turn makes a picture larger
  const double whole = map_uncertainty(sensor, camera, focal).rms_px;
  EXPECT_NEAR(map_beside_turn(sensor, camera, focal).rms_px, whole, 0.05 * whole);
}

TEST(DockingFocal, MovesTheTipByItsShareOfTheDistance) {
  DockingList dockings;
  Docking docking;
  docking.T_sheet_camera = {Eigen::Matrix3d::Identity(), {10.0, 20.0, -100.0}};
  docking.covariance = 1e-6 * math::Matrix6d::Identity();
  docking.tip_mm << 10.0, 20.0;
  ASSERT_TRUE(dockings.try_push_back(docking));
  const std::vector<math::Vector6d> by_focal = {
      (math::Vector6d() << 0.0, 0.0, -20.0, 0.0, 0.0, 0.0).finished()};

  const math::Vector6d slope = tool_by_focal(dockings, by_focal, {});

  EXPECT_NEAR(slope(2), 20.0, 1e-6);  // 20 mm farther by a millimetre of EFL
  EXPECT_NEAR(slope.head<2>().norm() + slope.tail<3>().norm(), 0.0, 1e-6);
}

TEST(FocalWalk, EndsWhereTheEflStays) {
  FocalWalk walk(5.0);
  DockingFocal found;
  found.sigma_mm = 0.01;
  found.focal_length_mm = 5.2;
  EXPECT_EQ(walk.take(found, 5.0), FocalWalk::Step::kGoOn);
  found.focal_length_mm = 5.2003;
  EXPECT_EQ(walk.take(found, 5.2), FocalWalk::Step::kSettled);
  found.focal_length_mm = 5.51;
  EXPECT_EQ(walk.take(found, 5.2), FocalWalk::Step::kElsewhere);
}

TEST(FocalWalk, TakesNoEflThatGoesOnMoving) {
  FocalWalk walk(5.0);
  DockingFocal found;
  found.sigma_mm = 0.01;
  for (int i = 1; i < FocalWalk::kMostSteps; ++i) {
    found.focal_length_mm = i % 2 == 0 ? 5.0 : 5.1;
    EXPECT_EQ(walk.take(found, i % 2 == 0 ? 5.1 : 5.0), FocalWalk::Step::kGoOn) << i;
  }
  EXPECT_EQ(walk.take(found, 5.05), FocalWalk::Step::kRestless);
}

TEST(FocalWalk, TakesOneThatTremblesWithinItsDeviation) {
  FocalWalk walk(5.0);
  DockingFocal found;
  found.sigma_mm = 0.01;
  for (int i = 1; i < FocalWalk::kMostSteps; ++i) {
    found.focal_length_mm = i % 2 == 0 ? 5.0 : 5.002;
    EXPECT_EQ(walk.take(found, i % 2 == 0 ? 5.002 : 5.0), FocalWalk::Step::kGoOn) << i;
  }
  found.focal_length_mm = 5.0;
  EXPECT_EQ(walk.take(found, 5.002), FocalWalk::Step::kSettled);
  EXPECT_NEAR(walk.change_mm(), 0.002, 1e-12);
}

}  // namespace
}  // namespace tubesight::core::calibration
