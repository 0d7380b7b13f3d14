#include "core/tracking/confirmed_start.h"

#include <array>

#include "core/base/instantiate.h"
#include "core/base/overflow.h"
#include "core/tracking/map_watch.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// The window's tube-ends must lie on the fitted plane: clicks far apart would let one wrong address
// pass as a bad fit of three.
template <Scalar S>
StartAnswer confirm_clicks(const TrackingModel<S>& model, const Observation<S>& seen,
                           const StartClickList& clicks) {
  // As ragged as the sheet is: a pixel in usual pictures, as many more in larger ones.
  if (seen.fit.rms_px > from_scaled<Px<S>>(model.reading_step_px, 0)) {
    return StartRefusal::kAddresses;
  }
  for (std::int32_t i = 0; i < clicks.size(); ++i) {
    const StartClick& click = clicks[i];
    const auto at =
        to_sheet<S>(model, seen.pose,
                    {from_scaled<Px<S>>(click.u_q16, 16), from_scaled<Px<S>>(click.v_q16, 16)});
    if (!at || plane_length(*at - model.lattice.offset(seen.pose.anchor, click.address)) >
                   model.bore_radius_mm) {
      return {StartRefusal::kAddresses, i};
    }
  }
  return {};
}

// How a start is tried.
struct Attempt {
  ClickSearch search = ClickSearch::kBisected;
  std::int32_t rough_q4 = 0;  // how far the clicked tube-ends may mislead, 1/16 mm
};

template <Scalar S>
StartAnswer try_start(StartSearch<S>& search, const Attempt& attempt, SheetObserver<S>& observer,
                      Observation<S>& seen) {
  constexpr int kRounds = 4;
  seen = {};
  const auto& clicked = search.by(attempt.search);
  observer.begin(clicked.light);
  if (clicked.overflowed) {
    raise_overflow_flag();
  }
  if (!clicked.answer.taken()) {
    return clicked.answer;
  }
  seen.pose = clicked.pose;
  const Mm<S> rough = from_scaled<Mm<S>>(attempt.rough_q4, 4);
  for (int round = 1; round <= kRounds; ++round) {
    seen = observer.observe(search.field(), {seen.pose, rough, false, round == kRounds});
    if (!seen.fitted) {
      break;
    }
  }
  if (!seen.fitted || seen.contradiction || seen.fit.used < 3) {
    return StartRefusal::kPicture;
  }
  if (const StartAnswer confirmed = confirm_clicks<S>(search.model(), seen, search.clicks());
      !confirmed.taken()) {
    return confirmed;
  }
  const bool refuted =
      MapWatch::refuted_by(observer.record().sites) || observer.fits_other_addresses();
  return refuted ? StartRefusal::kMap : StartRefusal::kNone;
}

}  // namespace

template <Scalar S>
StartAnswer find_confirmed_start(StartSearch<S>& search, SheetObserver<S>& observer,
                                 Observation<S>& seen) {
  // Bisection is enough in a clean picture. Circles mislead less; at their last attempt so little
  // that the tube-ends around need no bisection either.
  constexpr std::array kAttempts{Attempt{ClickSearch::kBisected, 2 * 16},
                                 Attempt{ClickSearch::kRound, 2 * 16},
                                 Attempt{ClickSearch::kRound, 16}};
  StartAnswer answer;
  for (const Attempt& attempt : kAttempts) {
    static_cast<void>(take_overflow_flag());  // of a pose that is not used
    answer = try_start<S>(search, attempt, observer, seen);
    // What the map refutes it would refute again, and circles are looked for once, but where the
    // window did not confirm them.
    const bool final = answer.taken() || answer.refusal == StartRefusal::kTooFew ||
                       answer.refusal == StartRefusal::kMap;
    const bool by_clicks =
        attempt.search == ClickSearch::kRound && answer.refusal != StartRefusal::kPicture;
    if (final || by_clicks) {
      break;
    }
  }
  return answer;
}

#define TUBESIGHT_INSTANTIATE(S) \
  template StartAnswer find_confirmed_start<S>(StartSearch<S>&, SheetObserver<S>&, Observation<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
