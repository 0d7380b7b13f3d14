#include "core/calibration/tool_points.h"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/camera/camera_setup.h"
#include "tests/support/source_camera.h"

namespace tubesight::core::calibration {
namespace {

using CameraTool = Transform<frames::Camera, frames::Tool>;

/// The source's camera.
camera::CameraModel<double> the_camera() {
  const auto made = camera::make_camera_model<double>(tests::source_camera());
  EXPECT_TRUE(made.has_value());
  return *made;
}

const CameraTool kTool{rotation_from_degrees({-0.06, -0.8, 48.0}), {-3.0, 31.6, 112.8}};

/// On the half of the guidetube that the camera sees, and a collar below.
std::vector<Eigen::Vector3d> places_around() {
  std::vector<Eigen::Vector3d> places;
  for (const double z : {-2.0, -8.0, -14.0}) {
    for (const double angle : {-2.6, -2.0, -1.2, -0.6}) {
      places.emplace_back(9.1 * std::cos(angle), 9.1 * std::sin(angle), z);
    }
  }
  return places;
}

/// A plate on the camera's side of the guidetube, 12 mm from its axis.
std::vector<Eigen::Vector3d> places_on_plate() {
  std::vector<Eigen::Vector3d> places;
  for (const double z : {-1.0, -7.0, -14.0}) {
    for (const double x : {-20.0, -8.0, 7.0, 19.0}) {
      places.emplace_back(x, -12.0, z);
    }
  }
  return places;
}

ToolPointList seen(const std::vector<Eigen::Vector3d>& places, double noise_px,
                   std::uint64_t seed = 1) {
  const auto camera = the_camera();
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, noise_px > 0.0 ? noise_px : 1.0);
  ToolPointList list;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d p = kTool * place;
    const auto pixel = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
    EXPECT_TRUE(pixel.has_value());
    Eigen::Vector2d at(pixel->x, pixel->y);
    if (noise_px > 0.0) {
      at += Eigen::Vector2d(noise(engine), noise(engine));
    }
    EXPECT_TRUE(list.try_push_back({place, at}));
  }
  return list;
}

void expect_tool(const ToolCalibration& tool, double tip_mm, double turn) {
  EXPECT_LT((tool.T_camera_tool.translation_mm() - kTool.translation_mm()).norm(), tip_mm);
  EXPECT_LT((tool.T_camera_tool.rotation() - kTool.rotation()).norm(), turn);
}

TEST(ToolPoints, OfAnyShapeAreTheToolAsMounted) {
  const auto round = tool_from_points(the_camera(), seen(places_around(), 0.0));
  ASSERT_EQ(round.refusal, ToolPointsRefusal::kNone);
  EXPECT_FALSE(round.coplanar);
  EXPECT_EQ(round.used, 12);
  expect_tool(round.tool, 1e-4, 1e-5);

  const auto plate = tool_from_points(the_camera(), seen(places_on_plate(), 0.0));
  ASSERT_EQ(plate.refusal, ToolPointsRefusal::kNone);
  EXPECT_TRUE(plate.coplanar);
  expect_tool(plate.tool, 1e-4, 1e-5);
  EXPECT_NEAR(plate.tool.values(5), 48.0, 1e-3);
}

TEST(ToolPoints, PromiseTheErrorThatTheyHave) {
  double square = 0.0;
  int runs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto outcome = tool_from_points(the_camera(), seen(places_on_plate(), 0.1, seed));
    ASSERT_EQ(outcome.refusal, ToolPointsRefusal::kNone) << seed;
    math::Vector6d error = outcome.tool.values;
    error.head<3>() -= kTool.translation_mm();
    error.tail<3>() -= Eigen::Vector3d(-0.06, -0.8, 48.0);
    square += error.dot(outcome.tool.covariance.ldlt().solve(error));
    ++runs;
  }
  EXPECT_GT(square / (6.0 * runs), 0.7);
  EXPECT_LT(square / (6.0 * runs), 1.4);
}

TEST(ToolPoints, LeaveAWrongOneOutByName) {
  ToolPointList list = seen(places_around(), 0.05);
  list[4].seen_px.x() += 9.0;

  const auto outcome = tool_from_points(the_camera(), list);

  ASSERT_EQ(outcome.refusal, ToolPointsRefusal::kNone);
  EXPECT_EQ(outcome.used, 11);
  for (std::int32_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(outcome.points[i].used, i != 4) << i;
  }
  EXPECT_NEAR(outcome.points[4].off_px.x(), 9.0, 0.5);
  expect_tool(outcome.tool, 0.6, 0.01);
}

TEST(ToolPoints, LeaveOutAWrongOneThatBendsTheFit) {
  ToolPointList list = seen(places_around(), 0.0);
  list[7].seen_px.x() += 4.0;
  const auto outcome = tool_from_points(the_camera(), list);
  ASSERT_EQ(outcome.refusal, ToolPointsRefusal::kNone);
  EXPECT_FALSE(outcome.points[7].used);
  EXPECT_EQ(outcome.used, 11);
  expect_tool(outcome.tool, 1e-4, 1e-5);
}

ToolPointsRefusal refusal_of(std::vector<Eigen::Vector3d> places, const Eigen::Vector3d& factors) {
  ToolPointList list = seen(places, 0.05);
  for (ToolPoint& point : list) {
    point.place_mm = point.place_mm.cwiseProduct(factors);
  }
  return tool_from_points(the_camera(), list).refusal;
}

TEST(ToolPoints, AreRefusedWhenMirrored) {
  EXPECT_EQ(refusal_of(places_around(), {-1.0, 1.0, 1.0}), ToolPointsRefusal::kMirrored);
  EXPECT_EQ(refusal_of(places_around(), {1.0, 1.0, -1.0}), ToolPointsRefusal::kMirrored);
  // A plate's x mirrored is the plate seen through the guidetube; its z, one that points away.
  EXPECT_EQ(refusal_of(places_on_plate(), {-1.0, 1.0, 1.0}), ToolPointsRefusal::kMirrored);
  EXPECT_EQ(refusal_of(places_on_plate(), {1.0, 1.0, -1.0}), ToolPointsRefusal::kMirrored);
}

TEST(ToolPoints, AreRefusedWhereTheyTellNoPose) {
  const auto camera = the_camera();
  ToolPointList few = seen(places_around(), 0.0);
  few.truncate(5);
  EXPECT_EQ(tool_from_points(camera, few).refusal, ToolPointsRefusal::kTooFew);

  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 8; ++i) {
    line.emplace_back(0.0, -9.1, -2.0 * i);
  }
  EXPECT_EQ(tool_from_points(camera, seen(line, 0.0)).refusal, ToolPointsRefusal::kOneLine);

  ToolPointList shuffled = seen(places_around(), 0.0);
  for (std::int32_t i = 0; i + 1 < shuffled.size(); ++i) {
    std::swap(shuffled[i].seen_px, shuffled[(7 * i + 5) % shuffled.size()].seen_px);
  }
  EXPECT_NE(tool_from_points(camera, shuffled).refusal, ToolPointsRefusal::kNone);

  std::vector<Eigen::Vector3d> small;  // a plate of 2 mm far from the tip
  for (const Eigen::Vector3d& place : places_on_plate()) {
    small.emplace_back(0.05 * place.x(), -12.0, -14.0 + 0.05 * place.z());
  }
  const auto refusal = tool_from_points(camera, seen(small, 0.1)).refusal;
  EXPECT_TRUE(refusal == ToolPointsRefusal::kAmbiguous || refusal == ToolPointsRefusal::kUncertain);
}

}  // namespace
}  // namespace tubesight::core::calibration
