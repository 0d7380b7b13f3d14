#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "hal/robot_link.h"

namespace tubesight::support {

/// A line whose robot is the test: it says events, and hears what the box sends.
class FakeRobotLink final : public hal::RobotLink {
 public:
  /// A message of the robot arrives.
  void say(const core::Event& event) { arrived_.push_back({event, std::nullopt}); }
  /// A message arrives garbled (kDataLoss), or the line fails once (kIo).
  void say_error(core::Error error) { arrived_.push_back({{}, error}); }
  /// The robot goes away, or comes back.
  void connect(bool connected) { connected_ = connected; }
  /// The line takes this many replies more.
  void limit_replies(int room) { room_ = room; }
  /// The next start() fails, once.
  void fail_start(core::Error error) {
    start_error_ = error;
    start_fails_ = true;
  }

  [[nodiscard]] const std::vector<core::Reply>& replies() const { return replies_; }
  [[nodiscard]] const std::vector<core::Sighting>& sightings() const { return sightings_; }

  core::Result<void> start() override {
    if (started_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (start_fails_) {
      start_fails_ = false;
      return core::Unexpected(start_error_);
    }
    started_ = true;
    return {};
  }

  void stop() override {
    started_ = false;
    arrived_.clear();
  }

  core::Result<std::optional<core::Event>> poll_event() override {
    if (const auto ready = usable(); !ready) {
      return core::Unexpected(ready.error());
    }
    if (arrived_.empty()) {
      return std::optional<core::Event>();
    }
    const Arrival arrival = arrived_.front();
    arrived_.pop_front();
    if (arrival.error) {
      return core::Unexpected(*arrival.error);
    }
    return std::optional<core::Event>(arrival.event);
  }

  core::Result<void> send_reply(const core::Reply& reply) override {
    TUBESIGHT_TRY(usable());
    if (room_ == 0) {
      return core::Unexpected(core::Error::kBufferTooSmall);
    }
    room_ -= room_ > 0 ? 1 : 0;
    replies_.push_back(reply);
    return {};
  }

  core::Result<void> send_sighting(const core::Sighting& sighting) override {
    TUBESIGHT_TRY(usable());
    if (room_ != 0) {
      sightings_.push_back(sighting);
    }
    return {};
  }

 private:
  struct Arrival {
    core::Event event;
    std::optional<core::Error> error;
  };

  [[nodiscard]] core::Result<void> usable() const {
    if (!started_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (!connected_) {
      return core::Unexpected(core::Error::kDisconnected);
    }
    return {};
  }

  std::deque<Arrival> arrived_;
  std::vector<core::Reply> replies_;
  std::vector<core::Sighting> sightings_;
  core::Error start_error_ = core::Error::kIo;
  bool start_fails_ = false;
  int room_ = -1;  ///< below 0: without limit
  bool started_ = false;
  bool connected_ = true;
};

}  // namespace tubesight::support
