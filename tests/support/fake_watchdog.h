#pragma once

#include <cstdint>
#include <optional>

#include "hal/watchdog.h"

namespace tubesight::support {

/// A watchdog that counts its meals and fails when told to.
class FakeWatchdog final : public hal::Watchdog {
 public:
  /// The next start() fails, once.
  void fail_start(core::Error error) { start_error_ = error; }
  /// The next feed() fails, once.
  void fail_feed() { fails_feed_ = true; }

  [[nodiscard]] std::int64_t meals() const { return meals_; }
  [[nodiscard]] std::int64_t stops() const { return stops_; }

  core::Result<void> start(std::chrono::seconds timeout) override {
    if (timeout_.count() > 0) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (timeout.count() < 1) {
      return core::Unexpected(core::Error::kOutOfRange);
    }
    if (start_error_) {
      const core::Error error = *start_error_;
      start_error_.reset();
      return core::Unexpected(error);
    }
    timeout_ = timeout;
    return {};
  }

  void stop() override {
    stops_ += timeout_.count() > 0 ? 1 : 0;
    timeout_ = std::chrono::seconds(0);
  }

  core::Result<void> feed() override {
    if (timeout_.count() == 0) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (fails_feed_) {
      fails_feed_ = false;
      return core::Unexpected(core::Error::kDisconnected);
    }
    ++meals_;
    return {};
  }

  std::chrono::seconds timeout() const override { return timeout_; }

 private:
  std::optional<core::Error> start_error_;
  bool fails_feed_ = false;
  std::chrono::seconds timeout_{0};
  std::int64_t meals_ = 0;
  std::int64_t stops_ = 0;
};

}  // namespace tubesight::support
