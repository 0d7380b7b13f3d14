#include "board/bench/campaign/lamp_run.h"

#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "drivers/scenario/scenario_text.h"

namespace tubesight::board::campaign {
namespace {

using drivers::FaultKind;
using drivers::Scenario;

class LampRuns : public ::testing::Test {
 protected:
  LampRun make(std::int64_t number) { return maker_.make(1, number, *scenario_); }

  LampRunMaker maker_;
  std::unique_ptr<Scenario> scenario_ = std::make_unique<Scenario>();
};

TEST_F(LampRuns, AreTheSameWhateverWasDrawnBefore) {
  const LampRun alone = make(37);
  const std::string text = drivers::scenario_text(*scenario_, "");
  make(4);
  const LampRun again = make(37);
  EXPECT_EQ(drivers::scenario_text(*scenario_, ""), text);
  EXPECT_EQ(again.policy, alone.policy);
  EXPECT_EQ(again.fault_s, alone.fault_s);
}

TEST_F(LampRuns, HaveAllKindsInTurnEachWithItsFault) {
  std::set<std::string> names;
  for (std::int64_t number = 0; number < 2 * kLampKinds; ++number) {
    const LampRun run = make(number);
    names.insert(lamp_kind_name(lamp_kind_of(run)));
    EXPECT_TRUE(run.policy.pattern);
    EXPECT_TRUE(run.policy.follows_picture);
    ASSERT_EQ(scenario_->faults.size(), run.fault == LampFault::kNone ? 0U : 1U);
    EXPECT_GE(scenario_->video.length_s, 16.0);
    EXPECT_EQ(scenario_->path.size() == 1, run.motion == LampMotion::kRests);
    if (run.fault == LampFault::kNone) {
      continue;
    }
    const drivers::Fault& fault = scenario_->faults.front();
    EXPECT_GE(fault.at_s, 4.0);
    EXPECT_LE(run.fault_s + 12.0, scenario_->video.length_s + 1e-9) << "long enough to be named";
    if (run.fault == LampFault::kOtherCamera) {
      EXPECT_EQ(fault.kind, FaultKind::kOtherCamera);
      EXPECT_FALSE(fault.rows == 0 && fault.columns == 0);
    }
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kLampKinds));
  EXPECT_TRUE(names.contains("sound/rests"));
  EXPECT_TRUE(names.contains("other-camera/goes-on"));
}

TEST_F(LampRuns, DrawBulbsAndLedsAndWhatShinesBeside) {
  int leds = 0;
  int alone = 0;
  for (std::int64_t number = 0; number < 60; ++number) {
    make(number);
    leds += scenario_->light.lag_s == 0.0 ? 1 : 0;
    alone += scenario_->light.ring == 0.0 ? 1 : 0;
    EXPECT_LE(scenario_->light.lag_s, 0.25);
    EXPECT_LE(scenario_->light.ring, 0.6);
  }
  EXPECT_GT(leds, 5);
  EXPECT_LT(leds, 40);
  EXPECT_GT(alone, 15);
  EXPECT_LT(alone, 50);
}

TEST_F(LampRuns, AFrozenStoreIsNamedAndCounted) {
  const LampRun run = make(3);
  ASSERT_EQ(lamp_kind_name(lamp_kind_of(run)), "frozen/rests");

  const LampResult result = LampRunner().run(*scenario_, run);

  ASSERT_TRUE(result.runs);
  EXPECT_EQ(result.named, "unseen");
  EXPECT_EQ(result.counts[LampCount::kNamed], 1);
  EXPECT_EQ(result.counts[LampCount::kUnnamed], 0);
  EXPECT_EQ(result.counts[LampCount::kFalseAlarms], 0);
  EXPECT_EQ(result.counts[LampCount::kProved], 1);
  EXPECT_EQ(result.counts[LampCount::kWrong], 0);
  EXPECT_GT(result.counts[LampCount::kVouched], 100);
  EXPECT_GT(result.counts.named_ms_most, 200);
  EXPECT_LE(result.counts.named_ms_most, 10'000);
}

// Another toolhead's picture soon after the start, while the level is still led to its place: one
// that changes the light at once, and one that the level cannot bring to its place. Both went on
// being vouched for until the end, the first as proved.
TEST_F(LampRuns, AnothersPictureSoonAfterTheStartIsNamed) {
  for (const std::int64_t number : {59, 14}) {
    const LampRun run = make(number);
    ASSERT_EQ(lamp_kind_name(lamp_kind_of(run)), "other-camera/goes-on");

    const LampResult result = LampRunner().run(*scenario_, run);

    ASSERT_TRUE(result.runs);
    EXPECT_EQ(result.named, "unseen") << number;
    EXPECT_EQ(result.counts[LampCount::kProved], 1) << number;
    EXPECT_EQ(result.counts[LampCount::kFalseAlarms], 0) << number;
    EXPECT_LE(result.counts.named_ms_most, 5'000) << number;
    EXPECT_LE(result.counts[LampCount::kWrong], 100) << number << ": not while it is in doubt";
  }
}

TEST_F(LampRuns, AFaultThatNobodyTellsStaysWithoutAName) {
  LampRun run = make(3);
  scenario_->video.length_s = scenario_->faults.front().at_s + 0.3;

  const LampResult result = LampRunner().run(*scenario_, run);

  ASSERT_TRUE(result.runs);
  EXPECT_EQ(result.named, "");
  EXPECT_EQ(result.counts[LampCount::kUnnamed], 1);
  EXPECT_EQ(result.counts[LampCount::kNamed], 0);
}

TEST(LampCounts, AddUpAndKeepTheLongest) {
  LampCounts one;
  one[LampCount::kRuns] = 1;
  one[LampCount::kWrong] = 3;
  one.named_ms_sum = one.named_ms_most = 700;
  LampCounts other = one;
  other.named_ms_sum = other.named_ms_most = 300;
  other.proved_ms_most = 50;

  one += other;

  EXPECT_EQ(one[LampCount::kRuns], 2);
  EXPECT_EQ(one[LampCount::kWrong], 6);
  EXPECT_EQ(one.named_ms_sum, 1000);
  EXPECT_EQ(one.named_ms_most, 700);
  EXPECT_EQ(one.proved_ms_most, 50);
}

}  // namespace
}  // namespace tubesight::board::campaign
