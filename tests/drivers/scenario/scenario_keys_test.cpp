// The ranges of the looks' keys are the renderer's, so that no number is refused without its name.

#include "drivers/scenario/scenario_keys.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "core/rendering/renderer.h"
#include "tests/drivers/scenario/scenario_reading.h"

namespace tubesight::drivers {
namespace {

using core::rendering::Scene;

/// Configures a renderer with each key at each end of its range, the others at their defaults.
template <typename Struct, std::size_t N>
void expect_drawn(const std::array<NumberKey<Struct>, N>& keys, Struct Scene::*look) {
  const ScenarioReading plant(kRestPath);
  const auto scene = std::make_unique<Scene>(plant.scenario().scene);
  const auto renderer = std::make_unique<core::rendering::Renderer>();
  for (const NumberKey<Struct>& key : keys) {
    for (const double end : {key.range.least, key.range.most}) {
      *scene = plant.scenario().scene;
      (scene.get()->*look).*key.member = end;
      // The two that the reader compares: the land is part of the fillet.
      if (key.key == "land_mm") {
        scene->look.fillet_mm = std::max(scene->look.fillet_mm, end);
      } else if (key.key == "fillet_mm") {
        scene->look.land_mm = std::min(scene->look.land_mm, end);
      }
      EXPECT_TRUE(renderer->configure(*scene).has_value()) << key.key << " = " << end;
    }
  }
}

TEST(ScenarioKeys, CanBeDrawnAtBothEndsOfTheirRanges) {
  expect_drawn(kSheetLookKeys, &Scene::look);
  expect_drawn(kLampLookKeys, &Scene::lamp);
  expect_drawn(kSensorLookKeys, &Scene::sensor);
  expect_drawn(kGuidetubeLookKeys, &Scene::guidetube);
}

}  // namespace
}  // namespace tubesight::drivers
