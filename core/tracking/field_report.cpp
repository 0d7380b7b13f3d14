#include "core/tracking/field_report.h"

#include <algorithm>
#include <cstdint>

#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// In 1/256 um: thousand times the millimetres at 8 bits.
template <typename M>
std::int32_t micrometres_q8(M value) {
  return static_cast<std::int32_t>(divide_rounded(std::int64_t{to_scaled(value, 16)} * 1000, 256));
}

template <typename P>
ImagePoint image_point(const Vector2<P>& at) {
  return {to_scaled(at.x, 16), to_scaled(at.y, 16)};
}

}  // namespace

template <Scalar S>
NearestTube<S> find_nearest_tube(const TrackingModel<S>& model, const Place<S>& place) {
  NearestTube<S> nearest;
  nearest.address = model.lattice.nearest(place.pose.anchor, place.tool.local);
  nearest.off = place.tool.local - model.lattice.offset(place.pose.anchor, nearest.address);
  nearest.to_edge_mm = model.lattice.distance_to_cell_edge(nearest.address, nearest.off);
  return nearest;
}

template <Scalar S>
bool locate_tube(const TrackingModel<S>& model, const SheetPose<S>& pose, TubeAddress address,
                 ImagePoint& pixel) {
  const auto found = project<S>(model, pose, model.lattice.offset(pose.anchor, address));
  if (found) {
    pixel = image_point(*found);
  }
  return found.has_value();
}

template <Scalar S>
void report_tubes(const FieldRecord<S>& record, const PrimaryTube& primary, Sighting& sighting,
                  TubeSightingList& tubes) {
  for (const auto& tube : record.measured) {
    TubeSighting seen;
    seen.address = tube.address;
    seen.center_px = image_point(tube.center_px);
    // The share of rim points used, less the spread of their distances: 1 is a perfect rim.
    const std::int32_t share = tube.edges * 10000 / kRimPoints;
    const std::int32_t spread = std::min(to_scaled(tube.rms_px, 10), 1000);
    seen.quality_permyriad = tube.used ? std::max(share - share * spread / 1024, 1) : 0;
    seen.contrast_q4 = tube.contrast_q4;
    sighting.tracked += tube.used ? 1 : 0;
    static_cast<void>(tubes.try_push_back(seen));
    if (primary.is(tube.address)) {
      sighting.primary_known = true;
      sighting.primary = tube.address;
      sighting.primary_px = seen.center_px;
    }
  }
  for (const auto& plug : record.plugs_seen) {
    TubeSighting seen;
    seen.address = plug.address;
    seen.center_px = image_point(plug.center_px);
    seen.plug = true;
    static_cast<void>(tubes.try_push_back(seen));
  }
}

template <Scalar S>
void report_axis(const TrackingModel<S>& model, const Place<S>& place, const Motion<S>& motion,
                 Sighting& sighting) {
  sighting.axis_known = true;
  sighting.height_um_q8 = micrometres_q8(place.tool.height_mm);
  if (const auto pixel = to_pixel<S>(model, place.tool.point)) {
    sighting.axis_px = image_point(*pixel);
  }
  sighting.velocity_known = motion.known;
  sighting.velocity_span_us =
      static_cast<std::int32_t>(std::int64_t{to_scaled(motion.interval_s, 16)} * 1'000'000 / 65536);
  sighting.velocity_um_s = {micrometres_q8(motion.velocity_mm_s.x) / 256,
                            micrometres_q8(motion.velocity_mm_s.y) / 256};
}

template <Scalar S>
void report_tool(const TrackingModel<S>& model, const SheetPose<S>& pose,
                 const NearestTube<S>& nearest, Sighting& sighting) {
  sighting.tool_known = true;
  sighting.tool = nearest.address;
  const Mm<S> offset = plane_length(nearest.off);
  sighting.offset_um_q8 = micrometres_q8(offset);
  sighting.displacement_um_q8 = {micrometres_q8(nearest.off.x), micrometres_q8(nearest.off.y)};
  static_cast<void>(locate_tube<S>(model, pose, nearest.address, sighting.tool_px));
  sighting.aligned = sighting.judged && offset <= model.aligned_within_mm;
}

#define TUBESIGHT_INSTANTIATE(S)                                                           \
  template NearestTube<S> find_nearest_tube<S>(const TrackingModel<S>&, const Place<S>&);  \
  template bool locate_tube<S>(const TrackingModel<S>&, const SheetPose<S>&, TubeAddress,  \
                               ImagePoint&);                                               \
  template void report_tubes<S>(const FieldRecord<S>&, const PrimaryTube&, Sighting&,      \
                                TubeSightingList&);                                        \
  template void report_axis<S>(const TrackingModel<S>&, const Place<S>&, const Motion<S>&, \
                               Sighting&);                                                 \
  template void report_tool<S>(const TrackingModel<S>&, const SheetPose<S>&,               \
                               const NearestTube<S>&, Sighting&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
