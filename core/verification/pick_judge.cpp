#include "core/verification/pick_judge.h"

#include "core/base/instantiate.h"
#include "core/tracking/projection.h"
#include "core/tracking/tracking_setup.h"

namespace tubesight::core::verification {

template <Scalar S>
PickReply judge_pick(const Pick& pick, const RecentFields<S>& recent,
                     const tracking::TrackingModel<S>& model, const tubesheet::SheetMap& map) {
  const RecentField<S>* const seen =
      pick.seen_field ? recent.find(*pick.seen_field) : &recent.last();
  if (seen == nullptr) {
    return {PickDoubt::kUnknownField, {}};
  }
  if (seen->sighting.state != TrackState::kTracking &&
      seen->sighting.state != TrackState::kDegraded) {
    return {PickDoubt::kNotTracking, {}};
  }
  const ImagePoint at = tracking::make_image_point(pick.at_px);
  const auto inside = [](std::int32_t px_q16, std::int32_t size_px) {
    constexpr std::int32_t kHalf = 1 << 15;
    return px_q16 >= -kHalf && px_q16 <= (size_px << 16) - kHalf;
  };
  if (!inside(at.u_q16, model.picture_width_px) || !inside(at.v_q16, model.picture_height_px)) {
    return {PickDoubt::kNoTube, {}};
  }
  const auto local = tracking::to_sheet<S>(
      model, seen->pose, {from_scaled<Px<S>>(at.u_q16, 16), from_scaled<Px<S>>(at.v_q16, 16)});
  if (!local) {
    return {PickDoubt::kNoTube, {}};
  }
  const TubeAddress address = model.lattice.nearest(seen->pose.anchor, *local);
  if (map.state(address) == TubeState::kAbsent) {
    return {PickDoubt::kNoTube, {}};
  }
  return {PickDoubt::kNone, address};
}

#define TUBESIGHT_INSTANTIATE(S)                                        \
  template PickReply judge_pick<S>(const Pick&, const RecentFields<S>&, \
                                   const tracking::TrackingModel<S>&, const tubesheet::SheetMap&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::verification
