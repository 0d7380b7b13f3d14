#include "core/rendering/tube_ends.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::rendering {
namespace {

std::unique_ptr<Scene> square_scene() {
  auto scene = std::make_unique<Scene>();
  scene->sheet.origin_mm = {5.0, -3.0};
  scene->sheet.row_step_mm = {0.0, 20.0};
  scene->sheet.column_step_mm = {20.0, 0.0};
  scene->sheet.bore_mm = 14.0;
  scene->sheet.rows = {0, 99};
  scene->sheet.columns = {0, 99};
  return scene;
}

TEST(TubeEndsAt, NamesWhatStandsThere) {
  auto scene = square_scene();
  ASSERT_TRUE(scene->sheet.missing.try_push_back({2, 3}));
  ASSERT_TRUE(scene->sheet.plugged.try_push_back({4, 4}));
  ASSERT_TRUE(scene->plugs.try_push_back({{9, 1}, PlugKind::kFlush}));
  ASSERT_TRUE(scene->plugs.try_push_back({{4, 4}, PlugKind::kRolled}));
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());

  EXPECT_EQ(ends->at({2, 2}).kind, TubeEndKind::kOpen);
  EXPECT_EQ(ends->at({2, 3}).kind, TubeEndKind::kVoid);
  EXPECT_EQ(ends->at({4, 4}).kind, TubeEndKind::kPlugRolled);
  EXPECT_EQ(ends->at({9, 1}).kind, TubeEndKind::kPlugFlush);
  EXPECT_EQ(ends->at({-1, 0}).kind, TubeEndKind::kVoid);
  EXPECT_EQ(ends->at({0, 100}).kind, TubeEndKind::kVoid);
}

TEST(TubeEndsAt, PlacesTubesByTheLatticeAndDisplacesThem) {
  auto scene = square_scene();
  ASSERT_TRUE(scene->displaced.try_push_back({{7, 8}, {0.5, -0.25, 0.1}}));
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());

  EXPECT_EQ(ends->at({7, 9}).center_mm, (std::array<double, 3>{185.0, 137.0, 0.0}));
  EXPECT_EQ(ends->at({7, 8}).center_mm, (std::array<double, 3>{165.5, 136.75, 0.1}));
}

TEST(TubeEndsAt, SpreadsDiametersAsAsked) {
  auto scene = square_scene();
  scene->look.bore_spread_mm = 0.06;
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());
  double sum = 0.0;
  double sum2 = 0.0;
  for (std::int32_t row = 0; row < 100; ++row) {
    for (std::int32_t column = 0; column < 100; ++column) {
      const double off = 2.0 * ends->at({row, column}).radius_mm - 14.0;
      sum += off;
      sum2 += off * off;
    }
  }

  // 10,000 tubes: mean within 4 sigma / 100, sigma within 4 / sqrt(20,000) of itself.
  EXPECT_NEAR(sum / 1e4, 0.0, 0.0024);
  EXPECT_NEAR(std::sqrt(sum2 / 1e4), 0.06, 0.0017);
}

TEST(TubeEndsAt, IsAFunctionOfTheSeed) {
  auto scene = square_scene();
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());
  const double radius = ends->at({5, 6}).radius_mm;
  ASSERT_TRUE(ends->configure(*scene).has_value());
  EXPECT_EQ(ends->at({5, 6}).radius_mm, radius);

  scene->seed = 2;
  ASSERT_TRUE(ends->configure(*scene).has_value());
  EXPECT_NE(ends->at({5, 6}).radius_mm, radius);
}

TEST(TubeEndsNearest, FindsTheAddressOfAnObliqueLattice) {
  auto scene = square_scene();
  scene->sheet.origin_mm = {0.0, 0.0};
  scene->sheet.row_step_mm = {10.0, 17.320508};  // triangles of 20 mm
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());

  // Tube (3, 2): (30 + 40, 51.961524); 4 mm right of it and 3 mm above.
  const NearestTube near = ends->nearest({74.0, 54.961524});

  EXPECT_EQ(near.address, (TubeAddress{3, 2}));
  EXPECT_NEAR(near.off_mm[0], 4.0, 1e-9);
  EXPECT_NEAR(near.off_mm[1], 3.0, 1e-9);
  EXPECT_NEAR(near.offset_mm, 5.0, 1e-9);
}

TEST(TubeEndsNearest, LeavesOutTheAddressesThatTheParityLeavesOut) {
  auto scene = square_scene();
  scene->sheet.addresses = AddressParity::kEvenSum;
  const auto ends = std::make_unique<TubeEnds>();
  ASSERT_TRUE(ends->configure(*scene).has_value());

  // At the place of (3, 4), 1 mm towards (3, 5).
  EXPECT_EQ(ends->nearest({5.0 + 81.0, -3.0 + 60.0}).address, (TubeAddress{3, 5}));
  EXPECT_EQ(ends->at({3, 4}).kind, TubeEndKind::kVoid);
}

TEST(TubeEndsConfigure, RefusesParallelStepsAndNoBore) {
  auto scene = square_scene();
  scene->sheet.row_step_mm = {20.0, 0.1};
  const auto ends = std::make_unique<TubeEnds>();
  EXPECT_FALSE(ends->configure(*scene).has_value());
  scene = square_scene();
  scene->sheet.bore_mm = 0.0;
  EXPECT_FALSE(ends->configure(*scene).has_value());
}

}  // namespace
}  // namespace tubesight::core::rendering
