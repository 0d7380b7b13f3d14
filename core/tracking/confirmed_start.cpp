#include "core/tracking/confirmed_start.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/map_watch.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// The window's tube-ends must lie on the fitted plane: clicks far apart would let one wrong address
// pass as a bad fit of three.
template <Scalar S>
bool confirms_clicks(const TrackingModel<S>& model, const Observation<S>& seen,
                     const StartClickList& clicks) {
  // As ragged as the sheet is: a pixel in usual pictures, as many more in larger ones.
  if (seen.fit.rms_px > from_scaled<Px<S>>(model.reading_step_px, 0)) {
    return false;
  }
  for (const StartClick& click : clicks) {
    const auto at =
        to_sheet<S>(model, seen.pose,
                    {from_scaled<Px<S>>(click.u_q16, 16), from_scaled<Px<S>>(click.v_q16, 16)});
    if (!at) {
      return false;
    }
    const auto off = *at - model.lattice.offset(seen.pose.anchor, click.address);
    if (plane_length(off) > model.bore_radius_mm) {
      return false;
    }
  }
  return true;
}

}  // namespace

template <Scalar S>
StartRefusal find_confirmed_start(const TrackingModel<S>& model, const FieldView& field,
                                  const StartClickList& clicks, SheetObserver<S>& observer,
                                  Observation<S>& seen) {
  constexpr int kRounds = 4;
  seen = {};
  const StartRefusal refusal = observer.find_start(field, clicks, seen.pose);
  if (refusal != StartRefusal::kNone) {
    return refusal;
  }
  const Mm<S> rough = constant<Mm<S>>(2.0);  // how far three bisected tube-ends may mislead
  for (int round = 1; round <= kRounds; ++round) {
    seen = observer.observe(field, {seen.pose, rough, false, round == kRounds});
    if (!seen.fitted) {
      break;
    }
  }
  if (!seen.fitted || seen.contradiction || seen.fit.used < 3) {
    return StartRefusal::kPicture;
  }
  if (!confirms_clicks<S>(model, seen, clicks)) {
    return StartRefusal::kAddresses;
  }
  const bool refuted =
      MapWatch::refuted_by(observer.record().sites) || observer.fits_other_addresses();
  return refuted ? StartRefusal::kMap : StartRefusal::kNone;
}

#define TUBESIGHT_INSTANTIATE(S)                                                           \
  template StartRefusal find_confirmed_start<S>(const TrackingModel<S>&, const FieldView&, \
                                                const StartClickList&, SheetObserver<S>&,  \
                                                Observation<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
