#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/dimmer.h"

namespace tubesight::support {

/// A dimmer that remembers its levels and fails when told to.
class FakeDimmer final : public hal::Dimmer {
 public:
  /// The next start() fails, once.
  void fail_start(core::Error error) { start_error_ = error; }
  /// The next set_level() that would succeed fails, once.
  void fail_level(core::Error error) { level_error_ = error; }

  /// Levels set, in order; stop() sets 0.
  [[nodiscard]] const std::vector<std::int32_t>& levels() const { return levels_; }

  core::Result<void> start() override {
    if (started_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (start_error_) {
      return core::Unexpected(taken(start_error_));
    }
    started_ = true;
    return {};
  }

  void stop() override {
    if (started_) {
      levels_.push_back(0);
    }
    started_ = false;
    level_ = 0;
  }

  core::Result<void> set_level(std::int32_t permille) override {
    if (!started_) {
      return core::Unexpected(core::Error::kNotReady);
    }
    if (permille < 0 || permille > hal::kFullLevel_permille) {
      return core::Unexpected(core::Error::kOutOfRange);
    }
    if (level_error_) {
      return core::Unexpected(taken(level_error_));
    }
    level_ = permille;
    levels_.push_back(permille);
    return {};
  }

  std::int32_t level_permille() const override { return level_; }

 private:
  static core::Error taken(std::optional<core::Error>& error) {
    const core::Error value = *error;
    error.reset();
    return value;
  }

  std::vector<std::int32_t> levels_;
  std::optional<core::Error> start_error_;
  std::optional<core::Error> level_error_;
  std::int32_t level_ = 0;
  bool started_ = false;
};

}  // namespace tubesight::support
