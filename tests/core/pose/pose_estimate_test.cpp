#include "core/pose/pose_estimate.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/pose/pose_test_support.h"
#include "tests/support/heap_guard.h"

namespace tubesight::core::pose {
namespace {

constexpr tests::ToolPlace kPlace{770.3, 455.1, 40.0, 33.0, 0.4, -0.7};
constexpr std::array<PoseMethod, 5> kMethods = {
    PoseMethod::kRims, PoseMethod::kCenters, PoseMethod::kTangentPoints, PoseMethod::kTangentLines,
    PoseMethod::kEllipseCenters};

math::Vector6d error_of(const PoseOutcome& outcome, const tests::ToolPlace& place = kPlace) {
  return pose_error(outcome.estimate.T_sheet_tool, true_pose(place));
}

TEST(EstimatePose, RecoversTheExactPoseFromExactRims) {
  PoseScene scene;
  for (const std::size_t tubes : {3U, 4U, 5U, 9U, 25U}) {
    scene.see(kPlace, tubes, {});

    const PoseOutcome outcome = scene.estimate();

    EXPECT_TRUE(outcome.has_value()) << static_cast<int>(outcome.refusal);
    EXPECT_LT(error_of(outcome).head<3>().norm(), 1e-5) << tubes;
    EXPECT_LT(error_of(outcome).tail<3>().norm(), 1e-7) << tubes;
    EXPECT_LT(outcome.estimate.rms_px, 1e-5);
  }
}

TEST(EstimatePose, RecoversItByEveryMethodButTheBiasedOne) {
  PoseScene scene;
  scene.see(kPlace, 25, {});
  for (const PoseMethod method : kMethods) {
    PoseOptions options;
    options.method = method;

    const PoseOutcome outcome = scene.estimate(options);

    EXPECT_TRUE(outcome.has_value()) << static_cast<int>(method);
    const double off = error_of(outcome).head<3>().norm();
    if (method == PoseMethod::kEllipseCenters) {
      EXPECT_GT(off, 0.1);
    } else {
      EXPECT_LT(off, 1e-5) << static_cast<int>(method);
    }
  }
}

TEST(EstimatePose, TellsEverythingAboutThePose) {
  PoseScene scene;
  scene.see(kPlace, 25, {.offset_px = -0.3});

  const PoseOutcome outcome = scene.estimate();

  ASSERT_TRUE(outcome.has_value());
  const PoseEstimate& estimate = outcome.estimate;
  const auto axis = scene.sheet().axis_point(kPlace);
  const TubeAddress nearest = scene.sheet().nearest(axis);
  const auto center = scene.sheet().center_of(nearest);
  EXPECT_EQ(estimate.nearest, nearest);
  EXPECT_NEAR(estimate.offset_mm, std::hypot(axis[0] - center[0], axis[1] - center[1]), 1e-3);
  EXPECT_EQ(estimate.tubes, scene.rims->size());
  ASSERT_EQ(outcome.rims.size(), scene.rims->size());
  for (const RimVerdict& rim : outcome.rims) {
    const auto image = scene.sheet().image_of(kPlace, rim.address);
    EXPECT_TRUE(rim.used);
    EXPECT_EQ(rim.points_used, 64);
    EXPECT_NEAR(rim.center_px[0], image[0], 0.01);
    EXPECT_NEAR(rim.center_px[1], image[1], 0.01);
  }
}

TEST(EstimatePose, TakesBloomingAndBoresOfTheirOwnInItsStride) {
  PoseScene scene;
  scene.see(kPlace, 25, {.offset_px = -0.4, .bore_sigma_mm = 0.1});

  const PoseOutcome outcome = scene.estimate();

  ASSERT_TRUE(outcome.has_value());
  EXPECT_LT(error_of(outcome).head<3>().norm(), 2e-3);
  EXPECT_LT(error_of(outcome).tail<3>().norm(), 2e-5);
  EXPECT_NEAR(outcome.estimate.edge_offset_px, -0.4, 0.1);
}

TEST(EstimatePose, WorksFromHalvesOfRims) {
  PoseScene scene;
  scene.see(kPlace, 25, {.points = 32, .noise_px = 0.1, .arc_deg = 180.0});

  const PoseOutcome outcome = scene.estimate();

  ASSERT_TRUE(outcome.has_value());
  EXPECT_LT(error_of(outcome).head<3>().norm(), 0.05);
}

TEST(EstimatePose, LeavesOutFalsePointsAndFalseRims) {
  PoseScene scene;
  scene.see(kPlace, 25, {.noise_px = 0.1, .outlier_share = 0.15}, 3);
  picture::Rim& plug = (*scene.rims)[4];  // a plug's rim: 1.5 px to the right of the bore's
  for (picture::RimPoint& point : plug.points) {
    point.u_px += 1.5;
  }

  const PoseOutcome outcome = scene.estimate();

  ASSERT_TRUE(outcome.has_value());
  EXPECT_LT(error_of(outcome).head<3>().norm(), 0.02);
  EXPECT_FALSE(outcome.rims[4].used);
  EXPECT_EQ(outcome.estimate.tubes, scene.rims->size() - 1);
}

TEST(EstimatePose, FindsPitchErrorsAndDoesNotTakeThemForOutliers) {
  PoseScene scene;
  scene.see(kPlace, 25, {.noise_px = 0.05, .center_sigma_mm = 0.1});

  const PoseOutcome outcome = scene.estimate();

  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome.estimate.tubes, scene.rims->size());
  EXPECT_NEAR(outcome.estimate.center_sigma_mm, 0.1, 0.03);
}

TEST(EstimatePose, GivesTheSameBitsAgain) {
  PoseScene scene;
  scene.see(kPlace, 25, {.noise_px = 0.1}, 8);
  const PoseOutcome once = scene.estimate();
  scene.see(kPlace, 9, {.noise_px = 0.1}, 9);
  static_cast<void>(scene.estimate());
  scene.see(kPlace, 25, {.noise_px = 0.1}, 8);

  const PoseOutcome again = scene.estimate();

  EXPECT_EQ(once.estimate.T_sheet_tool.translation_mm(),
            again.estimate.T_sheet_tool.translation_mm());
  EXPECT_EQ(once.estimate.T_sheet_tool.rotation(), again.estimate.T_sheet_tool.rotation());
  EXPECT_EQ(once.estimate.covariance, again.estimate.covariance);
}

TEST(EstimatePose, AsksForNoMemoryByAnyMethod) {
  PoseScene scene;
  scene.see(kPlace, 25, {.noise_px = 0.1, .outlier_share = 0.05});
  for (const PoseMethod method : kMethods) {
    PoseOptions options;
    options.method = method;
    const tests::HeapGuard guard;

    const PoseOutcome outcome = scene.estimate(options);

    const tests::HeapCalls calls = guard.calls();
    EXPECT_EQ(calls.allocations, 0);
    EXPECT_EQ(calls.releases, 0);
    EXPECT_TRUE(outcome.has_value());
  }
}

TEST(EstimatePose, FindsThePoseFromAnyThreeTubesThatSpanATriangle) {
  // Ellipses' centres, up to 4 px off, hide the true one of the solutions of three points where two
  // of these are close to each other.
  PoseScene scene;
  const auto near = tests::addresses_around(scene.sheet(), kPlace, 36);
  tests::Deviates deviates(77);
  const auto any = [&] {
    return near[static_cast<std::size_t>(deviates.uniform() * static_cast<double>(near.size()))];
  };
  int tried = 0;
  for (int i = 0; i < 300; ++i) {
    const TubeAddress a = any();
    const TubeAddress b = any();
    const TubeAddress c = any();
    scene.see(kPlace, {a, b, c}, {.noise_px = 0.1}, static_cast<std::uint64_t>(i));
    if (scene.rims->size() < 3 ||
        (b.row - a.row) * (c.column - a.column) == (b.column - a.column) * (c.row - a.row)) {
      continue;
    }
    ++tried;

    const PoseOutcome outcome = scene.estimate();

    EXPECT_TRUE(outcome.has_value()) << i << ": refused, " << static_cast<int>(outcome.refusal)
                                     << " (" << a.row << ", " << a.column << ") (" << b.row << ", "
                                     << b.column << ") (" << c.row << ", " << c.column << ')';
    const math::Vector6d error = pose_error(outcome.estimate.T_sheet_tool, true_pose(kPlace));
    EXPECT_LT(error.head<3>().norm(), 1.0) << i;
  }
  EXPECT_GT(tried, 100);
}

TEST(EstimatePose, RefusesTooFewTubes) {
  PoseScene scene;
  scene.see(kPlace, 2, {});
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kTooFewTubes);
  scene.rims->clear();
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kTooFewTubes);
  scene.see(kPlace, 5, {});
  PoseOptions options;
  options.min_tubes = 6;
  EXPECT_EQ(scene.estimate(options).refusal, PoseRefusal::kTooFewTubes);
}

