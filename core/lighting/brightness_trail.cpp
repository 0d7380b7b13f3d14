#include "core/lighting/brightness_trail.h"

#include <algorithm>
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

/// Over the places that two fields have in common.
struct Sums {
  std::int64_t before = 0;
  std::int64_t now = 0;
  std::int64_t squares_before = 0;
  std::int64_t squares_now = 0;
  std::int64_t products = 0;

  void add(std::int64_t light_before, std::int64_t light_now) {
    before += light_before;
    now += light_now;
    squares_before += light_before * light_before;
    squares_now += light_now * light_now;
    products += light_before * light_now;
  }

  // With r = now / before, sum((now_i - r before_i)^2) / now^2. Below 2^18 a sum and 2^30 of
  // squares: 2^62 at most, as r is kept below 4.
  [[nodiscard]] LightChange change() const {
    const std::int64_t ratio_q14 = std::min<std::int64_t>((now << 14) / before, 4 << 14);
    const std::int64_t led = (squares_before * ratio_q14 >> 14) - 2 * products;
    const std::int64_t apart = std::max<std::int64_t>(squares_now + (led * ratio_q14 >> 14), 0);
    return {static_cast<std::int32_t>((now - before) * 131'072 / (now + before)),
            (apart << 16) / now * 65'536 / now};
  }
};

}  // namespace

std::optional<LightChange> BrightnessTrail::follow(const Field& field,
                                                   const TubeLightList& lights) {
  const std::size_t lines = field.parity == Parity::kOdd ? 0 : 1;
  const TubeLightList& before = last_[lines];
  const FieldTime since = field.mid_exposure - at_[lines];
  Sums sums;
  std::int32_t from = 0;
  for (const TubeLight& now : lights) {
    const TubeLight* const then = counts(now) ? find(before, now.address, from) : nullptr;
    if (then != nullptr && counts(*then)) {
      sums.add(then->light_q4, now.light_q4);
    }
  }
  last_[lines] = lights;
  at_[lines] = field.mid_exposure;
  if (sums.now == 0 || since <= FieldTime(0) || since > kLongest) {
    return std::nullopt;
  }
  return sums.change();
}

}  // namespace tubesight::core::lighting
