#include "drivers/simulated/simulated_world.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/drivers/simulated/small_scenario.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

std::vector<std::uint8_t> bytes_of(const core::FieldView& view) {
  std::vector<std::uint8_t> bytes;
  for (std::int32_t line = 0; line < view.lines; ++line) {
    const std::uint8_t* const pixels =
        view.pixels + static_cast<std::ptrdiff_t>(line) * view.stride_px;
    bytes.insert(bytes.end(), pixels, pixels + view.width_px);
  }
  return bytes;
}

class World : public testing::Test {
 protected:
  /// Mean grey level of the next field.
  double mean_of_next() {
    EXPECT_TRUE(world_->next(field_));
    double sum = 0.0;
    const auto bytes = bytes_of(field_.field.pixels);
    for (const std::uint8_t grey : bytes) {
      sum += grey;
    }
    return sum / static_cast<double>(bytes.size());
  }

  std::unique_ptr<Scenario> scenario_ = small_scenario();
  std::unique_ptr<SimulatedWorld> world_ = std::make_unique<SimulatedWorld>();
  SimulatedField field_;
};

TEST_F(World, AlternatesLinesAndCountsFieldsAtTheirInstants) {
  ASSERT_TRUE(world_->configure(*scenario_));

  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.parity, core::Parity::kEven);
  EXPECT_EQ(field_.field.sequence, 0);
  EXPECT_EQ(field_.field.mid_exposure.count(), 0);
  EXPECT_EQ(field_.field.pixels.lines, 120);
  EXPECT_EQ(field_.field.pixels.first_line, 0);
  EXPECT_EQ(field_.field.status, core::FieldStatus::kGood);
  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.parity, core::Parity::kOdd);
  EXPECT_EQ(field_.field.sequence, 1);
  EXPECT_EQ(field_.field.mid_exposure.count(), 16666667);
  EXPECT_EQ(field_.field.pixels.first_line, 1);
}

TEST_F(World, OddLinesComeFirstWhereTheCameraSaysSo) {
  scenario_->scene.camera.scan = core::Scan::kOddFirst;
  ASSERT_TRUE(world_->configure(*scenario_));

  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.parity, core::Parity::kOdd);
  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.parity, core::Parity::kEven);
}

TEST_F(World, AProgressiveCameraGivesWholeFrames) {
  scenario_->scene.camera.scan = core::Scan::kProgressive;
  ASSERT_TRUE(world_->configure(*scenario_));

  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.parity, core::Parity::kProgressive);
  EXPECT_EQ(field_.field.pixels.lines, 240);
  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.field.mid_exposure.count(), 33333333);
}

TEST_F(World, EndsWithThePathInWholeFrames) {
  // 0.5 s, then 25 mm at 100 mm/s and 1000 mm/s2: 0.25 s + 0.1 s, then 0.5 s: 1.35 s are 40.5
  // frames.
  ASSERT_TRUE(world_->configure(*scenario_));
  EXPECT_NEAR(world_->path().duration_s(), 1.35, 1e-9);
  EXPECT_EQ(world_->slots(), 82);

  std::int64_t fields = 0;
  while (world_->next(field_)) {
    ++fields;
  }
  EXPECT_EQ(fields, 82);
  EXPECT_FALSE(world_->next(field_));
}

TEST_F(World, EndsWhereTheLengthSays) {
  scenario_->video.length_s = 0.1;
  ASSERT_TRUE(world_->configure(*scenario_));

  EXPECT_EQ(world_->slots(), 6);
}

TEST_F(World, TellsTheTruthOfThePath) {
  ASSERT_TRUE(world_->configure(*scenario_));
  ASSERT_TRUE(world_->next(field_));

  // Tube (40, 60) stands at 25.4 mm times (60, 40) = (1524, 1016); the tool leans nowhere.
  EXPECT_EQ(field_.truth.axis.nearest.address, (core::TubeAddress{40, 60}));
  EXPECT_NEAR(field_.truth.axis.nearest.offset_mm, 0.5, 1e-9);
  EXPECT_NEAR(field_.truth.axis.axis_mm[0], 1524.4, 1e-9);
  EXPECT_NEAR(field_.truth.T_sheet_tool.translation_mm().z(), -60.0, 1e-9);
  EXPECT_NEAR(field_.truth.speed_mm_s, 0.0, 1e-9);

  // Slot 39 is at 0.65 s: 0.15 s into the move, of which 0.1 s of speeding up are 5 mm.
  while (field_.slot < 39) {
    ASSERT_TRUE(world_->next(field_));
  }
  EXPECT_NEAR(field_.truth.speed_mm_s, 100.0, 1e-6);
  EXPECT_NEAR(field_.truth.axis.axis_mm[0], 1524.4 + 5.0 + 5.0, 1e-6);
}

TEST_F(World, TheSameScenarioGivesTheSameBytesAgain) {
  ASSERT_TRUE(world_->configure(*scenario_));
  std::vector<std::vector<std::uint8_t>> first;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(world_->next(field_));
    first.push_back(bytes_of(field_.field.pixels));
  }

  ASSERT_TRUE(world_->configure(*scenario_));
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(world_->next(field_));
    EXPECT_EQ(bytes_of(field_.field.pixels), first[static_cast<std::size_t>(i)]);
  }
  EXPECT_NE(first[0], first[2]) << "noise differs from field to field";
}

