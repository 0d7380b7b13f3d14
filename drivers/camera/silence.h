#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "core/base/field.h"

namespace tubesight::drivers {

/// Says when a camera that delivers nothing, or nothing whole, is to be begun anew.
///
/// Some grabbers start in vain at every tenth time, and deliver at the next; of a camera on a
/// network the library tells a loss only after 5 s. A slow camera has its time.
class Silence {
 public:
  /// Without any picture for so long.
  static constexpr core::FieldTime kLongest = std::chrono::seconds(1);
  /// The same before the first one: a camera may have to settle.
  static constexpr core::FieldTime kLongestAtFirst = std::chrono::seconds(5);
  /// Without any whole one: a path that takes smaller packets than before, or a grabber that has
  /// lost its step. It passes with a new beginning, or not at all.
  static constexpr core::FieldTime kLongestBroken = std::chrono::seconds(5);
  /// The same of a slow camera, in fields.
  static constexpr std::int32_t kFields = 20;

  /// A stream begins at `now`.
  void begin(core::FieldTime now) {
    last_ = now;
    whole_ = now;
    settled_ = false;
  }
  /// A picture came at `now`.
  void broken(core::FieldTime now) {
    last_ = now;
    settled_ = true;
  }

  /// Up to the picture that came last nothing was wrong by its way or its driver.
  void whole() { whole_ = last_; }

  /// Whether nothing came for too long. `span`: from one field to the next.
  [[nodiscard]] bool too_long(core::FieldTime now, core::FieldTime span) const {
    return now - last_ >=
           std::max<core::FieldTime>(settled_ ? kLongest : kLongestAtFirst, kFields * span);
  }
  /// Whether pictures come, and none was whole for too long.
  [[nodiscard]] bool broken_for_long(core::FieldTime span) const {
    return last_ - whole_ >= std::max<core::FieldTime>(kLongestBroken, kFields * span);
  }
  /// When the last picture came; before the first one the beginning.
  [[nodiscard]] core::FieldTime last() const { return last_; }

 private:
  core::FieldTime last_{0};
  core::FieldTime whole_{0};
  bool settled_ = false;
};

}  // namespace tubesight::drivers
