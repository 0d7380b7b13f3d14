#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"
#include "core/tracking/tracker.h"

// How a tracker begins; following the sheet is in tracker.cpp.
namespace tubesight::core::tracking {

template <Scalar S>
void Tracker<S>::start(const Field& field) {
  state_ = TrackState::kWaiting;
  reason_ = Reason::kStartRefused;
  primary_.forget();
  motion_ = {};
  doubt_.clear();
  old_pictures_.begin();
  clock_.begin();
  order_.begin();
  observer_.begin();
  if (field.status != FieldStatus::kGood) {
    start_refusal_ = StartRefusal::kPicture;
    return;
  }
  SheetPose<S> pose;
  start_refusal_ = observer_.find_start(field.pixels, clicks_, pose);
  if (start_refusal_ != StartRefusal::kNone) {
    return;
  }
  // The rough pose of three bisected tube-ends is refined on the whole window until it settles.
  Observation<S> outcome;
  outcome.pose = pose;
  for (int round = 0; round < 4; ++round) {
    outcome = observer_.observe(field.pixels,
                                {outcome.pose, from_scaled<Mm<S>>(2, 0), false, round == 3});
    if (!outcome.fitted) {
      break;
    }
  }
  if (!outcome.fitted || outcome.contradiction || outcome.fit.used < 3) {
    start_refusal_ = StartRefusal::kPicture;
    observer_.clear_field();  // addresses that were refuted are not told
    return;
  }
  if (!confirms_clicks(outcome)) {
    start_refusal_ = StartRefusal::kAddresses;
    observer_.clear_field();
    return;
  }
  accept(outcome, field, Unit<S>{});
}

// Each click must lie within the bore of the very tube that it was given the address of, and the
// window's tube-ends must lie on the fitted plane: clicks far apart would let one wrong address
// pass as a bad fit of three.
template <Scalar S>
bool Tracker<S>::confirms_clicks(const Observation<S>& outcome) const {
  if (outcome.fit.rms_px > Px<S>(1)) {
    return false;
  }
  for (const StartClick& click : clicks_) {
    const auto at =
        to_sheet<S>(*model_, outcome.pose,
                    {from_scaled<Px<S>>(click.u_q16, 16), from_scaled<Px<S>>(click.v_q16, 16)});
    if (!at) {
      return false;
    }
    const auto off = *at - model_->lattice.offset(outcome.pose.anchor, click.address);
    if (plane_length(off) > model_->bore_radius_mm) {
      return false;
    }
  }
  return true;
}

#define TUBESIGHT_INSTANTIATE(S)                 \
  template void Tracker<S>::start(const Field&); \
  template bool Tracker<S>::confirms_clicks(const Observation<S>&) const;
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
