#include <algorithm>

#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"
#include "core/tracking/tracker.h"

// What a tracker says of the last field; following the sheet is in tracker.cpp.
namespace tubesight::core::tracking {

template <Scalar S>
void Tracker<S>::list_estimates(CandidateList<S>& estimates) const {
  estimates.clear();
  if (state_ == TrackState::kTracking || state_ == TrackState::kDegraded) {
    list_candidates<S>(*model_, *map_, shown_, estimates);
  }
}

template <Scalar S>
bool Tracker<S>::locate(TubeAddress address, ImagePoint& pixel) const {
  if (state_ != TrackState::kTracking && state_ != TrackState::kDegraded) {
    return false;
  }
  const auto local = model_->lattice.offset(shown_.anchor, address);
  const auto found = project<S>(*model_, shown_, local);
  if (found) {
    pixel = {to_scaled(found->x, 16), to_scaled(found->y, 16)};
  }
  return found.has_value();
}

template <Scalar S>
void Tracker<S>::report(const Field& field, Sighting& sighting, TubeSightingList& tubes) const {
  sighting = {};
  tubes.clear();
  sighting.time = field.mid_exposure;
  sighting.state = state_;
  sighting.reason = reason_;
  sighting.field = field.number;
  sighting.status = field.status;
  sighting.judged = measured_now_;
  if (measured_now_) {
    sighting.residual_px_q16 = to_scaled(residual_px_, 16);
  }
  for (const auto& tube : observer_.record().measured) {
    TubeSighting seen;
    seen.address = tube.address;
    seen.center_px = {to_scaled(tube.center_px.x, 16), to_scaled(tube.center_px.y, 16)};
    // The share of rim points used, less the spread of their distances: 1 is a perfect rim.
    const std::int32_t share = tube.edges * 10000 / kRimPoints;
    const std::int32_t spread = std::min(to_scaled(tube.rms_px, 10), 1000);
    seen.quality_permyriad = tube.used ? std::max(share - share * spread / 1024, 1) : 0;
    sighting.tracked += tube.used ? 1 : 0;
    static_cast<void>(tubes.try_push_back(seen));
    if (primary_.is(tube.address)) {
      sighting.primary_known = true;
      sighting.primary = tube.address;
      sighting.primary_px = seen.center_px;
    }
  }
  for (const auto& plug : observer_.record().plugs_seen) {
    TubeSighting seen;
    seen.address = plug.address;
    seen.center_px = {to_scaled(plug.center_px.x, 16), to_scaled(plug.center_px.y, 16)};
    seen.plug = true;
    static_cast<void>(tubes.try_push_back(seen));
  }
  // After a picture that refuted the prediction nothing is said of the tool until two agree.
  if (!doubt_.lasts() && (state_ == TrackState::kTracking || state_ == TrackState::kDegraded)) {
    report_tool(sighting);
  }
}

template <Scalar S>
void Tracker<S>::report_tool(Sighting& sighting) const {
  using M = Mm<S>;
  sighting.axis_known = true;
  // 1/256 um: thousand times the millimetres at 8 bits.
  const auto micrometres = [](M value) {
    return static_cast<std::int32_t>(
        divide_rounded(std::int64_t{to_scaled(value, 16)} * 1000, 256));
  };
  sighting.height_um_q8 = micrometres(tool_shown_.height_mm);
  if (const auto pixel = to_pixel<S>(*model_, tool_shown_.point)) {
    sighting.axis_px = {to_scaled(pixel->x, 16), to_scaled(pixel->y, 16)};
  }
  sighting.velocity_known = motion_.known;
  sighting.velocity_span_us = static_cast<std::int32_t>(
      std::int64_t{to_scaled(motion_.interval_s, 16)} * 1'000'000 / 65536);
  sighting.velocity_um_s = {micrometres(motion_.velocity_mm_s.x) / 256,
                            micrometres(motion_.velocity_mm_s.y) / 256};
  const TubeAddress nearest = model_->lattice.nearest(shown_.anchor, tool_shown_.local);
  const auto off = tool_shown_.local - model_->lattice.offset(shown_.anchor, nearest);
  const M to_edge = model_->lattice.distance_to_cell_edge(nearest, off);
  const M margin = gate_.margin(to_edge);
  sighting.margin_known = true;
  sighting.margin_permyriad =
      static_cast<std::int32_t>(divide_rounded(std::int64_t{to_scaled(margin, 16)} * 10000, 65536));
  // Four standard deviations from the rounding limit, or the address is not said.
  const bool certain = margin >= from_scaled<M>(4, 0) || !model_->margin_check;
  if (map_->state(nearest) == TubeState::kAbsent || !certain) {
    return;
  }
  sighting.tool_known = true;
  sighting.tool = nearest;
  const M offset = plane_length(off);
  sighting.offset_um_q8 = micrometres(offset);
  sighting.displacement_um_q8 = {micrometres(off.x), micrometres(off.y)};
  static_cast<void>(locate(nearest, sighting.tool_px));
  sighting.aligned = measured_now_ && offset <= model_->aligned_within_mm;
}

#define TUBESIGHT_INSTANTIATE(S)                                                      \
  template void Tracker<S>::list_estimates(CandidateList<S>&) const;                  \
  template bool Tracker<S>::locate(TubeAddress, ImagePoint&) const;                   \
  template void Tracker<S>::report(const Field&, Sighting&, TubeSightingList&) const; \
  template void Tracker<S>::report_tool(Sighting&) const;
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
