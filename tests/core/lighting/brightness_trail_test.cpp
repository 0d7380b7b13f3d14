#include "core/lighting/brightness_trail.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>

#include <gtest/gtest.h>

#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {
namespace {

Field field_at(int ms, Parity parity = Parity::kProgressive) {
  Field field;
  field.mid_exposure = std::chrono::milliseconds(ms);
  field.parity = parity;
  return field;
}

TubeLightList lights_of(std::initializer_list<TubeLight> lights) {
  TubeLightList list;
  for (const TubeLight& light : lights) {
    EXPECT_TRUE(list.try_push_back(light));
  }
  return list;
}

/// The mean of a change, so that it can be compared.
std::optional<std::int32_t> mean_q16(const std::optional<LightChange>& change) {
  return change ? std::optional(change->mean_q16) : std::nullopt;
}

TEST(BrightnessTrail, FollowsTheTubesThatAreInBoth) {
  BrightnessTrail trail;
  EXPECT_EQ(mean_q16(trail.follow(field_at(0), lights_of({{{1, 1}, 1000}, {{1, 2}, 2000}}))),
            std::nullopt);
  // (1, 2) left, (1, 3) came, and (1, 1) is brighter by 10 of 1000: 2 * 10 / 2010 in 1/65536.
  EXPECT_EQ(mean_q16(trail.follow(field_at(33), lights_of({{{1, 3}, 3000}, {{1, 1}, 1010}}))), 652);
  EXPECT_EQ(mean_q16(trail.follow(field_at(66), lights_of({{{7, 7}, 3000}}))), std::nullopt);
}

TEST(BrightnessTrail, ComparesFieldsOfTheSameLines) {
  BrightnessTrail trail;
  static_cast<void>(trail.follow(field_at(0, Parity::kEven), lights_of({{{1, 1}, 1000}})));
  EXPECT_EQ(mean_q16(trail.follow(field_at(17, Parity::kOdd), lights_of({{{1, 1}, 1200}}))),
            std::nullopt);
  EXPECT_EQ(mean_q16(trail.follow(field_at(33, Parity::kEven), lights_of({{{1, 1}, 1000}}))), 0);
  EXPECT_EQ(mean_q16(trail.follow(field_at(50, Parity::kOdd), lights_of({{{1, 1}, 1200}}))), 0);
}

TEST(BrightnessTrail, LeavesOutWhatGlaresOrIsFaint) {
  BrightnessTrail trail;
  static_cast<void>(
      trail.follow(field_at(0), lights_of({{{1, 1}, kGlaring_q4}, {{1, 2}, 1000}, {{1, 3}, 10}})));
  const auto change = trail.follow(
      field_at(33), lights_of({{{1, 1}, kGlaring_q4 + 90}, {{1, 2}, 1000}, {{1, 3}, 20}}));
  EXPECT_EQ(mean_q16(change), 0);
}

TEST(BrightnessTrail, TellsScatterFromCommonChange) {
  BrightnessTrail trail;
  static_cast<void>(trail.follow(field_at(0), lights_of({{{1, 1}, 1000}, {{1, 2}, 2000}})));
  // All by a tenth: nothing is apart, but for the ratio's rounding.
  const auto common = trail.follow(field_at(33), lights_of({{{1, 1}, 1100}, {{1, 2}, 2200}}));
  ASSERT_TRUE(common.has_value());
  EXPECT_LE(common->scatter_q32, 65'536 / 100);
  // From 3300 to 3300 with 60 to and fro: sqrt(2) 60 / 3300 = 2.57 %, squared and in 1/2^32.
  const auto apart = trail.follow(field_at(66), lights_of({{{1, 1}, 1160}, {{1, 2}, 2140}}));
  ASSERT_TRUE(apart.has_value());
  EXPECT_EQ(apart->mean_q16, 0);
  EXPECT_NEAR(static_cast<double>(apart->scatter_q32), 0.000'661 * 4'294'967'296.0, 2e4);
}

TEST(BrightnessTrail, BeginsAnewAfterAPause) {
  BrightnessTrail trail;
  static_cast<void>(trail.follow(field_at(0), lights_of({{{1, 1}, 1000}})));
  EXPECT_EQ(mean_q16(trail.follow(field_at(200), lights_of({{{1, 1}, 1000}}))), std::nullopt);
  EXPECT_EQ(mean_q16(trail.follow(field_at(233), lights_of({{{1, 1}, 1000}}))), 0);
  EXPECT_EQ(mean_q16(trail.follow(field_at(100), lights_of({{{1, 1}, 1000}}))), std::nullopt)
      << "ran back";
}

TEST(TubeLight, OfAWindowIsTheMeanOfItsLines) {
  std::array<std::uint8_t, 64 * 48> pixels{};
  pixels.fill(100);
  const ImageView frame{pixels.data(), 64, 48, 64};
  TubeLightList lights;
  list_window_light(field_of(frame, Parity::kEven), {0, 0, 63, 47}, lights);
  ASSERT_FALSE(lights.empty());
  EXPECT_EQ(mean_light_q4(lights), 1600);
}

TEST(TubeLight, IsThatOfTubesUsed) {
  const std::array<TubeSighting, 3> tubes = {
      {{{1, 1}, {}, 9000, false, 500}, {{1, 2}, {}, 0, false, 900}, {{1, 3}, {}, 0, true, 0}}};
  TubeLightList lights;
  list_tube_light(tubes, lights);
  ASSERT_EQ(lights.size(), 1);
  EXPECT_EQ(lights[0].address, (TubeAddress{1, 1}));
  EXPECT_EQ(lights[0].light_q4, 500);
}

}  // namespace
}  // namespace tubesight::core::lighting