TEST(EstimatePose, RefusesTubesOnALine) {
  PoseScene scene;
  const TubeAddress middle = scene.sheet().nearest(scene.sheet().axis_point(kPlace));
  std::vector<TubeAddress> row;
  for (int i = -1; i <= 1; ++i) {
    row.push_back({middle.row, middle.column + i});
  }
  scene.see(kPlace, row, {});
  ASSERT_EQ(scene.rims->size(), 3);

  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kCollinear);
}

TEST(EstimatePose, RefusesAddressesThatContradictThePicture) {
  PoseScene scene;
  scene.see(kPlace, 9, {});
  const picture::RimList right = *scene.rims;

  for (picture::Rim& rim : *scene.rims) {  // mirrored
    rim.address.column = -rim.address.column;
  }
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kAddressesContradict);

  *scene.rims = right;  // one tube a row off
  (*scene.rims)[5].address.row += 5;
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kAddressesContradict);

  *scene.rims = right;  // twice the pitch
  for (picture::Rim& rim : *scene.rims) {
    rim.address = {2 * rim.address.row, 2 * rim.address.column};
  }
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kAddressesContradict);

  *scene.rims = right;  // the same twice
  (*scene.rims)[1].address = (*scene.rims)[0].address;
  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kAddressesContradict);
}

