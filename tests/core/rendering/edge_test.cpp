// Where drawn edges are, against the outlines worked out here from the formulas of conventions.md.
//
// What surrounds an edge (light that falls off, grain) shifts the place of half the level. So each
// edge is seen by itself: a picture divided by the same with plate alone, or the difference of two
// that differ in the level of one part, is even on both sides of the edge.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/rendering/edge_meter.h"
#include "tests/support/drawn_sheet.h"

namespace tubesight::core::rendering {
namespace {

using tests::DrawnSheet;
using tests_of_edges::Beyond;
using tests_of_edges::EdgeErrors;
using tests_of_edges::EdgeLook;
using tests_of_edges::EdgeMeter;
using tests_of_edges::kNoEdge;
using tests_of_edges::Rays;
using Levels = std::vector<double>;

constexpr double kPitch_mm = 40.0;
constexpr double kRadius_mm = 9.3;
constexpr double kGap_mm = kPitch_mm / 2.0 - kRadius_mm;
constexpr std::array<std::int32_t, 2> kNowhere{-9000, -8990};
constexpr double kBellHalfWidth_sigma = 2.6457513;  // the bell's sigma is 1 / sqrt(7) of its half

class DrawnEdges : public ::testing::Test {
 protected:
  DrawnEdges() {
    tests::make_plain(sheet_.scene());
    scene().guidetube.radius_mm = 0.0;
    scene().sheet.row_step_mm = {0.0, kPitch_mm};  // room for everything between
    scene().sheet.column_step_mm = {kPitch_mm, 0.0};
    scene().sensor.vignetting = 0.0;
    // Bright to the corners, and nowhere near saturation.
    scene().lamp.below_tip_mm = 300.0;
    scene().lamp.beam = 0.0;
    scene().lamp.strength = 3.0;
  }

  Scene& scene() { return sheet_.scene(); }

  /// Turned by a quarter about its optical axis, as the campaign's turned cameras.
  void turn_camera() { scene().tool = {{-31.6, -3.0, 112.8}, {90.0, -0.8, 48.0}}; }

  /// 2 degrees of heading; `way_mm` along the direction that a lattice's moves go.
  Exposure exposure(double height_mm, double way_mm = 0.0) {
    Exposure made = sheet_.exposure(3.3, way_mm);
    made.opened = {made.opened.rotation(), {1527.3, 1016.9, -height_mm}};
    made.closed = {made.opened.rotation(),
                   {1527.3 + 0.8 * way_mm, 1016.9 + 0.6 * way_mm, -height_mm}};
    return made;
  }

  /// The mean of pictures whose black levels differ by parts of a grey level: what eight bits round
  /// is told again.
  Levels fine_picture(Exposure exposure) {
    EXPECT_TRUE(sheet_.configure());
    constexpr int kSteps = 16;
    Levels mean(sheet_.picture().size(), -scene().sensor.offset);
    for (int step = 0; step < kSteps; ++step) {
      exposure.offset = static_cast<double>(step) / kSteps;
      const std::vector<std::uint8_t> drawn = sheet_.draw(exposure);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] += (drawn[i] - exposure.offset) / kSteps;
      }
    }
    return mean;
  }

  /// The plate alone.
  Levels fine_plate(const Exposure& exposure) {
    const auto rows = scene().sheet.rows;
    const double radius_mm = scene().guidetube.radius_mm;
    scene().sheet.rows = kNowhere;
    scene().guidetube.radius_mm = 0.0;
    const Levels plate = fine_picture(exposure);
    scene().sheet.rows = rows;
    scene().guidetube.radius_mm = radius_mm;
    EXPECT_LT(*std::max_element(plate.begin(), plate.end()), 130.0);
    return plate;
  }

