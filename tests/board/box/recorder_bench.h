#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "board/box/event_recorder.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/session/session.h"
#include "hal/recording_store.h"

namespace tubesight::board {

inline constexpr std::size_t kStateBytes = 1000;
inline constexpr core::FieldTime kFieldSpan = std::chrono::milliseconds(20);

/// Holds recordings in memory; fails where it is told to.
class FakeRecordingStore final : public hal::RecordingStore {
 public:
  struct Step {
    core::Field field;
    std::uint8_t grey = 0;  ///< of the first pixel
    std::vector<std::int64_t> events;
  };
  struct Recording {
    hal::RecordingReason reason;
    std::int64_t field = 0;
    std::int64_t fields = 0;
    std::size_t state_bytes = 0;
    std::uint8_t state = 0;  ///< its first byte
    std::vector<Step> steps;
    bool finished = false;
  };

  core::Result<void> begin(const hal::RecordingHead& head) override {
    if (fail_begin) {
      return core::Unexpected(core::Error::kIo);
    }
    recordings.push_back({head.reason,
                          head.field,
                          head.fields,
                          head.state.size(),
                          std::to_integer<std::uint8_t>(head.state[0]),
                          {},
                          false});
    return {};
  }
  core::Result<void> add(const core::Field& field, std::span<const core::Event> events) override {
    if (fail_add) {
      return core::Unexpected(core::Error::kIo);
    }
    Step step{field, field.pixels.lines > 0 ? *field.pixels.pixels : std::uint8_t{0}, {}};
    for (const core::Event& event : events) {
      step.events.push_back(event.id);
    }
    recordings.back().steps.push_back(step);
    return {};
  }
  core::Result<void> finish() override {
    recordings.back().finished = true;
    return {};
  }

  std::vector<Recording> recordings;
  bool fail_begin = false;
  bool fail_add = false;
};

/// Gives the recorder fields as a loop does; the state is the number of the step before.
class RecorderBench : public ::testing::Test {
 protected:
  RecorderBench() {
    camera_.width_px = 640;
    camera_.height_px = 480;
    settings_.memory_mb = 24;
    settings_.fields_after = 4;
  }

  void configure() {
    ASSERT_TRUE(recorder_->configure(settings_, camera_, kStateBytes));
    give_state();
  }

  void give_state() {
    const auto into = recorder_->state_wanted();
    if (!into.empty()) {
      ++states_;
      into[0] = static_cast<std::byte>(input_->field.number);
      recorder_->put_state(kStateBytes / 2);
    }
  }

  void step() {
    core::Field& field = input_->field;
    field.number = next_++;
    field.mid_exposure = since_start_ + field.number * kFieldSpan;
    field.parity = field.number % 2 == 0 ? core::Parity::kEven : core::Parity::kOdd;
    std::fill(frame_.begin(), frame_.end(), static_cast<std::uint8_t>(field.number));
    field.pixels = core::field_of({frame_.data(), 640, 480, 640}, field.parity);
    if (field.status == core::FieldStatus::kMissing) {
      field.pixels = {};
    }
    recorder_->take(*input_, *output_);
    give_state();
    input_->events.clear();
    output_->replies.clear();
    field.status = core::FieldStatus::kGood;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      step();
    }
  }
  void reply(core::ClaimVerdict verdict, core::TubeAddress claimed = {1, 2}) {
    core::Reply reply;
    core::ClaimReply claim;
    claim.claimed = claimed;
    claim.verdict = verdict;
    reply.content = claim;
    ASSERT_TRUE(output_->replies.try_push_back(reply));
  }
  void write_all() {
    while (recorder_->write_next(store_)) {
    }
  }

  core::CameraSettings camera_;
  RecorderSettings settings_;
  std::unique_ptr<EventRecorder> recorder_ = std::make_unique<EventRecorder>();
  FakeRecordingStore store_;
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  std::vector<std::uint8_t> frame_ = std::vector<std::uint8_t>(640UL * 480UL);
  std::int64_t next_ = 0;
  core::FieldTime since_start_{0};  ///< of what would be field 0
  int states_ = 0;
};

}  // namespace tubesight::board
