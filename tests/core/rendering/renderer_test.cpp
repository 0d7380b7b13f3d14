#include "core/rendering/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/drawn_sheet.h"
#include "tests/support/heap_guard.h"

namespace tubesight::core::rendering {
namespace {

using tests::DrawnSheet;
using Picture = std::vector<std::uint8_t>;

class Drawn : public ::testing::Test {
 protected:
  /// Mean level of a square of `half` pixels around a point of the sheet.
  double level_at(const Picture& picture, const Exposure& exposure,
                  const std::array<double, 3>& sheet_mm, int half = 1) const {
    const auto pixel = sheet_.truth().image_of(exposure.opened, sheet_mm, exposure.knock);
    EXPECT_TRUE(pixel.has_value());
    return mean_around(picture, static_cast<int>(std::lround((*pixel)[0])),
                       static_cast<int>(std::lround((*pixel)[1])), half);
  }
  double mean_around(const Picture& picture, int u, int v, int half) const {
    double sum = 0.0;
    for (int y = v - half; y <= v + half; ++y) {
      for (int x = u - half; x <= u + half; ++x) {
        sum += picture[static_cast<std::size_t>(y * 635 + x)];
      }
    }
    return sum / ((2 * half + 1) * (2 * half + 1));
  }
  std::array<double, 3> center(TubeAddress address) const {
    return sheet_.truth().tube_ends().at(address).center_mm;
  }
  /// Halfway between four tubes: plate.
  std::array<double, 3> plate(TubeAddress address) const {
    const std::array<double, 3> at = center(address);
    return {at[0] + 12.7, at[1] + 12.7, 0.0};
  }

  mutable DrawnSheet sheet_;
};

TEST_F(Drawn, PlateIsBrightAndBoresAreDark) {
  const Exposure exposure = sheet_.exposure();

  const Picture picture = sheet_.draw(exposure);

  EXPECT_GT(level_at(picture, exposure, plate({39, 60})), 120.0);
  EXPECT_LT(level_at(picture, exposure, center({39, 60})), 25.0);
  EXPECT_LT(level_at(picture, exposure, center({40, 61})), 25.0);
}

TEST_F(Drawn, SameSeedGivesTheSameBytes) {
  const Exposure exposure = sheet_.exposure(1.0, 0.5);
  const Picture first = sheet_.draw(exposure);
  EXPECT_NE(sheet_.draw(sheet_.exposure(20.0)), first);

  EXPECT_EQ(sheet_.draw(exposure), first);

  DrawnSheet other;
  EXPECT_EQ(other.draw(exposure), first);
  Exposure noisy = exposure;
  noisy.noise_seed = 1;
  EXPECT_NE(sheet_.draw(noisy), first);
}

TEST_F(Drawn, LinesOfTheOtherFieldAreLeft) {
  for (const Parity parity : {Parity::kEven, Parity::kOdd}) {
    Exposure exposure = sheet_.exposure();
    exposure.offset = 30.0;  // nothing drawn is 1
    exposure.parity = parity;
    Picture picture = sheet_.picture(1);

    sheet_.renderer().render(exposure, sheet_.view(picture));

    for (int v = 0; v < 480; ++v) {
      const bool own = (v % 2 == 1) == (parity == Parity::kOdd);
      EXPECT_EQ(picture[static_cast<std::size_t>(v * 635 + 300)] != 1, own) << v;
    }
  }
}

TEST_F(Drawn, FieldsShowWhatTheWholeFrameShows) {
  Exposure exposure = sheet_.exposure();
  const Picture whole = sheet_.draw(exposure);
  Picture fields = sheet_.picture();

  for (const Parity parity : {Parity::kEven, Parity::kOdd}) {
    exposure.parity = parity;
    sheet_.renderer().render(exposure, sheet_.view(fields));
  }

  EXPECT_EQ(fields, whole);
}

TEST_F(Drawn, WindowShowsWhatTheWholeShowsAndLeavesTheRest) {
  for (const double way : {0.0, 2.0}) {
    Exposure exposure = sheet_.exposure(5.0, way);
    const Picture whole = sheet_.draw(exposure);
    exposure.window = {101, 57, 498, 222};
    Picture picture = sheet_.picture(77);

    sheet_.renderer().render(exposure, sheet_.view(picture));

    int wrong = 0;
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 635; ++u) {
        const auto i = static_cast<std::size_t>(v * 635 + u);
        const bool inside = u >= 101 && u <= 498 && v >= 57 && v <= 222;
        wrong += picture[i] == (inside ? whole[i] : 77) ? 0 : 1;
      }
    }
    EXPECT_EQ(wrong, 0) << way;
  }
}