  Levels over_plate(const Exposure& exposure) {
    const Levels plate = fine_plate(exposure);
    Levels levels = fine_picture(exposure);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i] /= plate[i];
    }
    return levels;
  }

  /// What changes with a number of the look, over the plate.
  Levels change_over_plate(const Exposure& exposure, double SheetLook::*number, double from,
                           double to) {
    scene().look.*number = from;
    Levels levels = over_plate(exposure);
    scene().look.*number = to;
    const Levels other = over_plate(exposure);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i] = other[i] - levels[i];
    }
    return levels;
  }

  /// Circles of a radius around the lattice's points in the plane z, up to `reach_mm` from the
  /// tool: beyond, they are small, flat and in the dark.
  Beyond circles(const Exposure& exposure, double radius_mm, double z_mm = 0.0,
                 double reach_mm = 200.0) {
    const Rays opened(scene().camera, scene().tool, exposure.opened);
    const Eigen::Vector3d way = exposure.closed.translation_mm() - exposure.opened.translation_mm();
    return [=](double u, double v, double share) {
      std::array<double, 2> at = opened.on_sheet(u, v, z_mm);
      if (!(std::hypot(at[0] - 1524.0, at[1] - 1016.0) < reach_mm)) {
        return 2.0 * kNoEdge;
      }
      // The nearest tube in the middle of the exposure: the same at all instants.
      std::array<double, 2> off{};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double step = way(static_cast<Eigen::Index>(axis));
        const double middle = at[axis] + 0.5 * step;
        off[axis] = at[axis] + share * step - kPitch_mm * std::round(middle / kPitch_mm);
      }
      return std::hypot(off[0], off[1]) - radius_mm;
    };
  }

  void lay_fillets() {
    scene().sheet.weld = Weld::kFillet;
    scene().lamp.strength = 1.5;  // lands are 1.7 times as bright as the plate
  }

  void put_plugs(PlugKind kind) {
    for (std::int32_t row = 15; row <= 35; ++row) {
      for (std::int32_t column = 28; column <= 48; ++column) {
        ASSERT_TRUE(scene().plugs.try_push_back({{row, column}, kind}));
      }
    }
  }

  EdgeLook look(double inner_mm, double outer_mm, double motion_px = 0.0) {
    EdgeLook look;
    look.bell_px = kBellHalfWidth_sigma * scene().sensor.blur_px;
    look.inner_mm = inner_mm;
    look.outer_mm = outer_mm;
    look.motion_px = motion_px;
    return look;
  }

  /// Both ways; every edge must be found, `fewest` of them at least.
  void expect_right(const Levels& levels, const Beyond& beyond, const EdgeLook& how, int fewest,
                    double rms_px, double largest_px) {
    int count = 0;
    for (const bool along_columns : {false, true}) {
      const EdgeErrors found = EdgeMeter(levels, 635, 480, beyond, how).measure(along_columns);
      SCOPED_TRACE(along_columns ? "along columns" : "along lines");
      EXPECT_EQ(found.missed, 0);
      EXPECT_LT(found.rms_px(), rms_px);
      EXPECT_LT(found.largest_px, largest_px);
      count += found.count;
    }
    EXPECT_GT(count, fewest);
  }

  mutable DrawnSheet sheet_;
};

/// A kind of camera and picture.
struct Sight {
  const char* name;
  bool turned;  ///< by a quarter about the optical axis
  double height_mm;
  double blur_px;
};

class DrawnEdgesOf : public DrawnEdges, public ::testing::WithParamInterface<Sight> {
 protected:
  DrawnEdgesOf() {
    if (GetParam().turned) {
      turn_camera();
    }
    scene().sensor.blur_px = GetParam().blur_px;
  }
  double height_mm() const { return GetParam().height_mm; }
};

INSTANTIATE_TEST_SUITE_P(Sights, DrawnEdgesOf,
                         ::testing::Values(Sight{"NearSharp", false, 30.0, 0.5},
                                           Sight{"Turned", true, 60.0, 0.7},
                                           Sight{"FarSoft", false, 90.0, 1.1}),
                         [](const auto& sight) { return sight.param.name; });

TEST_P(DrawnEdgesOf, FlushBores) {
  const Exposure resting = exposure(height_mm());

  expect_right(over_plate(resting), circles(resting, kRadius_mm), look(kRadius_mm, kGap_mm), 300,
               0.002, 0.005);
}

TEST_P(DrawnEdgesOf, BoresInALitRing) {
  const Exposure resting = exposure(height_mm());
  scene().look.weld_mm = 3.0;
  scene().look.weld = 0.75;

  expect_right(over_plate(resting), circles(resting, kRadius_mm), look(kRadius_mm, 3.0), 150, 0.002,
               0.005);
}

TEST_P(DrawnEdgesOf, LitRingsOutside) {
  const Exposure resting = exposure(height_mm());
  scene().look.weld_mm = 3.0;

  // Many rings hardly differ from the plate: most of the error is that of the grey levels.
  expect_right(change_over_plate(resting, &SheetLook::weld, 0.45, 0.75),
               circles(resting, kRadius_mm + 3.0, 0.0, 120.0), look(3.0, kGap_mm - 3.0), 200, 0.008,
               0.04);
}

TEST_P(DrawnEdgesOf, FilletBores) {
  const Exposure resting = exposure(height_mm());
  lay_fillets();
  scene().look.land_mm = 3.0;

  expect_right(over_plate(resting), circles(resting, kRadius_mm), look(kRadius_mm, 3.0), 150, 0.003,
               0.008);
}

