#include "core/tracking/tool_point.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class ToolPointOf : public ::testing::Test {
 protected:
  using U = Unit<S>;
  using M = Mm<S>;

  // N = (0, 0.6, 0.8), the tip T = (10, 20, 50).
  ToolPointOf() {
    model_.virtual_plane = camera::VirtualPlane<S>({U(1), U(0), U(0)}, {U(0), U(0.8), U(-0.6)},
                                                   {U(0), U(0.6), U(0.8)});
    model_.tip_mm = {M(10), M(20), M(50)};
  }

  // A sheet through P = (30, 0, 175) whose normal is (0, n1, n2).
  static SheetPose<S> sheet(double n1, double n2) {
    SheetPose<S> pose;
    pose.x_axis = {U(1), U(0), U(0)};
    pose.y_axis = {U(0), U(n2), U(-n1)};
    pose.normal = {U(0), U(n1), U(n2)};
    pose.origin = {M(30), M(0), M(175)};
    return pose;
  }

  TrackingModel<S> model_{};
};
TYPED_TEST_SUITE(ToolPointOf, Scalars);

TYPED_TEST(ToolPointOf, IsThatOfTheSourcesEquationsOnALevelSheet) {
  // Eq. 6.19: Z_o = (0.45 * 50 - 0.6 * 20 + 0.6 * 0 + 0.8 * 175) / (0.45 + 0.8) = 120.4;
  // Eq. 6.20: X_o = 10; Eq. 6.21: Y_o = 0.75 (120.4 - 50) + 20 = 72.8.
  const auto tool = find_tool_point<TypeParam>(this->model_, this->sheet(0.6, 0.8));

  ASSERT_TRUE(tool.has_value());
  const double near = bound<TypeParam>(1e-9, 5e-5, 5e-6);
  EXPECT_NEAR(number(tool->point.x), 10.0, near);
  EXPECT_NEAR(number(tool->point.y), 72.8, near);
  EXPECT_NEAR(number(tool->point.z), 120.4, near);
  // N (P - T) = 0.6 (-20) + 0.8 * 125.
  EXPECT_NEAR(number(tool->height_mm), 88.0, near);
  // From P: (-20, 72.8, -54.6), along y (0, 0.8, -0.6): 58.24 + 32.76.
  EXPECT_NEAR(number(tool->local.x), -20.0, near);
  EXPECT_NEAR(number(tool->local.y), 91.0, near);
}

TYPED_TEST(ToolPointOf, IsWhereTheAxisMeetsALeaningSheet) {
  // Normal n = (0, 0.8, 0.6), 16.3 degrees off. n (P - T) = -16 + 75 = 59; n N = 0.96;
  // T + 59 / 0.96 N = (10, 56.875, 99.16667); from P (-20, 56.875, -75.83333), along y
  // (0, 0.6, -0.8): 34.125 + 60.66667.
  const auto tool = find_tool_point<TypeParam>(this->model_, this->sheet(0.8, 0.6));

  ASSERT_TRUE(tool.has_value());
  const double near = bound<TypeParam>(1e-9, 5e-5, 5e-6);
  EXPECT_NEAR(number(tool->point.x), 10.0, near);
  EXPECT_NEAR(number(tool->point.y), 56.875, near);
  EXPECT_NEAR(number(tool->point.z), 99.1666666666667, near);
  EXPECT_NEAR(number(tool->height_mm), 59.0, near);
  EXPECT_NEAR(number(tool->local.x), -20.0, near);
  EXPECT_NEAR(number(tool->local.y), 94.7916666666667, near);
}

TYPED_TEST(ToolPointOf, IsRefusedBeyond25Degrees) {
  // n N = -0.28 * 0.6 + 0.96 * 0.8 = 0.6: 53 degrees.
  EXPECT_FALSE(find_tool_point<TypeParam>(this->model_, this->sheet(-0.28, 0.96)).has_value());
}

TYPED_TEST(ToolPointOf, IsTheTruePointAtEveryHeightHeadingAndLean) {
  Scene<TypeParam> scene;
  scene.make();
  const SyntheticSheet sheet(*scene.settings);
  for (const double height : {-5.0, 0.0, 30.0, 90.0}) {
    for (const double alpha : {0.0, 90.0, -137.0}) {
      for (const double lean : {-1.0, 0.0, 1.0}) {
        const ToolPlace place{250.0, 512.0, height, alpha, lean, -lean / 2.0};
        const auto pose = pose_at<TypeParam>(*scene.settings, sheet, place, kTube);

        const auto tool = find_tool_point<TypeParam>(scene.model, pose);

        ASSERT_TRUE(tool.has_value());
        const auto axis = sheet.axis_point(place);
        const auto center = sheet.center_of(kTube);
        EXPECT_LT(distance(tool->local, {axis[0] - center[0], axis[1] - center[1]}),
                  bound<TypeParam>(1e-9, 1e-4, 1e-5));
        EXPECT_NEAR(number(tool->height_mm), height, bound<TypeParam>(1e-9, 1e-4, 1e-5));
      }
    }
  }
}

TYPED_TEST(ToolPointOf, IsAsUncertainAsTurnAndShiftMakeIt) {
  // Variances of 1/4 for each turn (in (1/128 rad)^2) and 1/16 mm^2 for each shift. The point lies
  // (30, 40, 0) from the anchor: along x (40/128)^2 / 4 + 1/16 = 0.0869141, along y
  // (30/128)^2 / 4 + 1/16 = 0.0762329; sqrt(0.1631470) * 205/1024 = 0.0808617.
  using Axis = Unit<TypeParam>;
  using Length = Mm<TypeParam>;
  NormalEquations<TypeParam> equations;
  equations.clear();
  for (std::size_t i = 0; i < 6; ++i) {
    PoseVector<TypeParam> row{};
    row[i] = Length(1);
    equations.add(row, Length(0), Length(i < 3 ? 4 : 16));
  }
  ASSERT_TRUE(equations.factor());
  SheetPose<TypeParam> pose;
  pose.x_axis = {Axis(1), Axis(0), Axis(0)};
  pose.y_axis = {Axis(0), Axis(1), Axis(0)};
  pose.normal = {Axis(0), Axis(0), Axis(1)};
  pose.origin = {Length(5), Length(6), Length(100)};
  ToolPoint<TypeParam> tool;
  tool.point = {Length(35), Length(46), Length(100)};

  EXPECT_NEAR(number(tool_point_deviation<TypeParam>(pose, tool, equations)), 0.0808617, 2e-6);
}

}  // namespace
}  // namespace tubesight::core::tracking
