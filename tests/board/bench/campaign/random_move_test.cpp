#include "board/bench/campaign/random_move.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "board/bench/campaign/random_parts.h"
#include "core/base/fnv1a.h"
#include "drivers/scenario/scenario_text.h"

namespace tubesight::board::campaign {
namespace {

using core::kinematics::SegmentKind;
using drivers::Scenario;

class RandomMove : public ::testing::Test {
 protected:
  const Scenario& make(std::int64_t move) {
    maker_.make(1, move, *scenario_);
    return *scenario_;
  }

  MoveMaker maker_;
  std::unique_ptr<Scenario> scenario_ = std::make_unique<Scenario>();
};

TEST_F(RandomMove, IsTheSameWhateverWasDrawnBefore) {
  const std::string alone = drivers::scenario_text(make(77), "");
  make(12);
  make(3);
  EXPECT_EQ(drivers::scenario_text(make(77), ""), alone);
  maker_.make(2, 77, *scenario_);
  EXPECT_NE(drivers::scenario_text(*scenario_, ""), alone);
}

// Progress of two designs must not be put together. A change of what is drawn changes the digest:
// give kDesign a new name then, and write both here. Since the text holds every key it is
// another digest of the same moves: of the 96 texts nothing but the added lines differs.
TEST_F(RandomMove, IsOfTheDesignThatItsNameSays) {
  core::Fnv1a digest;
  for (std::int64_t move = 0; move < kStrata; ++move) {
    digest.add(drivers::scenario_text(make(move), ""));
  }
  EXPECT_EQ(std::string(kDesign), "design-4");
  EXPECT_EQ(digest.value(), 0xde8ac55ff981aa69ULL);
}

TEST_F(RandomMove, IsOfItsStratum) {
  for (std::int64_t move = 0; move < kStrata; ++move) {
    const Stratum stratum = stratum_at(stratum_of_move(move));
    const Scenario& scenario = make(move);
    const auto& sheet = scenario.scene.sheet;
    EXPECT_EQ(sheet.weld == core::Weld::kFillet, stratum.weld == WeldKind::kFillet);
    // A square's steps are at right angles and equal; nothing else is.
    const auto& r = sheet.row_step_mm;
    const auto& c = sheet.column_step_mm;
    const double cosine = r[0] * c[0] + r[1] * c[1];
    const bool square =
        std::abs(cosine) < 1e-6 && std::abs(std::hypot(r[0], r[1]) - std::hypot(c[0], c[1])) < 1e-6;
    EXPECT_EQ(square, stratum.pitch == Pitch::kSquare) << move;
    // The tip's image is right under the picture's middle, or right beside it.
    const auto& tip = scenario.scene.tool.position_mm;
    EXPECT_EQ(std::abs(tip[0]) > std::abs(tip[1]), stratum.mounting == Mounting::kTurned);
    if (stratum.fault == FaultGroup::kNone) {
      EXPECT_TRUE(scenario.faults.empty());
    }
  }
}

TEST_F(RandomMove, KeepsToTheLimitsOfMotionUnlessItJumps) {
  for (std::int64_t move = 0; move < kStrata; ++move) {
    const Stratum stratum = stratum_at(stratum_of_move(move));
    const Scenario& scenario = make(move);
    const auto& motion = scenario.told.motion;
    for (const auto& segment : scenario.path) {
      if (segment.kind == SegmentKind::kMove && stratum.fault != FaultGroup::kJump) {
        EXPECT_LE(segment.limits.speed, motion.max_speed_mm_s);
        EXPECT_LE(segment.limits.acceleration, motion.max_acceleration_mm_s2);
        const bool slow = segment.limits.speed <= 150.0;
        EXPECT_EQ(slow, stratum.speed == SpeedBand::kSlow) << move;
      }
    }
    EXPECT_GE(scenario.video.length_s, 1.0);
    EXPECT_LE(scenario.video.length_s, 1.5);
  }
}

// But for a start that is wrong on purpose: whoever clicked named other tubes, all off alike.
TEST_F(RandomMove, HasThreeClicksOnOpenTubesThatStandWhereTheyAreSaidTo) {
  int wrong_starts = 0;
  for (std::int64_t move = 0; move < kStrata; ++move) {
    const Scenario& scenario = make(move);
    const auto truth = std::make_unique<core::rendering::Truth>();
    ASSERT_TRUE(truth->configure(scenario.scene).has_value());
    const auto T_sheet_tool = core::kinematics::transform_of(scenario.from);
    ASSERT_EQ(scenario.told.start.tubes.size(), 3);
    int wrong_clicks = 0;
    for (const auto& click : scenario.told.start.tubes) {
      const auto image = truth->tube_image(T_sheet_tool, click.address);
      ASSERT_TRUE(image.has_value());
      const double du = (click.at_px[0] - image->ellipse_px[0]) / image->half_px[0];
      const double dv = (click.at_px[1] - image->ellipse_px[1]) / image->half_px[1];
      wrong_clicks += std::hypot(du, dv) > 0.6 + 1e-9 ? 1 : 0;
    }
    EXPECT_TRUE(wrong_clicks == 0 || wrong_clicks == 3) << move;
    const bool jumps = stratum_at(stratum_of_move(move)).fault == FaultGroup::kJump;
    EXPECT_TRUE(jumps || wrong_clicks == 0) << move;
    wrong_starts += wrong_clicks == 3 ? 1 : 0;
  }
  EXPECT_GT(wrong_starts, 0);
  EXPECT_LT(wrong_starts, 8);
}

TEST_F(RandomMove, DrawsAllFaultsOfTheList) {
  std::array<int, drivers::kFaultKinds> drawn{};
  int beside_the_lattice = 0;
  int leds_alone = 0;
  int restarts = 0;
  for (std::int64_t move = 0; move < 6 * kStrata; ++move) {
    // The pictures' kinds are the most.
    if (move >= 2 * kStrata && stratum_at(stratum_of_move(move)).fault != FaultGroup::kPicture) {
      continue;
    }
    const Scenario& scenario = make(move);
    for (const auto& fault : scenario.faults) {
      ++drawn.at(static_cast<std::size_t>(fault.kind));
      const bool whole_move = fault.kind == drivers::FaultKind::kCompressed ||
                              fault.kind == drivers::FaultKind::kJitter;
      const bool from_the_start = whole_move || fault.kind >= drivers::FaultKind::kBlots ||
                                  fault.kind == drivers::FaultKind::kSaltPepper;
      EXPECT_TRUE(fault.at_s > 0.0 || from_the_start);
      EXPECT_TRUE(fault.at_s == 0.0 || !whole_move);
      EXPECT_LE(fault.at_s + fault.for_s, scenario.video.length_s + 1e-9);
    }
    const bool jumps = stratum_at(stratum_of_move(move)).fault == FaultGroup::kJump;
    beside_the_lattice += jumps && scenario.faults.empty() && scenario.events.empty() ? 1 : 0;
    leds_alone += scenario.light.lamp_permille == 0 && scenario.light.ring > 0.0 ? 1 : 0;
    EXPECT_TRUE(jumps || scenario.events.empty());
    restarts += static_cast<int>(scenario.events.size());
  }
  for (std::size_t kind = 0; kind < drawn.size(); ++kind) {
    const auto fault = static_cast<drivers::FaultKind>(kind);
    if (fault == drivers::FaultKind::kFrozen || fault == drivers::FaultKind::kOtherCamera) {
      EXPECT_EQ(drawn.at(kind), 0) << "only a lamp of the box's own shows it";
      continue;
    }
    EXPECT_GT(drawn.at(kind), 0) << drivers::kFaultWords.at(kind);
  }
  EXPECT_GT(beside_the_lattice, 0);
  EXPECT_GT(leds_alone, 0);
  EXPECT_GT(restarts, 0);
}

}  // namespace
}  // namespace tubesight::board::campaign
