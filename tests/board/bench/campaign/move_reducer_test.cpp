#include "board/bench/campaign/move_reducer.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;

PathSegment segment(SegmentKind kind) {
  PathSegment result;
  result.kind = kind;
  result.rest_s = kind == SegmentKind::kRest ? 0.5 : 0.0;
  return result;
}

Fault fault(FaultKind kind) {
  Fault result;
  result.kind = kind;
  result.for_s = 0.4;
  return result;
}

bool has(const Scenario& scenario, SegmentKind kind) {
  return std::any_of(scenario.path.begin(), scenario.path.end(),
                     [kind](const PathSegment& each) { return each.kind == kind; });
}

TEST(MoveReducer, KeepsWhatTheScenarioNeedsAndNothingElse) {
  const auto scenario = std::make_unique<Scenario>();
  for (const SegmentKind kind : {SegmentKind::kRest, SegmentKind::kMove, SegmentKind::kTurn,
                                 SegmentKind::kRest, SegmentKind::kDock}) {
    scenario->path.push_back(segment(kind));
  }
  scenario->faults = {fault(FaultKind::kDropped), fault(FaultKind::kBlack),
                      fault(FaultKind::kKnock)};
  scenario->video.length_s = 1.4;
  scenario->scene.look.boron = 0.2;
  scenario->scene.look.nicked = 0.1;
  scenario->from.beta_deg = 0.3;
  static_cast<void>(scenario->scene.plugs.try_push_back({{1, 2}, {}}));
  const ShowsIt shows_it = [](const Scenario& trial) {
    return has(trial, SegmentKind::kMove) && has(trial, SegmentKind::kRest) &&
           trial.video.length_s > 0.6 && trial.scene.look.nicked > 0.0;
  };
  ASSERT_TRUE(shows_it(*scenario));
  reduce(*scenario, shows_it);
  EXPECT_TRUE(shows_it(*scenario));
  EXPECT_EQ(scenario->path.size(), 2U);
  EXPECT_TRUE(scenario->faults.empty());
  EXPECT_LT(scenario->video.length_s, 0.8);
  EXPECT_EQ(scenario->scene.look.boron, 0.0);
  EXPECT_EQ(scenario->scene.look.nicked, 0.1);
  EXPECT_EQ(scenario->from.beta_deg, 0.0);
  EXPECT_TRUE(scenario->scene.plugs.empty());
}

TEST(MoveReducer, DropsFaultsOneByOneAndShortensTheRest) {
  const auto scenario = std::make_unique<Scenario>();
  scenario->faults = {fault(FaultKind::kDropped), fault(FaultKind::kBlack),
                      fault(FaultKind::kKnock)};
  reduce(*scenario, [](const Scenario& trial) {
    return std::any_of(trial.faults.begin(), trial.faults.end(), [](const Fault& each) {
      return each.kind == FaultKind::kBlack && each.for_s > 0.15;
    });
  });
  ASSERT_EQ(scenario->faults.size(), 1U);
  EXPECT_EQ(scenario->faults[0].kind, FaultKind::kBlack);
  EXPECT_EQ(scenario->faults[0].for_s, 0.2);
}

}  // namespace
}  // namespace tubesight::board::campaign