TEST_F(World, DrawsTheWindowAndItsMarginAlone) {
  scenario_->told.start.window_px = {100, 60, 199, 119};
  scenario_->video.window_margin_px = 10;
  ASSERT_TRUE(world_->configure(*scenario_));
  ASSERT_TRUE(world_->next(field_));
  ASSERT_TRUE(world_->next(field_));

  const core::ImageView frame = world_->frame();
  int outside = 0;
  std::int64_t inside = 0;
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      const bool drawn = u >= 90 && u <= 209 && v >= 50 && v <= 129;
      inside += drawn ? frame.line(v)[u] : 0;
      outside += !drawn && frame.line(v)[u] != 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(inside, 120 * 80 * 10) << "something is drawn inside";
}

TEST_F(World, HandsTheClicksOverBeforeTheFirstField) {
  ASSERT_TRUE(scenario_->told.start.tubes.try_push_back({{40, 60}, {150.0, 90.0}}));
  ASSERT_TRUE(world_->configure(*scenario_));

  ASSERT_TRUE(world_->next(field_));
  ASSERT_EQ(field_.events.size(), 1);
  const auto start = tests::content_of<core::Start>(field_.events[0]);
  ASSERT_FALSE(start.tubes.empty());
  EXPECT_EQ(start.tubes[0].at_px[0], 150.0);
  ASSERT_TRUE(world_->next(field_));
  EXPECT_TRUE(field_.events.empty());
}

ScenarioEvent lamp_event(double at_s, std::int32_t permille) {
  ScenarioEvent event;
  event.at_s = at_s;
  event.event.content = core::LampCommand{permille};
  return event;
}

TEST_F(World, HandsEventsToTheFirstFieldAtOrAfterThem) {
  // Slots 2 and 3 are at 0.0333 and 0.05 s.
  scenario_->events = {lamp_event(0.034, 300), lamp_event(0.05, 200)};
  ASSERT_TRUE(world_->configure(*scenario_));

  std::vector<std::int32_t> counts;
  std::vector<std::int32_t> levels;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(world_->next(field_));
    counts.push_back(field_.events.size());
    levels.push_back(field_.field.lamp_permille);
  }
  EXPECT_EQ(counts, (std::vector<std::int32_t>{0, 0, 0, 2, 0}));
  EXPECT_EQ(levels, (std::vector<std::int32_t>{1000, 1000, 1000, 1000, 200}))
      << "a level asked for before a field is in force from the next";
}

TEST_F(World, KeepsEventsThatFindNoRoomForTheNextField) {
  for (int i = 0; i < 20; ++i) {
    scenario_->events.push_back(lamp_event(0.0, i));
  }
  ASSERT_TRUE(world_->configure(*scenario_));

  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.events.size(), 16);
  ASSERT_TRUE(world_->next(field_));
  EXPECT_EQ(field_.events.size(), 4);
}

TEST_F(World, ADimmerSetsTheLightOfTheNextField) {
  ASSERT_TRUE(world_->configure(*scenario_));

  const double full = mean_of_next();
  world_->set_lamp_permille(300);
  const double dim = mean_of_next();

  EXPECT_EQ(field_.field.lamp_permille, 300);
  EXPECT_LT(dim, 0.6 * full);
  EXPECT_GT(dim, 0.1 * full);
}

TEST_F(World, ALaggingLampComesHalfWayInEachFieldWhereTheLagIsAField) {
  scenario_->light.lag_s = 1.0 / 60.0;
  scenario_->light.lamp_permille = 0;
  scenario_->scene.sensor.blooming = 0.0;
  scenario_->scene.lamp.strength = 0.5;  // far from saturation: grey levels go with the light
  ASSERT_TRUE(world_->configure(*scenario_));

  const double dark = mean_of_next();
  world_->set_lamp_permille(800);
  const double first = mean_of_next() - dark;
  const double second = mean_of_next() - dark;
  const double third = mean_of_next() - dark;

  // 1/2, 3/4, 7/8 of the level.
  EXPECT_EQ(field_.field.lamp_permille, 800) << "what is commanded";
  EXPECT_GT(first, 5.0);
  EXPECT_NEAR(second / first, 1.5, 0.05);
  EXPECT_NEAR(third / first, 1.75, 0.05);
}

class Elsewhere final : public ToolMotion {
 public:
  core::Transform<core::frames::Sheet, core::frames::Tool> pose_at(double time_s) override {
    return {Eigen::Matrix3d::Identity(), {254.0 + 10.0 * time_s, 508.0, -40.0}};
  }
};

TEST_F(World, ARobotTakesThePathsPlace) {
  Elsewhere robot;
  ASSERT_TRUE(world_->configure(*scenario_));
  world_->steer(&robot);

  ASSERT_TRUE(world_->next(field_));

  EXPECT_EQ(field_.truth.axis.nearest.address, (core::TubeAddress{20, 10}));
  EXPECT_NEAR(field_.truth.speed_mm_s, 10.0, 1e-6);
}

TEST_F(World, RefusesWhatCannotBePlayed) {
  scenario_->video.exposure_s = 0.02;  // a field takes 0.0167 s
  EXPECT_FALSE(world_->configure(*scenario_));
  scenario_->video.exposure_s = 0.0;
  scenario_->video.rate_numerator = 0;
  EXPECT_FALSE(world_->configure(*scenario_));
  scenario_->video.rate_numerator = 30;
  scenario_->path[1].limits.speed = -1.0;
  EXPECT_FALSE(world_->configure(*scenario_));
}

}  // namespace
}  // namespace tubesight::drivers
