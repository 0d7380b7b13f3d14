#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hal/operator_station.h"

namespace tubesight::support {

/// A station whose operator is the test: it does things, and reads what the box answers and shows.
class FakeOperatorStation final : public hal::OperatorStation {
 public:
  /// What show() was given, with the picture's first pixel.
  struct Shown {
    std::int32_t width_px = 0;
    std::int32_t height_px = 0;
    std::uint8_t red = 0;
    core::Sighting sighting;
  };

  /// The operator does something.
  void say(const core::Event& event) { done_.push_back({event, std::nullopt}); }
  /// Something was dropped (kDataLoss), or the station fails once (kIo).
  void say_error(core::Error error) { done_.push_back({{}, error}); }
  /// The station goes away, or comes back.
  void connect(bool connected) { connected_ = connected; }
  /// The station takes this many replies more.
  void limit_replies(int room) { room_ = room; }
  /// The next start() fails, once.
  void fail_start(core::Error error) { start_error_ = error; }

  [[nodiscard]] const std::vector<core::Reply>& replies() const { return replies_; }
  [[nodiscard]] const std::vector<Shown>& shown() const { return shown_; }

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
    started_ = false;
    done_.clear();
  }

  core::Result<std::optional<core::Event>> poll_event() override {
    if (const auto ready = usable(); !ready) {
      return core::Unexpected(ready.error());
    }
    if (done_.empty()) {
      return std::optional<core::Event>();
    }
    const Deed deed = done_.front();
    done_.pop_front();
    if (deed.error) {
      return core::Unexpected(*deed.error);
    }
    return std::optional<core::Event>(deed.event);
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

  core::Result<void> show(const core::RgbImageView& picture,
                          const core::Sighting& sighting) override {
    TUBESIGHT_TRY(usable());
    shown_.push_back({picture.width_px, picture.height_px, picture.pixels[0], sighting});
    return {};
  }

 private:
  struct Deed {
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

  std::deque<Deed> done_;
  std::vector<core::Reply> replies_;
  std::vector<Shown> shown_;
  std::optional<core::Error> start_error_;
  int room_ = -1;  ///< below 0: without limit
  bool started_ = false;
  bool connected_ = true;
};

}  // namespace tubesight::support
