// A campaign that cannot find errors proves nothing.

#include <vector>

#include <gtest/gtest.h>

#include "board/bench/campaign/campaign_run.h"

namespace tubesight::board::campaign {
namespace {

CampaignPlan plan_of(bool margin_check, std::int64_t fields) {
  CampaignPlan plan;
  plan.run.margin_check = margin_check;
  plan.limits.fields = fields;
  return plan;
}

TEST(SelfProof, FindsWrongTubesWithin20000FieldsWhenTheMarginCheckIsOff) {
  Progress progress({"box", "design"});
  std::vector<WrongMove> found;
  CampaignWatcher watcher;
  watcher.found_wrong = [&found](const WrongMove& wrong) { found.push_back(wrong); };
  watcher.done_move = [&found](const Progress&) { return found.empty(); };
  EXPECT_EQ(run_campaign(plan_of(false, 20'000), progress, watcher), "");
  ASSERT_FALSE(found.empty());
  EXPECT_GT(progress.total()[Count::kWrongTube], 0);

  // The same moves, with the check: it is the check that holds the wrong tube back.
  Progress checked({"box", "design"});
  CampaignPlan plan = plan_of(true, 0);
  plan.first_move = found.front().move;
  plan.limits.moves = 1;
  EXPECT_EQ(run_campaign(plan, checked, {}), "");
  EXPECT_EQ(checked.total()[Count::kWrongTube], 0);
}

}  // namespace
}  // namespace tubesight::board::campaign