TEST_F(Drawn, WithoutLightOnlyTheBlackLevelIsLeft) {
  tests::make_plain(sheet_.scene());
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  exposure.lamp = 0.0;

  const Picture picture = sheet_.draw(exposure);

  EXPECT_EQ(*std::min_element(picture.begin(), picture.end()), 7);
  EXPECT_EQ(*std::max_element(picture.begin(), picture.end()), 7);
}

TEST_F(Drawn, CameraLedsLightPlateAndWalls) {
  tests::make_plain(sheet_.scene());  // no noise, black walls
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  exposure.lamp = 0.0;
  exposure.ring = 1.0;
  // The wall that the camera sees, behind the upper half of the bore's image, is lit.
  std::array<double, 3> upper = center({39, 60});
  upper[1] -= 4.0;

  const Picture black = sheet_.draw(exposure);
  sheet_.scene().look.wall = 0.05;
  ASSERT_TRUE(sheet_.configure());
  const Picture grey = sheet_.draw(exposure);

  EXPECT_GT(level_at(black, exposure, plate({39, 60})), 12.0);
  EXPECT_GT(level_at(grey, exposure, upper), level_at(black, exposure, upper) + 2.0);
}

TEST_F(Drawn, LightFollowsTheLampsLevel) {
  Exposure exposure = sheet_.exposure();
  const std::array<double, 3> at = plate({39, 58});
  const double full = level_at(sheet_.draw(exposure), exposure, at, 3) - 7.0;
  exposure.lamp = 0.5;

  const double half = level_at(sheet_.draw(exposure), exposure, at, 3) - 7.0;

  EXPECT_NEAR(half, 0.5 * full, 1.0);
}

TEST_F(Drawn, DeadLampsDarkenTheirSide) {
  Exposure exposure = sheet_.exposure();
  const std::array<double, 3> right = plate({40, 63});  // along the tool's x, lamp 0
  const std::array<double, 3> left = plate({40, 56});
  const Picture all = sheet_.draw(exposure);
  exposure.dead_lamps = 0b1000'0000'0011;  // lamps 11, 0 and 1

  const Picture some = sheet_.draw(exposure);

  const double right_left = level_at(some, exposure, right, 3) / level_at(all, exposure, right, 3);
  const double left_left = level_at(some, exposure, left, 3) / level_at(all, exposure, left, 3);
  EXPECT_LT(right_left, 0.75);
  EXPECT_GT(left_left, right_left + 0.1);
}

TEST_F(Drawn, BrightLightSaturatesAndBlooms) {
  tests::make_plain(sheet_.scene());
  sheet_.scene().lamp.strength = 6.0;
  ASSERT_TRUE(sheet_.configure());
  const Exposure exposure = sheet_.exposure();
  const std::array<double, 3> bore = center({39, 60});

  const Picture plain = sheet_.draw(exposure);
  EXPECT_EQ(level_at(plain, exposure, plate({39, 60})), 255.0);
  sheet_.scene().sensor.blooming = 0.2;
  ASSERT_TRUE(sheet_.configure());
  const Picture bloomed = sheet_.draw(exposure);

  EXPECT_GT(level_at(bloomed, exposure, bore), level_at(plain, exposure, bore) + 10.0);
}

TEST_F(Drawn, PlugsAndVoidsStandWhereTheyAreTold) {
  tests::make_plain(sheet_.scene());
  ASSERT_TRUE(sheet_.scene().plugs.try_push_back({{39, 59}, PlugKind::kFlush}));
  ASSERT_TRUE(sheet_.scene().plugs.try_push_back({{39, 61}, PlugKind::kRolled}));
  ASSERT_TRUE(sheet_.scene().sheet.missing.try_push_back({40, 58}));
  ASSERT_TRUE(sheet_.configure());
  const Exposure exposure = sheet_.exposure();

  const Picture picture = sheet_.draw(exposure);

  EXPECT_GT(level_at(picture, exposure, center({39, 59})), 100.0);
  EXPECT_GT(level_at(picture, exposure, center({40, 58})), 100.0);
  // The rolled plug's face stands out by 4.5 mm around a dark hole.
  std::array<double, 3> hole = center({39, 61});
  hole[2] = -4.5;
  std::array<double, 3> face = hole;
  face[0] += 0.8 * 9.3;
  EXPECT_LT(level_at(picture, exposure, hole), 30.0);
  EXPECT_GT(level_at(picture, exposure, face), 100.0);
  EXPECT_LT(level_at(picture, exposure, center({40, 59})), 30.0);
}

