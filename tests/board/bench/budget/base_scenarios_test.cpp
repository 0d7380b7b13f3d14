#include "board/bench/budget/base_scenarios.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

ScenarioOptions few_robots() {
  ScenarioOptions options;
  options.robots = 12;
  return options;
}

TEST(BaseScenarios, ABaseIsAllThatACalibrationTakesAway) {
  // Base, workpiece and support off, all else perfect, and so is vision.
  ScenarioOptions options = few_robots();
  options.magnitudes = {};
  options.magnitudes.base_mm = 5.0;
  options.magnitudes.base_deg = 0.3;
  options.magnitudes.support_mm = 1.0;
  options.magnitudes.workpiece_mm = 1.0;

  const ScenarioResult result = try_method({"vision", true, 0.0, 8, 0, 0}, options);

  EXPECT_EQ(result.refused, 0);
  for (const RadiusErrors& radius : result.radii) {
    EXPECT_LT(radius.across_rms_mm, 1e-4);
    EXPECT_LT(radius.along_rms_mm, 1e-4);
  }
}

TEST(BaseScenarios, AStiffRobotFeelsNoPush) {
  ScenarioOptions options = few_robots();
  options.magnitudes = {};
  const BaseMethod touch{"touch", false, 0.0, 3, 0, 0};
  options.push_n = 0.0;
  EXPECT_LT(try_method(touch, options).radii[5].along_rms_mm, 1e-3);
  options.push_n = 50.0;
  // The arm gives way by 7 mm for some 58 kg; 50 N are a twelfth of that.
  EXPECT_GT(try_method(touch, options).radii[5].along_rms_mm, 0.2);
}

TEST(BaseScenarios, ErrorsGrowWithThoseOfATouch) {
  const ScenarioOptions options = few_robots();
  double before = 0.0;
  for (const double sigma : {0.1, 1.0, 3.0}) {
    const double here =
        try_method({"touch", false, sigma, 3, 0, 0}, options).radii[2].across_rms_mm;
    EXPECT_GT(here, before);
    before = here;
  }
}

TEST(BaseScenarios, AreTheSameForTheSameSeed) {
  const ScenarioOptions options = few_robots();
  const auto first = try_method(source_methods()[0], options);
  const auto second = try_method(source_methods()[0], options);
  EXPECT_EQ(first.radii[3].across_rms_mm, second.radii[3].across_rms_mm);
}

TEST(BaseScenarios, VisionIsBetterThanTheSkilledOperatorAtEveryRadius) {
  ScenarioOptions options;
  options.robots = 60;
  const auto methods = source_methods();
  const ScenarioResult vision = try_method(methods[0], options);
  const ScenarioResult touch = try_method(methods[1], options);
  EXPECT_EQ(vision.refused, 0);
  for (std::size_t r = 0; r < vision.radii.size(); ++r) {
    EXPECT_LT(vision.radii[r].across_rms_mm, touch.radii[r].across_rms_mm) << r;
    EXPECT_LT(vision.radii[r].along_rms_mm, touch.radii[r].along_rms_mm) << r;
  }
}

TEST(BaseScenarios, ErrorsAreAboutThosePromised) {
  ScenarioOptions options;
  options.robots = 40;
  for (const BaseMethod& method : source_methods()) {
    const ScenarioResult result = try_method(method, options);
    EXPECT_GT(result.of_promised, 0.6) << method.name;
    EXPECT_LT(result.of_promised, 1.4) << method.name;
  }
}

TEST(BaseScenarios, LinksTakeAwayWhatTheBaseCannot) {
  const ScenarioOptions options = few_robots();
  const ScenarioResult base = try_method({"vision", true, 0.05, 8, 0, 0}, options);
  const ScenarioResult links = try_method({"vision", true, 0.05, 8, 40, 0}, options);
  for (std::size_t r = 1; r + 1 < base.radii.size(); ++r) {
    EXPECT_LT(links.radii[r].across_rms_mm, 0.7 * base.radii[r].across_rms_mm) << r;
  }
}

TEST(BaseScenarios, ZonesTakeAwayWhatTheBaseCannot) {
  const ScenarioOptions options = few_robots();
  BaseMethod method{"vision", true, 0.05, 8, 0, 0};
  const ScenarioResult base = try_method(method, options);
  method.zones = 40;
  const ScenarioResult zones = try_method(method, options);
  for (std::size_t r = 1; r + 1 < base.radii.size(); ++r) {
    EXPECT_LT(zones.radii[r].across_rms_mm, 0.7 * base.radii[r].across_rms_mm) << r;
  }
}

}  // namespace
}  // namespace tubesight::board
