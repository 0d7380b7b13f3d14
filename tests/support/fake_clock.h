#pragma once

#include "core/base/assert.h"
#include "hal/clock.h"

namespace tubesight::support {

/// A clock that the test moves.
class FakeClock final : public hal::Clock {
 public:
  /// Lets that much time pass, 0 or more.
  void advance(core::FieldTime span) {
    TUBESIGHT_ASSERT(span >= core::FieldTime(0));
    now_ += span;
  }

  [[nodiscard]] core::FieldTime now() const override { return now_; }

 private:
  core::FieldTime now_{0};
};

}  // namespace tubesight::support