TEST_F(Drawn, FilletWeldsHaveABrightRimAndShadowOutside) {
  tests::make_plain(sheet_.scene());
  sheet_.scene().sheet.weld = Weld::kFillet;
  ASSERT_TRUE(sheet_.configure());
  const Exposure exposure = sheet_.exposure();
  const TubeAddress tube{40, 62};

  const Picture picture = sheet_.draw(exposure);

  std::array<double, 3> rim = center(tube);
  rim[1] -= 9.3 + 0.6;  // the upper side in the picture, away from the guidetube
  const double bright = level_at(picture, exposure, rim, 0);
  EXPECT_LT(level_at(picture, exposure, center(tube)), 30.0);
  EXPECT_GT(bright, 100.0);
  rim[1] -= 2.2;
  EXPECT_LT(level_at(picture, exposure, rim, 0), 0.75 * bright);
}

TEST_F(Drawn, GuidetubeHidesWhatIsBehind) {
  tests::make_plain(sheet_.scene());
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  const Picture here = sheet_.draw(exposure);
  const Exposure other_exposure = sheet_.exposure(11.0);
  const Picture there = sheet_.draw(other_exposure);

  // The middle of the guidetube, 8 mm below its tip, towards the camera: the same wherever it is.
  const Eigen::Vector3d in_tool(0.0, -9.0, -8.0);
  const Eigen::Vector3d sheet = exposure.opened * in_tool;
  const std::array<double, 3> at{sheet.x(), sheet.y(), sheet.z()};
  const double level = level_at(here, exposure, at, 3);
  EXPECT_GT(level, 15.0);
  const auto pixel = sheet_.truth().image_of(exposure.opened, at);
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR(mean_around(there, static_cast<int>(std::lround((*pixel)[0])),
                          static_cast<int>(std::lround((*pixel)[1])), 3),
              level, 0.5);
}

TEST_F(Drawn, GuidetubeThrowsAShadow) {
  tests::make_plain(sheet_.scene());
  sheet_.scene().lamp.strength = 10.0;
  sheet_.scene().sensor.gain = 4.0;
  ASSERT_TRUE(sheet_.configure());
  Exposure exposure = sheet_.exposure();
  exposure.dead_lamps = 0xffe;  // lamp 0 alone, 35 mm along the tool's x and 50 mm below the tip
  const Picture picture = sheet_.draw(exposure);

  // Its light passes the axis after 35 / 124 of the way to 88.9 mm on the other side, below the
  // tip's height (50 / 110): 4 mm beside it on the way to 12.7 mm beside, 18 mm on the way to 63.5
  // mm.
  const double x = 60 * 25.4 - 88.9;
  const double shaded = level_at(picture, exposure, {x, 40 * 25.4 + 12.7, 0.0}, 1);
  const double lit = level_at(picture, exposure, {x, 40 * 25.4 + 63.5, 0.0}, 1);

  EXPECT_LT(shaded, 10.0);
  EXPECT_GT(lit, 30.0);
}

TEST_F(Drawn, MotionBlursEdgesAcrossAndNotAlong) {
  tests::make_plain(sheet_.scene());
  sheet_.scene().guidetube.radius_mm = 0.0;
  ASSERT_TRUE(sheet_.configure());
  const Picture rest = sheet_.draw(sheet_.exposure(1.5));
  const Picture moving = sheet_.draw(sheet_.exposure(0.0, 3.0));
  const auto steepest = [&](const Picture& picture, int du, int dv) {
    int most = 0;
    for (int v = 150; v < 240; ++v) {
      for (int u = 270; u < 350; ++u) {
        const int here = picture[static_cast<std::size_t>(v * 635 + u)];
        const int next = picture[static_cast<std::size_t>((v + dv) * 635 + u + du)];
        most = std::max(most, std::abs(next - here));
      }
    }
    return most;
  };

  // 3 mm are some 11 px across; the columns' direction is across, up to the heading of 2 degrees.
  EXPECT_LT(steepest(moving, 1, 0), 0.5 * steepest(rest, 1, 0));
  EXPECT_GT(steepest(moving, 0, 1), 0.8 * steepest(rest, 0, 1));
}

