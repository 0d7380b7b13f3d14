#include "core/tracking/circle_shift.h"

#include <cstdint>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/base/static_vector.h"
#include "core/tracking/clicked_tube.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

constexpr std::int32_t kLooks = 4;

template <Scalar S>
using Shifts = StaticVector<Vector2<Mm<S>>, kLooks>;

// Where the circles found are on the sheet, off the places that the pose gives them.
template <Scalar S>
Shifts<S> find_shifts(const TrackingModel<S>& model, const FieldView& field,
                      const CandidateList<S>& candidates, const SheetPose<S>& pose) {
  Shifts<S> shifts;
  std::int32_t looks = 0;
  for (const Candidate<S>& candidate : candidates) {
    if (looks == kLooks) {
      break;
    }
    if (candidate.state != TubeState::kOpen) {
      continue;
    }
    ++looks;
    const ClickedTube tube = find_circle<S>(model, field, rounded(candidate.center_px.x),
                                            rounded(candidate.center_px.y));
    if (!tube.found) {
      continue;
    }
    const auto at = to_sheet<S>(
        model, pose,
        {from_scaled<Px<S>>(tube.center_u_q16, 16), from_scaled<Px<S>>(tube.center_v_q16, 16)});
    if (at) {
      static_cast<void>(shifts.try_push_back(*at - candidate.local));
    }
  }
  return shifts;
}

}  // namespace

template <Scalar S>
bool shift_onto_circles(const TrackingModel<S>& model, const FieldView& field,
                        const CandidateList<S>& candidates, Mm<S> reach_mm, SheetPose<S>& pose) {
  const Shifts<S> shifts = find_shifts<S>(model, field, candidates, pose);
  // As for bisected ones: a tenth of the lattice step.
  const Mm<S> near = times(model.lattice.parameters().shortest_step, constant<Mm<S>>(0.1));
  std::int32_t most = 0;
  Vector2<Mm<S>> best{};
  for (const auto& shift : shifts) {
    std::int32_t agreeing = 0;
    for (const auto& other : shifts) {
      const auto off = other - shift;
      agreeing += absolute(off.x) < near && absolute(off.y) < near ? 1 : 0;
    }
    if (agreeing > most) {
      most = agreeing;
      best = shift;
    }
  }
  if (most < 2 || 2 * most < shifts.size() || absolute(best.x) > reach_mm ||
      absolute(best.y) > reach_mm) {
    return false;
  }
  pose.origin = pose.origin + pose.along(best);
  return true;
}

#define TUBESIGHT_INSTANTIATE(S)                                                 \
  template bool shift_onto_circles<S>(const TrackingModel<S>&, const FieldView&, \
                                      const CandidateList<S>&, Mm<S>, SheetPose<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
