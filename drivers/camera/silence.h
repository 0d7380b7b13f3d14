#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "core/base/field.h"

namespace tubesight::drivers {

/// Says when a camera that delivers nothing is to be begun anew.
///
/// Some grabbers start in vain at every tenth time, and deliver at the next; of a camera on a
/// network the library tells a loss only after 5 s. A slow camera has its time.
class Silence {
 public:
  /// Without any picture for so long.
  static constexpr core::FieldTime kLongest = std::chrono::seconds(1);
  /// The same before the first one: a camera may have to settle.
  static constexpr core::FieldTime kLongestAtFirst = std::chrono::seconds(5);
  /// The same of a slow camera, in fields.
  static constexpr std::int32_t kFields = 20;

  /// A stream begins at `now`.
  void begin(core::FieldTime now) {
    begin_ = now;
    last_ = now;
    settled_ = false;
  }
  /// A picture came at `now`.
  void broken(core::FieldTime now) {
    last_ = now;
    settled_ = true;
  }

  /// Whether nothing came for too long. `span`: from one field to the next.
  [[nodiscard]] bool too_long(core::FieldTime now, core::FieldTime span) const {
    return now - last_ >=
           std::max<core::FieldTime>(settled_ ? kLongest : kLongestAtFirst, kFields * span);
  }
  /// Whether a camera that has nothing good yet has had time enough for it.
  [[nodiscard]] bool past_settling(core::FieldTime now) const {
    return now - begin_ >= kLongestAtFirst;
  }
  /// When the last picture came; before the first one the beginning.
  [[nodiscard]] core::FieldTime last() const { return last_; }

 private:
  core::FieldTime begin_{0};
  core::FieldTime last_{0};
  bool settled_ = false;
};

}  // namespace tubesight::drivers
