#include "core/tracking/bright_patch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"

namespace tubesight::core::tracking {
namespace {

// Sites that hang together with `first`, itself among them; they are marked as seen.
template <Scalar S>
std::int32_t count_around(const TrackingModel<S>& model, const SiteSightings::List& sites,
                          std::int32_t first, StaticVector<bool, 24>& seen) {
  // Neighbours in a row, a column or across: a step and a half of the shortest.
  const Mm<S> near = times(model.lattice.parameters().shortest_step, constant<Mm<S>>(1.5));
  StaticVector<std::int32_t, 24> reached;
  static_cast<void>(reached.try_push_back(first));
  seen[first] = true;
  for (std::int32_t next = 0; next < reached.size(); ++next) {
    for (std::int32_t i = 0; i < sites.size(); ++i) {
      if (seen[i] || plane_length(model.lattice.offset(sites[reached[next]], sites[i])) > near) {
        continue;
      }
      seen[i] = true;
      static_cast<void>(reached.try_push_back(i));
    }
  }
  return reached.size();
}

}  // namespace

template <Scalar S>
bool is_one_patch(const TrackingModel<S>& model, const SiteSightings::List& bright) {
  StaticVector<bool, 24> seen;
  for (std::int32_t i = 0; i < bright.size(); ++i) {
    static_cast<void>(seen.try_push_back(false));
  }
  std::int32_t largest = 0;
  for (std::int32_t i = 0; i < bright.size(); ++i) {
    if (!seen[i]) {
      largest = std::max(largest, count_around<S>(model, bright, i, seen));
    }
  }
  return 5 * largest >= 4 * bright.size();
}

#define TUBESIGHT_INSTANTIATE(S) \
  template bool is_one_patch<S>(const TrackingModel<S>&, const SiteSightings::List&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