TEST(EstimatePose, RefusesThreeAddressesThatContradictThePicture) {
  PoseScene scene;
  const TubeAddress middle = scene.sheet().nearest(scene.sheet().axis_point(kPlace));
  scene.see(kPlace, {middle, {middle.row + 1, middle.column}, {middle.row, middle.column + 1}}, {});
  ASSERT_EQ(scene.rims->size(), 3);
  ASSERT_TRUE(scene.estimate().has_value());

  std::swap((*scene.rims)[1].address, (*scene.rims)[2].address);
  const PoseRefusal mirrored = scene.estimate().refusal;
  std::swap((*scene.rims)[1].address, (*scene.rims)[2].address);
  (*scene.rims)[2].address.column += 1;
  const PoseRefusal stretched = scene.estimate().refusal;

  EXPECT_EQ(mirrored, PoseRefusal::kAddressesContradict);
  EXPECT_NE(stretched, PoseRefusal::kNone);
}

TEST(EstimatePose, RefusesRimsThatNoPoseExplains) {
  PoseScene scene;
  scene.see(kPlace, 9, {.noise_px = 1.5});

  const PoseRefusal refusal = scene.estimate().refusal;

  EXPECT_EQ(refusal, PoseRefusal::kResidualTooLarge);
}

TEST(EstimatePose, RefusesTwoPosesThatBothFit) {
  // From 30 times the distance the perspective is gone: leaning one way looks like the other.
  PoseScene scene;
  SessionSettings settings = scene.settings();
  settings.camera.focal_length_mm *= 30.0;
  settings.camera.distortion_per_mm2 = 0.0;
  settings.tool.position_mm = {0.0, 0.0, 4500.0};
  settings.tool.rotation_deg = {0.0, 0.0, 0.0};
  const tests::SyntheticSheet sheet(settings);
  const tests::ToolPlace place{762.0, 457.2, 40.0, 0.0, 12.0, 0.0};
  tests::Deviates deviates(5);
  const auto made = make_pose_model(settings.camera, settings.tool, settings.tubesheet);
  ASSERT_TRUE(made.has_value());
  scene.model = *made;
  tests::make_rims(sheet, settings, place, tests::addresses_around(sheet, place, 9),
                   {.noise_px = 0.3, .sigma_px = 0.3}, deviates, *scene.rims);
  ASSERT_EQ(scene.rims->size(), 9);

  EXPECT_EQ(scene.estimate().refusal, PoseRefusal::kAmbiguous);
}

}  // namespace
}  // namespace tubesight::core::pose
