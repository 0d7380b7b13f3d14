#pragma once

#include <algorithm>
#include <cstdint>

namespace tubesight::core::edges {

/// The threshold of the gradient operator as it follows the picture [Fallon 5.1.1, 6.2.1]: 75 % of
/// the last edge's gradient, halved where an edge is difficult.
///
/// Values are gradients per tap and path pair times twelve: those of Eq. 6.1, whose 24 pixels the
/// setting `initial_threshold` counts.
class DynamicThreshold {
 public:
  /// Below this the operator follows noise: three grey levels of step under Eq. 6.1.
  static constexpr std::int32_t kLeast = 36;

  /// No gradient of Eq. 6.1 is larger.
  static constexpr std::int32_t kMost = 510 * 6;

  DynamicThreshold() = default;
  explicit DynamicThreshold(std::int32_t initial) : value_(std::max(initial, kLeast)) {}

  /// The threshold for an operator with `taps` taps.
  [[nodiscard]] std::int32_t for_taps(std::int32_t taps) const { return value_ * taps / 6; }

  /// Takes the gradient of an edge found with `taps` taps; the threshold goes up to `most` at most.
  void follow(std::int32_t gradient, std::int32_t taps, std::int32_t most = kMost) {
    value_ = std::clamp(gradient * 6 / taps * 3 / 4, kLeast, most);
  }
  void halve() { value_ = std::max(value_ / 2, kLeast); }
  [[nodiscard]] bool at_least() const { return value_ <= kLeast; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [value] = self;
    stream.number(value, kLeast, 1 << 20);  // the settings' first value may be above kMost
  }

 private:
  std::int32_t value_ = 200;
};

}  // namespace tubesight::core::edges
