#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "board/bench/campaign/random_move.h"
#include "board/bench/campaign/random_parts.h"
#include "drivers/scenario/scenario_text.h"

namespace tubesight::board::campaign {
namespace {

using core::Scan;
using drivers::Scenario;

constexpr std::int64_t kMoves = 64;

class RandomSize : public ::testing::Test {
 protected:
  const Scenario& make(std::int64_t move) {
    maker_.make(1, move, *scenario_);
    return *scenario_;
  }

  MoveMaker maker_{DrawOptions{true}};
  std::unique_ptr<Scenario> scenario_ = std::make_unique<Scenario>();
};

TEST_F(RandomSize, IsFromTheSmallestToTheLargestInFieldsAndWhole) {
  std::set<std::pair<std::int32_t, std::int32_t>> sizes;
  int whole = 0;
  double shortest_s = 1.0;
  double longest_s = 0.0;
  for (std::int64_t move = 0; move < kMoves; ++move) {
    const Scenario& scenario = make(move);
    const auto& camera = scenario.scene.camera;
    sizes.emplace(camera.width_px, camera.height_px);
    whole += camera.scan == Scan::kProgressive ? 1 : 0;
    shortest_s = std::min(shortest_s, field_s(scenario));
    longest_s = std::max(longest_s, field_s(scenario));
    EXPECT_EQ(scenario.told.camera.width_px, camera.width_px);
    EXPECT_EQ(scenario.told.camera.height_px, camera.height_px);
    EXPECT_EQ(scenario.told.camera.scan, camera.scan);
  }
  EXPECT_TRUE(sizes.contains({320, 240}));
  EXPECT_TRUE(sizes.contains({1920, 1200}));
  EXPECT_EQ(sizes.size(), 10U);
  EXPECT_GT(whole, kMoves / 3);
  EXPECT_LT(whole, kMoves);
  EXPECT_NEAR(shortest_s, 1.0 / 120.0, 1e-9);
  EXPECT_NEAR(longest_s, 1.0 / 50.0, 1e-9);
}

// The lens's directions at the corners of the window, in shares of the focal length.
TEST_F(RandomSize, LooksThroughTheSameLensAtTheSamePartOfTheSheet) {
  const auto usual = std::make_unique<Scenario>();
  const auto column_mm = [](const Scenario& scenario, double u) {
    const auto& camera = scenario.scene.camera;
    return camera.cell_width_mm * (u - camera.center_px[0]);
  };
  const auto line_mm = [](const Scenario& scenario, double v) {
    const auto& camera = scenario.scene.camera;
    return camera.cell_height_mm * (v - camera.center_px[1]);
  };
  for (std::int64_t move = 0; move < 16; ++move) {
    MoveMaker().make(1, move, *usual);
    const Scenario& scenario = make(move);
    const auto& window = scenario.told.start.window_px;
    const auto& before = usual->told.start.window_px;
    const double coarse_mm = 0.6 * std::max(0.0084 + scenario.scene.camera.cell_width_mm,
                                            0.0098 + scenario.scene.camera.cell_height_mm);
    EXPECT_NEAR(column_mm(scenario, window[0]), column_mm(*usual, before[0]), coarse_mm);
    EXPECT_NEAR(column_mm(scenario, window[2]), column_mm(*usual, before[2]), coarse_mm);
    EXPECT_NEAR(line_mm(scenario, window[1]), line_mm(*usual, before[1]), coarse_mm);
    EXPECT_NEAR(line_mm(scenario, window[3]), line_mm(*usual, before[3]), coarse_mm);
  }
}

TEST_F(RandomSize, HasNoFaultThatItsCameraCannotHave) {
  for (std::int64_t move = 0; move < 2 * kStrata; ++move) {
    const Scenario& scenario = make(move);
    for (const auto& fault : scenario.faults) {
      EXPECT_FALSE(fault.kind == drivers::FaultKind::kSwapped &&
                   scenario.scene.camera.scan == Scan::kProgressive)
          << move;
    }
  }
}

TEST_F(RandomSize, LeavesPlantsAndCamerasMountingsAsTheyAre) {
  const auto usual = std::make_unique<Scenario>();
  MoveMaker().make(1, 5, *usual);
  const Scenario& scenario = make(5);
  EXPECT_EQ(scenario.scene.sheet.row_step_mm, usual->scene.sheet.row_step_mm);
  EXPECT_EQ(scenario.scene.sheet.bore_mm, usual->scene.sheet.bore_mm);
  EXPECT_EQ(scenario.scene.tool.position_mm, usual->scene.tool.position_mm);
  EXPECT_EQ(scenario.scene.camera.focal_length_mm, usual->scene.camera.focal_length_mm);
}

}  // namespace
}  // namespace tubesight::board::campaign
