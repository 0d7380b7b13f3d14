#include "board/bench/campaign/campaign_run.h"

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

const CampaignIdentity kIdentity{"box", "design"};

CampaignPlan plan_of(std::int64_t moves) {
  CampaignPlan plan;
  plan.limits.moves = moves;
  return plan;
}

StrataCounts run(const CampaignPlan& plan, Progress& progress) {
  EXPECT_EQ(run_campaign(plan, progress, {}), "");
  return progress.strata();
}

TEST(CampaignRun, CountsTheSameInOneGoInPartsAndInParallel) {
  Progress at_once(kIdentity);
  const StrataCounts expected = run(plan_of(4), at_once);
  EXPECT_EQ(at_once.total()[Count::kMoves], 4);
  EXPECT_GT(at_once.total()[Count::kFields], 200);

  Progress resumed(kIdentity);
  run(plan_of(2), resumed);
  EXPECT_TRUE(run(plan_of(4), resumed) == expected);

  Progress parallel(kIdentity);
  CampaignPlan plan = plan_of(4);
  plan.jobs = 3;
  EXPECT_TRUE(run(plan, parallel) == expected);
  EXPECT_EQ(parallel.ranges().size(), 1U);

  Progress first(kIdentity);
  run(plan_of(2), first);
  Progress second(kIdentity);
  plan = plan_of(2);
  plan.first_move = 2;
  run(plan, second);
  std::string why;
  ASSERT_TRUE(first.absorb(second, why)) << why;
  EXPECT_TRUE(first.strata() == expected);
}

TEST(CampaignRun, EndsAtFieldsAndWhenItsWatcherSaysSo) {
  Progress progress(kIdentity);
  CampaignPlan plan;
  plan.limits.fields = 100;
  run(plan, progress);
  EXPECT_EQ(progress.total()[Count::kMoves], 2);

  Progress watched(kIdentity);
  CampaignWatcher watcher;
  watcher.done_move = [](const Progress& done) { return done.total()[Count::kMoves] < 1; };
  EXPECT_EQ(run_campaign(plan_of(5), watched, watcher), "");
  EXPECT_EQ(watched.total()[Count::kMoves], 1);
}

TEST(BoxIdentity, IsTheVersionWithADigestThatRepeats) {
  const std::string identity = box_identity("9.8.7");
  EXPECT_EQ(identity.substr(0, 6), "9.8.7-");
  EXPECT_EQ(identity.size(), 6U + 16U);
  EXPECT_EQ(box_identity("9.8.7"), identity);
}

TEST(ConfigurationName, TellsTheSelfProofFromTheRest) {
  EXPECT_NE(configuration_name({true, false}), configuration_name({false, false}));
}

}  // namespace
}  // namespace tubesight::board::campaign
