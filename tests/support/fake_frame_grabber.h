#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hal/frame_grabber.h"

namespace tubesight::support {

/// A frame grabber whose fields the test scripts; they are delivered one a call.
class FakeFrameGrabber final : public hal::FrameGrabber {
 public:
  /// Fields have this many pixels in a line and lines.
  FakeFrameGrabber(std::int32_t width_px, std::int32_t lines)
      : width_px_(width_px), lines_(lines), pixels_(static_cast<std::size_t>(width_px * lines)) {}

  /// The next field shows `grey` all over.
  void script_field(std::uint8_t grey, const core::Field& like) {
    script_.push_back({grey, like, std::nullopt});
  }
  /// The next call fails. After kTimeout the script goes on; other errors stay.
  void script_error(core::Error error) { script_.push_back({0, {}, error}); }
  /// The next start() fails, once.
  void fail_start(core::Error error) { start_error_ = error; }

  core::Result<void> start() override {
    if (started_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (start_error_) {
      const core::Error error = *start_error_;
      start_error_.reset();
      return core::Unexpected(error);
    }
    started_ = true;
    return {};
  }

  void stop() override {
    TUBESIGHT_ASSERT(!lent_);
    started_ = false;
  }

  core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds) override {
    if (!started_ || lent_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (script_.empty()) {
      return core::Unexpected(core::Error::kEndOfData);
    }
    const Step step = script_.front();
    if (step.error) {
      if (*step.error == core::Error::kTimeout) {
        script_.pop_front();
      }
      return core::Unexpected(*step.error);
    }
    script_.pop_front();
    pixels_.assign(pixels_.size(), step.grey);
    core::Field field = step.field;
    field.pixels =
        core::field_of({pixels_.data(), width_px_, lines_, width_px_}, core::Parity::kProgressive);
    lent_ = true;
    return hal::FieldLease(*this, 0, field);
  }

  void give_back(std::int32_t) override { lent_ = false; }

 private:
  struct Step {
    std::uint8_t grey;
    core::Field field;
    std::optional<core::Error> error;
  };

  std::int32_t width_px_;
  std::int32_t lines_;
  std::vector<std::uint8_t> pixels_;
  std::deque<Step> script_;
  std::optional<core::Error> start_error_;
  bool started_ = false;
  bool lent_ = false;
};

}  // namespace tubesight::support