TEST_P(DrawnEdgesOf, RolledPlugs) {
  const Exposure resting = exposure(height_mm());
  put_plugs(PlugKind::kRolled);

  // The face, 4.5 mm nearer to the camera, is 6 % wider than the bore; its hole 40 % narrower.
  const Levels levels = change_over_plate(resting, &SheetLook::plug, 0.4, 0.6);
  expect_right(levels, circles(resting, 1.06 * kRadius_mm, -4.5),
               look(0.46 * kRadius_mm, kGap_mm - 0.06 * kRadius_mm), 150, 0.004, 0.015);
  expect_right(levels, circles(resting, 0.6 * kRadius_mm, -4.5),
               look(0.6 * kRadius_mm, 0.46 * kRadius_mm), 150, 0.006, 0.05);
}

TEST_P(DrawnEdgesOf, FlushPlugs) {
  const Exposure resting = exposure(height_mm());
  put_plugs(PlugKind::kFlush);

  // Bright within a dark outline of 0.3 mm.
  expect_right(change_over_plate(resting, &SheetLook::plug, 0.4, 0.6),
               circles(resting, kRadius_mm - 0.3), look(kRadius_mm - 0.3, kGap_mm), 150, 0.004,
               0.015);
}

TEST_P(DrawnEdgesOf, BoresThatMove) {
  struct Limits {
    double way_mm, middle_rms_px, middle_px, mean_rms_px, mean_px;
  };
  // 250 mm/s over 2 and over 8 ms. Where an edge is in the middle of the exposure is drawn right;
  // the mean of where it is, a curve that moves along itself, differs by way^2 / (24 radius), px.
  for (const Limits& most :
       {Limits{0.5, 0.005, 0.01, 0.005, 0.03}, {2.0, 0.005, 0.02, 0.09, 0.5}}) {
    SCOPED_TRACE(most.way_mm);
    const Exposure moving = exposure(height_mm(), most.way_mm);
    const Levels levels = over_plate(moving);
    EdgeLook how = look(kRadius_mm, kGap_mm, 5.0 * most.way_mm);
    expect_right(levels, circles(moving, kRadius_mm), how, 150, most.middle_rms_px, most.middle_px);
    how.instants = 24;
    expect_right(levels, circles(moving, kRadius_mm), how, 150, most.mean_rms_px, most.mean_px);
  }
}

TEST_P(DrawnEdgesOf, TheGuidetube) {
  const Exposure resting = exposure(height_mm());
  scene().guidetube = {9.1, 33.0, 0.0, 0.0};  // black, and without a shadow
  scene().sheet.rows = kNowhere;
  const Rays rays(scene().camera, scene().tool, resting.opened);
  const Eigen::Vector3d& eye = rays.eye_tool();
  const double from_axis = std::hypot(eye.x(), eye.y());
  // How near a ray passes the axis, where it does so below the tip.
  const Beyond sides = [&](double u, double v, double) {
    const Eigen::Vector3d way = rays.way_tool(u, v);
    const double across = std::hypot(way.x(), way.y());
    const double nearest = -(eye.x() * way.x() + eye.y() * way.y()) / (across * across);
    const double z = eye.z() + nearest * way.z();
    return z < -12.0 && z > -25.0 ? std::abs(eye.x() * way.y() - eye.y() * way.x()) / across - 9.1
                                  : 2.0 * kNoEdge;
  };
  // Its rim at the tip, in the part that is turned to the camera: rays beyond pass over it.
  const Beyond tip = [&](double u, double v, double) {
    const Eigen::Vector3d way = rays.way_tool(u, v);
    const double along = -eye.z() / way.z();
    const double x = eye.x() + along * way.x();
    const double y = eye.y() + along * way.y();
    return x * eye.x() + y * eye.y() > 6.0 * from_axis ? std::hypot(x, y) - 9.1 : 2.0 * kNoEdge;
  };

  const Levels levels = over_plate(resting);

  expect_right(levels, sides, look(9.1, 9.1), 10, 0.002, 0.005);
  expect_right(levels, tip, look(9.1, 9.1), 8, 0.002, 0.005);
}

TEST_F(DrawnEdges, AreNoticedWhenTheyAreAFiftiethOfAPixelOff) {
  const Exposure resting = exposure(60.0);
  const Exposure wrong = [&] {
    Exposure made = resting;
    made.opened = {made.opened.rotation(), {1527.3056, 1016.9, -60.0}};  // 0.02 px in the middle
    made.closed = made.opened;
    return made;
  }();

  const EdgeErrors found = EdgeMeter(over_plate(resting), 635, 480, circles(wrong, kRadius_mm),
                                     look(kRadius_mm, kGap_mm))
                               .measure(false);

  EXPECT_GT(found.largest_px, 0.015);
  EXPECT_LT(found.largest_px, 0.03);
}

}  // namespace
}  // namespace tubesight::core::rendering
