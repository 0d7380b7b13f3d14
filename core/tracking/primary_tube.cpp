#include "core/tracking/primary_tube.h"

#include <cstdint>

#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

template <typename P>
std::int64_t squared_distance(const Vector2<P>& a, const Vector2<P>& b) {
  const std::int32_t u = to_scaled(a.x, 0) - to_scaled(b.x, 0);
  const std::int32_t v = to_scaled(a.y, 0) - to_scaled(b.y, 0);
  return std::int64_t{u} * u + std::int64_t{v} * v;
}

}  // namespace

template <Scalar S>
void PrimaryTube::choose(std::span<const TubeMeasurement<S>> measured,
                         const Vector2<Px<S>>& optimum_px) {
  const auto distance2 = [&optimum_px](const TubeMeasurement<S>& tube) {
    return squared_distance(tube.center_px, optimum_px);
  };
  const TubeMeasurement<S>* nearest = nullptr;
  const TubeMeasurement<S>* kept = nullptr;
  for (const auto& tube : measured) {
    if (!tube.used) {
      continue;
    }
    if (nearest == nullptr || distance2(tube) < distance2(*nearest)) {
      nearest = &tube;
    }
    if (is(tube.address)) {
      kept = &tube;
    }
  }
  if (nearest == nullptr) {
    return;
  }
  // 10 % in distance is 19 % in its square.
  const bool stay = kept != nullptr && 100 * distance2(*nearest) >= 81 * distance2(*kept);
  address_ = stay ? kept->address : nearest->address;
  known_ = true;
}

#define TUBESIGHT_INSTANTIATE(S) \
  template void PrimaryTube::choose<S>(std::span<const TubeMeasurement<S>>, const Vector2<Px<S>>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
