#include "core/verification/pose_requests.h"

namespace tubesight::core::verification {
namespace {

// A tool that moves faster than this shows it between two pictures of an average.
constexpr std::int32_t kAtRest_um_s = 5000;

bool is_moving(const Sighting& sighting) {
  const auto fast = [](std::int32_t speed) {
    return speed > kAtRest_um_s || speed < -kAtRest_um_s;
  };
  return sighting.velocity_known &&
         (fast(sighting.velocity_um_s[0]) || fast(sighting.velocity_um_s[1]));
}

}  // namespace

PoseRequestReply PoseRequests::take(const Event& request, const Sighting& sighting,
                                    const tracking::TubeSightingList& tubes, PoseOrder& order) {
  if (awaited_ > 0) {
    return {PoseReason::kBusy};
  }
  if (sighting.state != TrackState::kTracking) {
    return {PoseReason::kNotTracking};
  }
  if (is_moving(sighting)) {
    return {PoseReason::kMoving};
  }
  for (const TubeSighting& tube : tubes) {
    if (!tube.plug && tube.quality_permyriad > 0) {
      static_cast<void>(order.tubes.try_push_back({tube.address, tube.center_px}));
    }
  }
  order.wanted = true;
  order.id = request.id;
  order.origin = request.origin;
  awaited_ = kPoseRequestLasts;
  return {PoseReason::kNone};
}

PoseReply PoseRequests::judge(const PoseResult& pose, const Sighting& sighting) {
  awaited_ = 0;
  PoseReply reply{PoseVerdict::kRefused, {}, pose};
  if (pose.reason != PoseReason::kNone) {
    return reply;
  }
  reply.verdict = PoseVerdict::kUnknown;
  if (sighting.tool_known) {
    reply.tube = sighting.tool;
    reply.verdict =
        pose.nearest == sighting.tool ? PoseVerdict::kConfirmed : PoseVerdict::kContradicted;
  }
  return reply;
}

}  // namespace tubesight::core::verification