TEST_F(Drawn, BoronAndNicksChangeThePicture) {
  tests::make_plain(sheet_.scene());
  ASSERT_TRUE(sheet_.configure());
  const Picture clean = sheet_.draw(sheet_.exposure());
  sheet_.scene().look.boron = 1.0;
  ASSERT_TRUE(sheet_.configure());
  EXPECT_NE(sheet_.draw(sheet_.exposure()), clean);
  sheet_.scene().look.boron = 0.0;
  sheet_.scene().look.nicked = 1.0;
  ASSERT_TRUE(sheet_.configure());
  const Picture nicked = sheet_.draw(sheet_.exposure());

  // A nick is dark where there was plate, and nothing gets brighter.
  int darker = 0;
  int brighter = 0;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    darker += nicked[i] + 40 < clean[i] ? 1 : 0;
    brighter += nicked[i] > clean[i] + 2 ? 1 : 0;
  }
  EXPECT_GT(darker, 50);
  EXPECT_EQ(brighter, 0);
}

TEST_F(Drawn, StandsAnyPoseAndMotion) {
  for (int run = 0; run < 30; ++run) {
    const double a = 6.0 * run;
    Exposure exposure = sheet_.exposure(700.0 * std::sin(a), 30.0 * std::cos(3.0 * a));
    const Eigen::Vector3d at(1524.0 + 1600.0 * std::sin(a), 1016.0, -150.0 + 140.0 * std::cos(a));
    const Eigen::Matrix3d rotation =
        rotation_from_degrees({a, 40.0 * std::sin(2.0 * a), 3.0 * run});
    exposure.opened = {rotation, at};
    exposure.closed = {rotation, at + Eigen::Vector3d(2.0 * std::cos(a), 1.0, 0.0)};
    exposure.window = {run, run, 635 - 5 * run, 480};

    Picture picture = sheet_.picture(1);
    exposure.offset = 30.0;  // nothing drawn is 1

    sheet_.renderer().render(exposure, sheet_.view(picture));

    const auto& window = exposure.window;
    int wrong = 0;
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 635; ++u) {
        const bool inside =
            u >= window.left && u <= window.right && v >= window.top && v <= window.bottom;
        wrong += (picture[static_cast<std::size_t>(v * 635 + u)] != 1) == inside ? 0 : 1;
      }
    }
    EXPECT_EQ(wrong, 0) << "run " << run;
  }
}

TEST_F(Drawn, AsksForNoMemory) {
  Picture picture = sheet_.picture();
  const GreyImageView view = sheet_.view(picture);
  const Exposure exposure = sheet_.exposure(0.0, 1.0);
  tests::HeapCalls calls;
  {
    const tests::HeapGuard guard;
    static_cast<void>(sheet_.renderer().configure(sheet_.scene()));
    sheet_.renderer().render(exposure, view);
    calls = guard.calls();
  }
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

TEST(RendererConfigure, RefusesImpossibleScenes) {
  DrawnSheet sheet;
  sheet.scene().camera.width_px = kMaxPictureSide + 1;
  EXPECT_EQ(sheet.renderer().configure(sheet.scene()).error(), Error::kOutOfRange);
  sheet.scene().camera.width_px = 635;
  sheet.scene().sensor.blur_px = 0.0;
  EXPECT_EQ(sheet.renderer().configure(sheet.scene()).error(), Error::kInvalidArgument);
  sheet.scene().sensor.blur_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sheet.renderer().configure(sheet.scene()).error(), Error::kInvalidArgument);
}

TEST(PulsedLight, IsTheDutyOverWholePeriodsAndFlickersBelow) {
  EXPECT_NEAR(pulsed_light(0.25, 0.01, 0.003, 0.023), 0.25, 1e-12);
  // A quarter of each 10 ms is lit, from its start: of 0..5 ms it is half.
  EXPECT_NEAR(pulsed_light(0.25, 0.01, 0.0, 0.005), 0.5, 1e-12);
  EXPECT_NEAR(pulsed_light(0.25, 0.01, 0.004, 0.009), 0.0, 1e-12);
  EXPECT_EQ(pulsed_light(0.25, 0.0, 0.0, 1.0), 0.25);
}

}  // namespace
}  // namespace tubesight::core::rendering
