#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {

/// How light changed: relative differences, 1/65536.
struct LightChange {
  std::int32_t mean_q16 = 0;  ///< the difference over the mean
  /// Square of the mean's deviation, as the single places' changes differ from one another: what
  /// noise and the tool's motion do to it, whatever the lamp does.
  std::int64_t scatter_q32 = 0;
};

/// Follows how the light on one and the same tube-ends changes from field to field, whatever enters
/// or leaves the picture meanwhile.
///
/// A field is compared with the last one of the same lines, so that which lines they are makes no
/// difference.
class BrightnessTrail {
 public:
  void begin() { *this = {}; }

  /// The change since the last field of that parity. Empty where there was none within a tenth of a
  /// second, or none of its places is there again. Places that glare or are faint do not count.
  [[nodiscard]] std::optional<LightChange> follow(const Field& field, const TubeLightList& lights);

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [last, at] = self;
    stream(last, at);
  }

 private:
  std::array<TubeLightList, 2> last_{};  ///< of the odd lines, and of others
  std::array<FieldTime, 2> at_{};
};

}  // namespace tubesight::core::lighting
