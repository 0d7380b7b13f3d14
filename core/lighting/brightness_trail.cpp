#include "core/lighting/brightness_trail.h"

#include <cstddef>

namespace tubesight::core::lighting {
namespace {

constexpr FieldTime kLongest = std::chrono::milliseconds(100);

constexpr bool counts(const TubeLight& light) {
  return light.light_q4 >= kFaint_q4 && light.light_q4 < kGlaring_q4;
}

/// The place in `lights` from `from` on, around the end: lists of two fields are in about the same
/// order.
const TubeLight* find(const TubeLightList& lights, TubeAddress address, std::int32_t& from) {
  for (std::int32_t i = 0; i < lights.size(); ++i) {
    const std::int32_t at = from + i < lights.size() ? from + i : from + i - lights.size();
    if (lights[at].address == address) {
      from = at + 1 < lights.size() ? at + 1 : 0;
      return &lights[at];
    }
  }
  return nullptr;
}

}  // namespace

std::optional<std::int32_t> BrightnessTrail::follow(const Field& field,
                                                    const TubeLightList& lights) {
  const std::size_t lines = field.parity == Parity::kOdd ? 0 : 1;
  const TubeLightList& before = last_[lines];
  const FieldTime since = field.mid_exposure - at_[lines];
  std::int64_t sum_before = 0;
  std::int64_t sum_now = 0;
  std::int32_t from = 0;
  for (const TubeLight& now : lights) {
    const TubeLight* const then = counts(now) ? find(before, now.address, from) : nullptr;
    if (then != nullptr && counts(*then)) {
      sum_before += then->light_q4;
      sum_now += now.light_q4;
    }
  }
  last_[lines] = lights;
  at_[lines] = field.mid_exposure;
  if (sum_now == 0 || since <= FieldTime(0) || since > kLongest) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>((sum_now - sum_before) * 131'072 / (sum_now + sum_before));
}

}  // namespace tubesight::core::lighting
