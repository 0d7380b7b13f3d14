// The recorder on fields of its own making: what it keeps, when it hands it over, and that it never
// waits.

#include "board/box/event_recorder.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/board/box/recorder_bench.h"
#include "tests/support/events.h"

namespace tubesight::board {
namespace {

using core::Error;
using hal::RecordingReason;

TEST_F(RecorderBench, WritesWhatWasGivenFromTheFirstFieldOn) {
  configure();
  steps(10);
  core::Event event = tests::event_of(core::Claim{{1, 1}});
  event.id = 77;
  ASSERT_TRUE(input_->events.try_push_back(event));
  recorder_->request();
  step();  // field 10
  steps(2);
  input_->field.status = core::FieldStatus::kMissing;
  step();  // 13
  write_all();
  EXPECT_TRUE(store_.recordings.empty()) << "it goes on after its reason";
  steps(2);  // 14, 15: the frame's end
  write_all();

  ASSERT_EQ(store_.recordings.size(), 1U);
  const auto& recording = store_.recordings[0];
  EXPECT_EQ(recording.reason, RecordingReason::kCommand);
  EXPECT_EQ(recording.field, 10);
  EXPECT_EQ(recording.fields, 16);
  EXPECT_EQ(recording.state_bytes, kStateBytes / 2);
  ASSERT_EQ(recording.steps.size(), 16U);
  EXPECT_TRUE(recording.finished);
  for (std::int64_t i = 0; i < 16; ++i) {
    const auto& kept = recording.steps[static_cast<std::size_t>(i)];
    EXPECT_EQ(kept.field.number, i);
    EXPECT_EQ(kept.grey, i == 13 ? 0 : i);
    EXPECT_EQ(kept.field.pixels.first_line, i == 13 ? 0 : i % 2);
    EXPECT_EQ(kept.events, i == 10 ? std::vector<std::int64_t>{77} : std::vector<std::int64_t>{});
  }
  EXPECT_EQ(recording.steps[13].field.status, core::FieldStatus::kMissing);
  EXPECT_EQ(recorder_->counters().written, 1U);
}

TEST_F(RecorderBench, DropsTheOldestAndKeepsTheStateBeforeItsFirst) {
  configure();
  const int capacity = recorder_->capacity_fields();
  ASSERT_GE(capacity, 64);
  steps(5 * capacity);
  recorder_->request();
  steps(6);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 1U);
  const auto& recording = store_.recordings[0];
  const std::int64_t first = recording.steps[0].field.number;
  EXPECT_GT(first, 3 * capacity);
  EXPECT_GE(static_cast<int>(recording.steps.size()), capacity * 3 / 4);
  EXPECT_EQ(first % 2, 0) << "a frame's first field";
  EXPECT_EQ(recording.state, static_cast<std::uint8_t>(first - 1)) << "saved after the step before";
  for (std::size_t i = 1; i < recording.steps.size(); ++i) {
    ASSERT_EQ(recording.steps[i].field.number, recording.steps[i - 1].field.number + 1);
  }
  EXPECT_LT(states_, 5 * capacity / 8);
}

TEST_F(RecorderBench, RecordsOneDisagreementOnce) {
  configure();
  steps(3);
  reply(core::ClaimVerdict::kContradicted);
  step();
  reply(core::ClaimVerdict::kContradicted);
  step();
  EXPECT_EQ(recorder_->counters().asked, 1U) << "the robot insists";
  reply(core::ClaimVerdict::kUnknown);
  step();
  reply(core::ClaimVerdict::kContradicted, {5, 5});
  step();
  EXPECT_EQ(recorder_->counters().asked, 2U);
  EXPECT_EQ(recorder_->counters().joined, 1U);
  steps(10);
  reply(core::ClaimVerdict::kConfirmed);
  step();
  since_start_ += std::chrono::seconds(30);
  reply(core::ClaimVerdict::kContradicted, {5, 5});
  step();
  steps(10);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 2U);
  EXPECT_EQ(store_.recordings[0].reason, RecordingReason::kDisagreement);
  EXPECT_EQ(store_.recordings[0].field, 3);
  // Nothing is written twice, and nothing between is left out.
  EXPECT_EQ(store_.recordings[1].steps[0].field.number,
            store_.recordings[0].steps.back().field.number + 1);
}

