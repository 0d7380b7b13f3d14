#include "drivers/scenario/scenario_text.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "board/bench/campaign/random_move.h"
#include "board/bench/campaign/stratum.h"
#include "drivers/scenario/scenario_file.h"

namespace tubesight::board::campaign {
namespace {

/// One file in memory.
class OneFile final : public drivers::TextFiles {
 public:
  explicit OneFile(std::string text) : text_(std::move(text)) {}
  core::Result<void> read(const std::string& /*path*/, std::string& text,
                          std::string& /*message*/) override {
    text = text_;
    return {};
  }

 private:
  std::string text_;
};

// What is told comes back exactly; what is true as told plus error, to a bit.
TEST(ScenarioText, ComesBackThroughTheReaderOfScenarioFiles) {
  MoveMaker maker;
  const auto drawn = std::make_unique<drivers::Scenario>();
  for (std::int64_t move = 0; move < 2 * kStrata; move += 7) {
    maker.make(3, move, *drawn);
    OneFile files(drivers::scenario_text(*drawn, "a move"));
    const auto read = std::make_unique<drivers::ScenarioFile>();
    drivers::Messages messages;
    ASSERT_TRUE(drivers::load_scenario(files, "move.toml", {}, *read, messages).has_value())
        << move << ": " << (messages.empty() ? "" : messages.front());
    EXPECT_EQ(read->title, "a move");
    const auto& a = *drawn;
    const auto& b = read->scenario;
    EXPECT_EQ(b.seed, a.seed);
    EXPECT_EQ(b.told.camera.focal_length_mm, a.told.camera.focal_length_mm);
    EXPECT_EQ(b.told.tool.position_mm, a.told.tool.position_mm);
    EXPECT_EQ(b.told.start.window_px, a.told.start.window_px);
    EXPECT_EQ(b.told.motion.max_speed_mm_s, a.told.motion.max_speed_mm_s);
    EXPECT_NEAR(b.scene.camera.center_px[0], a.scene.camera.center_px[0], 1e-12);
    EXPECT_NEAR(b.scene.tool.rotation_deg[0], a.scene.tool.rotation_deg[0], 1e-12);
    EXPECT_NEAR(b.scene.sheet.bore_mm, a.scene.sheet.bore_mm, 1e-12);
    EXPECT_EQ(b.scene.plugs.size(), a.scene.plugs.size());
    EXPECT_EQ(b.scene.sheet.missing.size(), a.scene.sheet.missing.size());
    EXPECT_EQ(b.scene.look.fillet_mm, a.scene.look.fillet_mm);
    EXPECT_EQ(b.scene.lamp.strength, a.scene.lamp.strength);
    EXPECT_EQ(b.from, a.from);
    ASSERT_EQ(b.path.size(), a.path.size());
    // A second time through changes nothing but what the errors' last bits do.
    for (std::size_t i = 0; i < a.path.size(); ++i) {
      EXPECT_EQ(b.path[i].kind, a.path[i].kind);
      EXPECT_EQ(b.path[i].to_mm, a.path[i].to_mm);
      EXPECT_EQ(b.path[i].rest_s, a.path[i].rest_s);
    }
    ASSERT_EQ(b.faults.size(), a.faults.size());
    for (std::size_t i = 0; i < a.faults.size(); ++i) {
      EXPECT_EQ(b.faults[i].kind, a.faults[i].kind);
      EXPECT_EQ(b.faults[i].at_s, a.faults[i].at_s);
      EXPECT_EQ(b.faults[i].for_s, a.faults[i].for_s);
    }
  }
}

// No move is drawn with shifted rows; the writer knows them all the same.
TEST(ScenarioText, KeepsTheShiftOfOddRows) {
  MoveMaker maker;
  const auto drawn = std::make_unique<drivers::Scenario>();
  maker.make(3, 0, *drawn);
  drawn->told.tubesheet.odd_row_shift = -0.015625;
  OneFile files(drivers::scenario_text(*drawn, "a move"));
  const auto read = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;

  ASSERT_TRUE(drivers::load_scenario(files, "move.toml", {}, *read, messages).has_value())
      << (messages.empty() ? "" : messages.front());

  EXPECT_EQ(read->scenario.told.tubesheet.odd_row_shift, -0.015625);
  EXPECT_EQ(read->scenario.scene.sheet.odd_row_shift, -0.015625);
}

}  // namespace
}  // namespace tubesight::board::campaign
