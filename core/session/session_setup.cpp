// From settings to the numbers of the path; apart from step() because it computes in double.

#include "core/session/session.h"
#include "core/session/settings_digest.h"
#include "core/tracking/tracking_setup.h"

namespace tubesight::core::session {

template <Scalar S, typename Margin>
Result<void> Session<S, Margin>::configure(const SessionSettings& settings) {
  TUBESIGHT_TRY(tracking::make_tracking_model<S>(settings, model_));
  const double step_mm =
      to_scaled(model_.lattice.parameters().shortest_step, 16) / 65536.0;  // of the path's numbers
  claims_.configure(
      verification::make_claim_limits(settings.verification, settings.motion, step_mm));
  starts_.configure();
  settings_digest_ = settings_digest(settings);
  return map_.assign(settings.tubesheet);
}

#define TUBESIGHT_INSTANTIATE(S, Margin) \
  template Result<void> Session<S, Margin>::configure(const SessionSettings&);
TUBESIGHT_FOR_EACH_POLICY(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::session