TEST_F(RecorderBench, ARobotThatIsWrongWithoutEndLeavesOlderRecordingsOnTheDisk) {
  configure();
  for (int second = 0; second < 59; ++second) {
    reply(core::ClaimVerdict::kContradicted, {1 + second % 2, 1});
    steps(50);
    write_all();
  }
  EXPECT_EQ(store_.recordings.size(), 2U) << "at 0 s and 31 s: that of 30 s is shown already";
  const RecorderCounters counters = recorder_->counters();
  EXPECT_EQ(counters.asked, 2U);
  EXPECT_EQ(counters.spared, 15U + 14U) << "each second claim is the one that was recorded";
}

TEST_F(RecorderBench, WhatIsClaimedStillAfterTheTimeBetweenIsRecorded) {
  configure();
  reply(core::ClaimVerdict::kContradicted, {1, 1});
  steps(50);
  for (int second = 1; second <= 40; ++second) {
    reply(core::ClaimVerdict::kContradicted, {2, 1});
    steps(50);
  }
  write_all();

  ASSERT_EQ(store_.recordings.size(), 2U);
  EXPECT_EQ(store_.recordings[1].field, 30 * 50);
  EXPECT_EQ(recorder_->counters().spared, 29U);
}

TEST_F(RecorderBench, NothingElseIsSpared) {
  configure();
  reply(core::ClaimVerdict::kContradicted, {1, 1});
  steps(20);
  output_->sighting.state = core::TrackState::kLost;
  steps(20);
  recorder_->request();
  steps(20);
  reply(core::ClaimVerdict::kContradicted, {2, 1});
  steps(20);
  since_start_ = -2 * next_ * kFieldSpan;  // another source's time
  reply(core::ClaimVerdict::kContradicted, {2, 1});
  steps(20);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 4U);
  EXPECT_EQ(store_.recordings[1].reason, RecordingReason::kTrackLost);
  EXPECT_EQ(store_.recordings[2].reason, RecordingReason::kCommand);
  EXPECT_EQ(store_.recordings[3].reason, RecordingReason::kDisagreement);
  EXPECT_EQ(recorder_->counters().spared, 1U);
}

TEST_F(RecorderBench, RecordsALostTrackOnceAndNothingItIsToldNotTo) {
  settings_.on_disagreement = false;
  configure();
  steps(3);
  reply(core::ClaimVerdict::kContradicted);
  step();
  output_->sighting.state = core::TrackState::kLost;
  steps(20);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 1U);
  EXPECT_EQ(store_.recordings[0].reason, RecordingReason::kTrackLost);
  EXPECT_EQ(store_.recordings[0].field, 4);
  EXPECT_EQ(recorder_->counters().asked, 1U);
}

TEST_F(RecorderBench, RefusesWhileAllMemoryWaitsToBeWritten) {
  configure();
  for (int i = 0; i < 30; ++i) {
    recorder_->request();
    steps(6);
  }
  const RecorderCounters counters = recorder_->counters();
  EXPECT_EQ(counters.asked, 30U);
  EXPECT_GT(counters.refused, 0U);
  EXPECT_EQ(counters.written, 0U);

  write_all();
  EXPECT_EQ(recorder_->counters().written + counters.refused + counters.joined, 30U);
  steps(20);
  recorder_->request();
  steps(6);
  write_all();
  EXPECT_EQ(recorder_->counters().refused, counters.refused) << "there is room again";
  const auto& last = store_.recordings.back();
  EXPECT_EQ(last.steps.back().field.number + 2 > next_ - 2, true);
  for (std::size_t i = 1; i < last.steps.size(); ++i) {
    ASSERT_EQ(last.steps[i].field.number, last.steps[i - 1].field.number + 1);
  }
}

