#include "core/tracking/map_shift.h"

#include <algorithm>
#include <cstdint>

#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

constexpr std::int32_t kFarthest = 3;         // steps each way
constexpr std::int32_t kLeastDifference = 3;  // contradictions

// Sites that contradict the settings when all addresses are `off`; counting ends beyond `most`.
template <Scalar S>
std::int32_t contradictions(const tubesheet::SheetMap& map, const FieldRecord<S>& record,
                            TubeAddress off, std::int32_t most) {
  std::int32_t count = 0;
  const auto is_open = [&](TubeAddress address) {
    return map.state({address.row + off.row, address.column + off.column}) == TubeState::kOpen;
  };
  const auto count_closed = [&](const SiteSightings::List& list) {
    for (std::int32_t i = 0; i < list.size() && count <= most; ++i) {
      count += is_open(list[i]) ? 1 : 0;
    }
  };
  for (std::int32_t i = 0; i < record.sites.open.size() && count <= most; ++i) {
    count += is_open(record.sites.open[i]) ? 0 : 1;
  }
  for (std::int32_t i = 0; i < record.measured.size() && count <= most; ++i) {
    count += is_open(record.measured[i].address) ? 0 : 1;
  }
  count_closed(record.sites.closed);
  count_closed(record.sites.bright);
  return count;
}

}  // namespace

template <Scalar S>
bool fits_other_addresses(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                          const FieldRecord<S>& record) {
  const std::int32_t here = record.sites.open.size() + record.sites.bright.size();
  // Tube-ends that nobody listed as plugged are no rarity: alone they need to be one more.
  const std::int32_t least = record.sites.open.empty() ? kLeastDifference + 1 : kLeastDifference;
  if (here < least || record.measured.empty()) {
    return false;
  }
  const std::int32_t most = std::min(here - least, here / 4);
  const TubeAddress anchor = record.measured[0].address;
  for (std::int32_t row = -kFarthest; row <= kFarthest; ++row) {
    for (std::int32_t column = -kFarthest; column <= kFarthest; ++column) {
      // An offset that leads from tubes to no address of this numbering is none.
      if (model.lattice.has({anchor.row + row, anchor.column + column}) &&
          contradictions<S>(map, record, {row, column}, most) <= most) {
        return true;
      }
    }
  }
  return false;
}

template <Scalar S>
bool fits_an_edge(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                  const FieldRecord<S>& record) {
  constexpr std::int32_t kLongest = 128;  // steps
  const std::int32_t here = record.sites.open.size() + record.sites.bright.size();
  if (here <= kLeastDifference || record.measured.empty()) {
    return false;
  }
  const std::int32_t most = std::min(here - kLeastDifference, here / 4);
  const TubeAddress anchor = record.measured[0].address;
  const auto fits = [&](TubeAddress off) {
    return model.lattice.has({anchor.row + off.row, anchor.column + off.column}) &&
           contradictions<S>(map, record, off, most) <= most;
  };
  for (std::int32_t steps = 1; steps <= kLongest; ++steps) {
    if (fits({steps, 0}) || fits({-steps, 0}) || fits({0, steps}) || fits({0, -steps})) {
      return true;
    }
  }
  return false;
}

#define TUBESIGHT_INSTANTIATE(S)                                                             \
  template bool fits_an_edge<S>(const TrackingModel<S>&, const tubesheet::SheetMap&,         \
                                const FieldRecord<S>&);                                      \
  template bool fits_other_addresses<S>(const TrackingModel<S>&, const tubesheet::SheetMap&, \
                                        const FieldRecord<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
