#include "core/session/session.h"

#include "core/base/instantiate.h"
#include "core/tracking/tracking_setup.h"

namespace tubesight::core::session {
namespace {

ClaimReply answer_claim(const Claim& claim, const Sighting& sighting) {
  ClaimReply reply;
  reply.claimed = claim.tube;
  if (sighting.aligned) {
    reply.tube = sighting.tool;
    reply.verdict =
        claim.tube == sighting.tool ? ClaimVerdict::kConfirmed : ClaimVerdict::kContradicted;
  }
  return reply;
}

template <Scalar S>
PickReply answer_pick(const Pick& pick, const tracking::Tracker<S>& tracker) {
  PickReply reply;
  if (!tracker.identify(tracking::make_image_point(pick.at_px), reply.tube)) {
    reply.doubt = PickDoubt::kNotTracking;
  }
  return reply;
}

// A tool that moves faster than this shows it between two pictures of an average.
constexpr std::int32_t kAtRest_um_s = 5000;

bool is_moving(const Sighting& sighting) {
  const auto fast = [](std::int32_t speed) {
    return speed > kAtRest_um_s || speed < -kAtRest_um_s;
  };
  return sighting.velocity_known &&
         (fast(sighting.velocity_um_s[0]) || fast(sighting.velocity_um_s[1]));
}

PoseReply answer_pose_result(const PoseResult& pose, const Sighting& sighting) {
  PoseReply reply{PoseVerdict::kRefused, {}, pose};
  if (pose.reason == PoseReason::kNone) {
    reply.verdict = PoseVerdict::kUnknown;
    if (sighting.tool_known) {
      reply.tube = sighting.tool;
      reply.verdict =
          pose.nearest == sighting.tool ? PoseVerdict::kConfirmed : PoseVerdict::kContradicted;
    }
  }
  return reply;
}

}  // namespace

template <Scalar S>
PoseRequestReply Session<S>::answer_pose_request(const Event& event, Output& output) {
  if (pose_awaited_ > 0) {
    return {PoseReason::kBusy};
  }
  if (output.sighting.state != TrackState::kTracking) {
    return {PoseReason::kNotTracking};
  }
  if (is_moving(output.sighting)) {
    return {PoseReason::kMoving};
  }
  for (const TubeSighting& tube : output.tubes) {
    if (!tube.plug && tube.quality_permyriad > 0) {
      static_cast<void>(output.order.tubes.try_push_back({tube.address, tube.center_px}));
    }
  }
  output.order.wanted = true;
  output.order.id = event.id;
  output.order.origin = event.origin;
  pose_awaited_ = kPoseRequestLasts;
  return {PoseReason::kNone};
}

template <Scalar S>
void Session<S>::step(const Input& input, Output& output) {
  output.replies.clear();
  output.lamp_permille = input.field.lamp_permille;
  output.order.wanted = false;
  output.order.tubes.clear();
  pose_awaited_ = pose_awaited_ > 0 ? pose_awaited_ - 1 : 0;
  for (const Event& event : input.events) {
    if (const auto* const start = content_if<Start>(event)) {
      tracker_.request_start(tracking::make_start_clicks(start->tubes));
    }
  }
  tracker_.step(input.field, output.sighting, output.tubes);
  for (const Event& event : input.events) {
    Reply reply{event.id, event.origin, input.field.mid_exposure, NotServedReply{}};
    std::visit(
        Overloaded{
            [&](const Claim& claim) { reply.content = answer_claim(claim, output.sighting); },
            [&](const Start&) { reply.content = StartReply{tracker_.start_refusal()}; },
            [&](const Pick& pick) { reply.content = answer_pick<S>(pick, tracker_); },
            [&](const PoseRequest&) { reply.content = answer_pose_request(event, output); },
            [&](const PoseResult& pose) {
              pose_awaited_ = 0;
              reply.content = answer_pose_result(pose, output.sighting);
            },
            [](const LampCommand&) {}, [](const Acknowledge&) {}},
        event.content);
    static_cast<void>(output.replies.try_push_back(reply));
  }
}

TUBESIGHT_INSTANTIATE_CLASS(Session)

}  // namespace tubesight::core::session