TEST_F(RecorderBench, KeepsWhatFreeMemoryHoldsWhileARecordingWaits) {
  settings_.memory_mb = 64;
  configure();
  steps(2 * recorder_->capacity_fields());
  recorder_->request();
  steps(6);
  const std::int64_t frozen_to = next_;
  steps(recorder_->capacity_fields());  // nobody writes
  recorder_->request();
  steps(6);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 2U);
  const auto& second = store_.recordings[1].steps;
  EXPECT_GE(static_cast<int>(second.size()), recorder_->capacity_fields() / 8);
  EXPECT_GE(second[0].field.number, frozen_to);
  EXPECT_EQ(recorder_->counters().refused, 0U);
}

TEST_F(RecorderBench, CountsWhatTheStoreGivesUpAndGoesOn) {
  configure();
  store_.fail_begin = true;
  recorder_->request();
  steps(10);
  write_all();
  store_.fail_begin = false;
  store_.fail_add = true;
  recorder_->request();
  steps(10);
  write_all();
  EXPECT_EQ(recorder_->counters().failed, 2U);
  store_.fail_add = false;
  recorder_->request();
  steps(10);
  write_all();
  EXPECT_EQ(recorder_->counters().written, 1U);
}

TEST_F(RecorderBench, BeginsAnewWhereNumbersOrParityDoNotGoOn) {
  configure();
  steps(9);
  next_ = 4;  // another loop counts from the beginning
  steps(9);
  recorder_->request();
  steps(8);
  write_all();

  ASSERT_EQ(store_.recordings.size(), 1U);
  EXPECT_GE(store_.recordings[0].steps[0].field.number, 5);
  EXPECT_LE(store_.recordings[0].steps[0].field.number, 7);
  EXPECT_EQ(recorder_->counters().restarted, 1U);
}

TEST_F(RecorderBench, FlushesWhatIsGoingOn) {
  configure();
  steps(4);
  recorder_->request();
  step();
  recorder_->flush();
  write_all();
  ASSERT_EQ(store_.recordings.size(), 1U);
  EXPECT_EQ(store_.recordings[0].steps.size(), 5U);
}

TEST_F(RecorderBench, RefusesMemoryThatHoldsNothingUseful) {
  settings_.memory_mb = 8;
  EXPECT_EQ(recorder_->configure(settings_, camera_, kStateBytes).error(), Error::kOutOfRange);
  settings_.memory_mb = 24;
  settings_.fields_after = 10'000;
  EXPECT_EQ(recorder_->configure(settings_, camera_, kStateBytes).error(), Error::kOutOfRange);
}

TEST_F(RecorderBench, IsWrittenByAnotherThreadWhileItGoesOn) {
  configure();
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    while (!stop.load()) {
      if (!recorder_->write_next(store_)) {
        std::this_thread::yield();
      }
    }
    write_all();
  });
  for (int i = 0; i < 100; ++i) {
    recorder_->request();
    steps(8);
  }
  recorder_->flush();
  stop = true;
  writer.join();

  const RecorderCounters counters = recorder_->counters();
  EXPECT_EQ(counters.asked, 100U);
  EXPECT_GT(counters.written, 0U);
  EXPECT_EQ(counters.written, store_.recordings.size());
  for (const auto& recording : store_.recordings) {
    EXPECT_EQ(recording.fields, static_cast<std::int64_t>(recording.steps.size()));
    for (std::size_t i = 0; i < recording.steps.size(); ++i) {
      const auto& kept = recording.steps[i];
      ASSERT_EQ(kept.field.number, recording.steps[0].field.number + static_cast<std::int64_t>(i));
      ASSERT_EQ(kept.grey, static_cast<std::uint8_t>(kept.field.number)) << "overwritten";
    }
  }
}

}  // namespace
}  // namespace tubesight::board
