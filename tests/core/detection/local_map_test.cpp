#include "core/detection/local_map.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/detection/spot_weight.h"

namespace tubesight::core::detection {
namespace {

/// A map written by hand: strong perspective, as beside a wide-angle camera.
Eigen::Matrix3d known_map() {
  Eigen::Matrix3d map;
  map << 60.0, 12.0, 300.0, -8.0, 45.0, 200.0, 0.02, 0.06, 1.0;
  return map;
}

Eigen::Vector2d seen(const Eigen::Vector2d& index) {
  const Eigen::Vector3d p = known_map() * Eigen::Vector3d(index.x(), index.y(), 1.0);
  return p.head<2>() / p.z();
}

MapPoints points_around(int reach) {
  MapPoints points;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      EXPECT_TRUE(
          points.try_push_back({Eigen::Vector2d(column, row), seen(Eigen::Vector2d(column, row))}));
    }
  }
  return points;
}

TEST(LocalMap, MapsPlacesAsTheOneItWasFittedTo) {
  LocalMap map;
  ASSERT_TRUE(map.fit(points_around(2), {}));

  for (const Eigen::Vector2d& index :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(3.0, -1.0), Eigen::Vector2d(0.4, 2.7)}) {
    EXPECT_LT((map.to_pixel(index) - seen(index)).norm(), 0.02);
  }
  EXPECT_NEAR(map.shorter_step_px(), (seen({0.0, 1.0}) - seen({0.0, 0.0})).norm(), 0.02);
}

TEST(LocalMap, ExpectsTheEllipseThatTheCirclesPointsLieOn) {
  // Steps of 3 and 2.5 radii, 80 degrees apart: a circle of radius 1 in the plane.
  const Steps steps{{3.0, 0.0}, {2.5 * std::cos(1.396), 2.5 * std::sin(1.396)}};
  LocalMap map;
  ASSERT_TRUE(map.fit(points_around(2), {}));

  const Ellipse ellipse = map.element(steps);

  Eigen::Matrix2d basis;
  basis << steps.column, steps.row;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2d on_circle(std::cos(0.5 * i), std::sin(0.5 * i));
    const Eigen::Vector2d off = seen(basis.inverse() * on_circle) - ellipse.center_px;
    EXPECT_NEAR(off.dot(ellipse.shape_px2.inverse() * off), 1.0, 2e-3);
  }
  // Its own centre is not the image of the circle's: here by 0.4 px.
  EXPECT_GT((ellipse.center_px - seen({0.0, 0.0})).norm(), 0.2);
  EXPECT_LT((map.center_of(ellipse) - seen({0.0, 0.0})).norm(), 0.02);
}

TEST(LocalMap, RefusesPointsThatTellNoPlane) {
  LocalMap map;
  MapPoints line;
  for (int i = 0; i < 7; ++i) {
    EXPECT_TRUE(line.try_push_back({Eigen::Vector2d(i, 2 * i), Eigen::Vector2d(10 * i, 7 * i)}));
  }
  MapPoints few;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(
        few.try_push_back({Eigen::Vector2d(i % 2, i / 2), seen(Eigen::Vector2d(i % 2, i / 2))}));
  }

  EXPECT_FALSE(map.fit(line, {}));
  EXPECT_FALSE(map.fit(few, {}));
}

TEST(LensBend, StraightensABentLatticeAndBendsItAgain) {
  // Bent by hand towards the middle of a picture of 640 x 480, by a tenth at its corner.
  const Eigen::Vector2d middle(319.5, 239.5);
  const LensBend known(middle, 0.1 / middle.squaredNorm());
  std::array<IndexedPoint, 63> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d index(static_cast<double>(i % 9) - 4.0, static_cast<double>(i / 9) - 3.0);
    points[i] = {index, known.bent(middle + 75.0 * index)};
    EXPECT_LT((known.straight(points[i].place_px) - middle - 75.0 * index).norm(), 1e-3);
  }

  const LensBend found = find_bend(points, {640.0, 480.0});

  for (const IndexedPoint& point : points) {
    EXPECT_LT((found.straight(point.place_px) - known.straight(point.place_px)).norm(), 3.0);
  }
  LocalMap map;
  ASSERT_TRUE(map.fit(points, found));
  EXPECT_LT((map.to_pixel({4.0, 3.0}) - points[62].place_px).norm(), 0.2);
}

TEST(LensBend, FewElementsTellNone) {
  const MapPoints points = points_around(1);

  const LensBend found = find_bend(points, {640.0, 480.0});

  EXPECT_EQ(found.straight(Eigen::Vector2d(600.0, 20.0)), Eigen::Vector2d(600.0, 20.0));
}

TEST(SpotWeight, PlacesASmallSpotToAFractionOfAPixel) {
  // A disc of 3 px radius about (20.3, 15.8) by its share of each pixel, 8 x 8 samples.
  constexpr int kSide_px = 40;
  std::array<std::uint16_t, kSide_px * kSide_px> pixels{};
  for (int i = 0; i < kSide_px * kSide_px; ++i) {
    int hits = 0;
    for (int s = 0; s < 64; ++s) {
      const double u = i % kSide_px + (s % 8) / 8.0 - 0.4375 - 20.3;
      const double v = i / kSide_px + (s / 8) / 8.0 - 0.4375 - 15.8;
      hits += u * u + v * v <= 9.0 ? 1 : 0;
    }
    pixels[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(256 * (150 - 2 * hits));
  }
  Ellipse ellipse{{21.0, 15.0}, 7.0 * Eigen::Matrix2d::Identity()};
  Ellipse nothing{{8.0, 30.0}, 7.0 * Eigen::Matrix2d::Identity()};

  EXPECT_NEAR(weigh_spot({pixels.data(), kSide_px, kSide_px}, 6.0, ellipse), 128.0, 2.0);
  EXPECT_EQ(weigh_spot({pixels.data(), kSide_px, kSide_px}, 6.0, nothing), 0.0);
  Ellipse at_edge{{2.0, 30.0}, 7.0 * Eigen::Matrix2d::Identity()};
  EXPECT_EQ(weigh_spot({pixels.data(), kSide_px, kSide_px}, 6.0, at_edge), -1.0);

  EXPECT_NEAR(ellipse.center_px.x(), 20.3, 0.025);
  EXPECT_NEAR(ellipse.center_px.y(), 15.8, 0.025);
  EXPECT_NEAR(half_axes(ellipse).x(), 3.0, 0.15);
  EXPECT_EQ(nothing.center_px.x(), 8.0);
}

}  // namespace
}  // namespace tubesight::core::detection
