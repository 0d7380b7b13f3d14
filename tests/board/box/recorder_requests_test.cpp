// Whoever asks for a recording hears what became of it.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "board/box/event_recorder.h"
#include "tests/board/box/recorder_bench.h"

namespace tubesight::board {
namespace {

using hal::RecordingReason;

TEST_F(RecorderBench, TellsWhoeverAskedHowItEnded) {
  using End = RecordingOutcome::End;
  configure();
  steps(10);
  EXPECT_EQ(recorder_->request(), 1U);
  EXPECT_EQ(recorder_->request(), 2U);
  step();
  EXPECT_EQ(recorder_->request(), 3U) << "joins what is going on";
  steps(8);
  const auto first = recorder_->write_next(store_);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->end, End::kWritten);
  EXPECT_TRUE(first->requests.hold(1) && first->requests.hold(3));
  EXPECT_FALSE(first->requests.hold(0) || first->requests.hold(4));
  EXPECT_FALSE(recorder_->write_next(store_));

  store_.fail_add = true;
  EXPECT_EQ(recorder_->request(), 4U);
  steps(8);
  const auto second = recorder_->write_next(store_);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->end, End::kFailed);
  EXPECT_TRUE(second->requests.hold(4));
  EXPECT_FALSE(second->requests.hold(3));
}

TEST_F(RecorderBench, TellsWhoeverAskedThatThereIsNoMemory) {
  using End = RecordingOutcome::End;
  configure();
  std::vector<End> ends;
  std::uint32_t told = 0;
  for (int i = 0; i < 8; ++i) {  // nobody writes
    steps(40);
    recorder_->request();
    steps(8);
  }
  while (const auto outcome = recorder_->write_next(store_)) {
    ends.push_back(outcome->end);
    told += outcome->requests.last - outcome->requests.first + 1;
  }
  EXPECT_EQ(std::count(ends.begin(), ends.end(), End::kRefused), recorder_->counters().refused);
  EXPECT_GT(recorder_->counters().refused, 0U);
  EXPECT_GT(recorder_->counters().written, 0U);
  EXPECT_EQ(told, 8U) << "everybody was answered once";
}

TEST_F(RecorderBench, ADisagreementAnswersNobody) {
  configure();
  steps(10);
  reply(core::ClaimVerdict::kContradicted);
  steps(8);
  const auto outcome = recorder_->write_next(store_);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->reason, RecordingReason::kDisagreement);
  EXPECT_EQ(outcome->requests.last, 0U);
}

}  // namespace
}  // namespace tubesight::board
