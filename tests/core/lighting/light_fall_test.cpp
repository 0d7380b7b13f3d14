#include "core/lighting/light_fall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/lighting/brightness_trail.h"
#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {
namespace {

/// Twelve tube-ends under a lamp that a test dims and lets fade. Sixty fields a second.
class FadingLamp : public testing::Test {
 protected:
  struct World {
    double lamp = 1.0;         ///< what is left of its light
    double level = 600.0;      ///< permille
    double other = 0.0;        ///< light, of that of the lamp at 600 permille
    double reflectance = 1.0;  ///< of tube-ends that come into view from now on
    double speed = 0.0;        ///< views a second; 0: the tool rests
    double tilt = 0.0;         ///< so much darker is a tube-end when it leaves than when it comes
    std::optional<std::int32_t> share_q10 = 1024;
  };

  /// Seconds until it says `wanted`; -1: it did not in that time. `change` is told the time.
  template <typename Change>
  double run_until(bool wanted, double longest_s, Change change) {
    for (int i = 0; i < static_cast<int>(longest_s * 60.0); ++i) {
      World world;
      change(i / 60.0, world);
      step(world);
      if (fall_.fallen() == wanted) {
        return (i + 1) / 60.0;
      }
    }
    return -1.0;
  }

  void step(const World& world) {
    constexpr double kSpan_s = 1.0 / 60.0;
    now_ += std::chrono::nanoseconds(16'666'667);
    shine_ += (world.level - shine_) * (kSpan_s / (kSpan_s + 0.2));
    TubeLightList lights;
    for (std::size_t i = 0; i < kTubes; ++i) {
      place_[i] += world.speed * kSpan_s;
      if (place_[i] > 1.0) {
        place_[i] -= 1.0;
        number_[i] += 12;
        reflectance_[i] = world.reflectance;
      }
      const double light = world.lamp * shine_ / 600.0 + world.other;
      const double seen = 1600.0 * light * reflectance_[i] * (1.0 - world.tilt * place_[i]);
      static_cast<void>(lights.try_push_back(
          {{0, number_[i]},
           static_cast<std::int32_t>(std::lround(seen * (1.0 + 0.003 * gauss_(random_))))}));
    }
    Field field;
    field.mid_exposure = now_;
    field.parity = (fields_++ % 2) != 0 ? Parity::kOdd : Parity::kEven;
    field.lamp_permille = static_cast<std::int32_t>(std::lround(world.level));
    fall_.follow(
        {&field, trail_.follow(field, lights), &lights, world.speed == 0.0, world.share_q10});
  }

  static constexpr std::size_t kTubes = 12;
  LightFall fall_;
  BrightnessTrail trail_;
  FieldTime now_{std::chrono::seconds(5)};
  double shine_ = 600.0;
  std::array<double, kTubes> place_ = {0.0,      1 / 12.0, 2 / 12.0,  3 / 12.0,
                                       4 / 12.0, 5 / 12.0, 6 / 12.0,  7 / 12.0,
                                       8 / 12.0, 9 / 12.0, 10 / 12.0, 11 / 12.0};
  std::array<std::int32_t, kTubes> number_ = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::array<double, kTubes> reflectance_ = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  int fields_ = 0;
  std::mt19937 random_{5};
  std::normal_distribution<double> gauss_;
};

/// To 5 % within 20 s: 30 % of the light are gone after 6.3 s, 40 % after 8.4 s.
double fade(double time_s) { return std::max(1.0 - 0.0475 * time_s, 0.05); }

TEST_F(FadingLamp, IsToldSoonAfterThirtyPercentAtRest) {
  ASSERT_LT(run_until(true, 5.0, [](double, World&) {}), 0.0);
  const double told_s = run_until(true, 20.0, [](double t, World& w) { w.lamp = fade(t); });
  EXPECT_GE(told_s, 6.3);
  EXPECT_LE(told_s, 6.3 + 2.0);
  EXPECT_GE(run_until(false, 3.0, [](double, World&) {}), 0.0) << "a new bulb";
}

TEST_F(FadingLamp, IsToldWhileItsLevelIsLedUp) {
  // As the level control does: the picture stays as bright as it was.
  ASSERT_LT(run_until(true, 5.0, [](double, World& w) { w.level = 400.0; }), 0.0);
  const double told_s = run_until(true, 20.0, [](double t, World& w) {
    w.lamp = fade(t);
    w.level = std::min(400.0 / w.lamp, 1000.0);
  });
  EXPECT_GE(told_s, 6.3);
  EXPECT_LE(told_s, 6.3 + 2.0);
}

TEST_F(FadingLamp, IsToldBesideOtherLight) {
  ASSERT_LT(run_until(true, 5.0, [](double, World& w) { w.other = 0.5; }), 0.0);
  const double told_s = run_until(true, 20.0, [](double t, World& w) {
    w.lamp = fade(t);
    w.other = 0.5;
    w.share_q10 = 683;
  });
  EXPECT_GE(told_s, 6.0);
  EXPECT_LE(told_s, 6.3 + 2.0);
}

TEST_F(FadingLamp, IsToldWithinTenSecondsMoving) {
  ASSERT_LT(run_until(true, 20.0, [](double, World& w) { w.speed = 0.5; }), 0.0);
  const double told_s = run_until(true, 20.0, [](double t, World& w) {
    w.lamp = fade(t);
    w.speed = 0.5;
  });
  EXPECT_GE(told_s, 8.4);
  EXPECT_LE(told_s, 6.3 + 10.0);
}

TEST_F(FadingLamp, IsNoDarkerPartOfTheSheet) {
  EXPECT_LT(run_until(true, 60.0,
                      [](double t, World& w) {
                        w.speed = 0.5;
                        w.reflectance = std::fmod(t, 20.0) < 10.0 ? 1.0 : 0.3;
                      }),
            0.0);
}

TEST_F(FadingLamp, IsNoTiltedLightOnTheWay) {
  // Each tube-end loses half of its light on its way through the picture.
  EXPECT_LT(run_until(true, 120.0,
                      [](double, World& w) {
                        w.speed = 0.5;
                        w.tilt = 0.5;
                      }),
            0.0);
}

// By more than 9.5 h a product of light and time would not fit any more.
TEST_F(FadingLamp, StaysFallenWhereTheClockRunsBack) {
  now_ += std::chrono::hours(30);
  ASSERT_LT(run_until(true, 5.0, [](double, World&) {}), 0.0);
  ASSERT_GE(run_until(true, 20.0, [](double t, World& w) { w.lamp = fade(t); }), 0.0);
  now_ -= std::chrono::hours(25);
  step({.lamp = 1.3});
  EXPECT_TRUE(fall_.fallen());
  EXPECT_LT(run_until(false, 3.0, [](double, World& w) { w.lamp = 0.05; }), 0.0);
  EXPECT_GE(run_until(false, 3.0, [](double, World&) {}), 0.0) << "a new bulb";
}

TEST_F(FadingLamp, IsNoLevelThatSomebodyCommands) {
  const auto commanded = [](double t, World& w) {
    w.level = std::fmod(t, 20.0) < 10.0 ? 200.0 : 1000.0;
    // A camera that shows the root of the light.
    w.other = 0.0;
    w.share_q10 = 512;
    w.lamp = std::sqrt(600.0 / w.level);
  };
  EXPECT_LT(run_until(true, 60.0, commanded), 0.0);
}

}  // namespace
}  // namespace tubesight::core::lighting
