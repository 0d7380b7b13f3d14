#include "board/box/overlay_snapshot.h"

#include <algorithm>

#include "core/tracking/candidates.h"
#include "core/tracking/margin_policy.h"

namespace tubesight::board {
namespace {

template <core::Scalar S, typename Margin>
std::optional<core::ImagePoint> locate(const core::tracking::Tracker<S, Margin>& tracker,
                                       core::TubeAddress address) {
  core::ImagePoint pixel;
  return tracker.locate(address, pixel) ? std::optional(pixel) : std::nullopt;
}

template <core::Scalar S, typename Margin>
std::optional<std::array<core::ImagePoint, 4>> locate_around(
    const core::tracking::Tracker<S, Margin>& tracker, core::TubeAddress tube) {
  std::array<core::ImagePoint, 4> around{};
  const bool located = tracker.locate({tube.row + 1, tube.column}, around[0]) &&
                       tracker.locate({tube.row - 1, tube.column}, around[1]) &&
                       tracker.locate({tube.row, tube.column + 1}, around[2]) &&
                       tracker.locate({tube.row, tube.column - 1}, around[3]);
  return located ? std::optional(around) : std::nullopt;
}

template <core::Scalar S, typename Margin>
void list_estimates(const core::tracking::Tracker<S, Margin>& tracker, OverlaySnapshot& snapshot) {
  core::tracking::CandidateList<S> expected;
  tracker.list_estimates(expected);
  for (const auto& tube : expected) {
    // The lists are of one capacity.
    static_cast<void>(snapshot.estimates.try_push_back(
        {tube.address,
         {core::to_scaled(tube.center_px.x, 16), core::to_scaled(tube.center_px.y, 16)},
         tube.state}));
  }
  for (const core::TubeSighting& seen : snapshot.tubes) {
    const auto same = std::find_if(
        snapshot.estimates.begin(), snapshot.estimates.end(),
        [&](const core::overlay::Estimate& estimate) { return estimate.address == seen.address; });
    if (seen.plug && same != snapshot.estimates.end()) {
      same->state = core::TubeState::kPlugged;
    }
  }
}

}  // namespace

template <core::Scalar S, typename Margin>
void describe(const core::session::Session<S, Margin>& session, const core::session::Output& output,
              const OverlayNews& news, std::int64_t field, bool estimates,
              OverlaySnapshot& snapshot) {
  snapshot.field = field;
  snapshot.sighting = output.sighting;
  snapshot.tubes = output.tubes;
  snapshot.next_row_px.reset();
  snapshot.next_column_px.reset();
  if (output.sighting.primary_known) {
    const core::TubeAddress primary = output.sighting.primary;
    snapshot.next_row_px = locate<S>(session.tracker(), {primary.row + 1, primary.column});
    snapshot.next_column_px = locate<S>(session.tracker(), {primary.row, primary.column + 1});
  }
  snapshot.around_tool_px.reset();
  if (output.sighting.tool_known) {
    snapshot.around_tool_px = locate_around<S>(session.tracker(), output.sighting.tool);
  }
  snapshot.news = news;
  snapshot.claimed_px.reset();
  if (news.claim() && news.claim()->verdict == core::ClaimVerdict::kContradicted) {
    snapshot.claimed_px = locate<S>(session.tracker(), news.claim()->claimed);
  }
  snapshot.estimates.clear();
  if (estimates) {
    list_estimates<S>(session.tracker(), snapshot);
  }
}

#define TUBESIGHT_INSTANTIATE(S, Margin)                                              \
  template void describe<S, Margin>(const core::session::Session<S, Margin>&,         \
                                    const core::session::Output&, const OverlayNews&, \
                                    std::int64_t, bool, OverlaySnapshot&);
TUBESIGHT_FOR_EACH_POLICY(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::board
