#include "core/session/session.h"

#include "core/base/instantiate.h"
#include "core/tracking/tracking_setup.h"

namespace tubesight::core::session {
namespace {

using Verdict = Reply::Verdict;

Reply answer_claim(const Event& event, const Sighting& sighting) {
  Reply reply{EventKind::kClaim, Verdict::kUnknown, {}, {}, {}};
  if (sighting.aligned) {
    reply.tube = sighting.tool;
    reply.verdict = event.claim == sighting.tool ? Verdict::kConfirmed : Verdict::kContradicted;
  }
  return reply;
}

template <Scalar S>
Reply answer_pick(const Event& event, const tracking::Tracker<S>& tracker) {
  Reply reply{EventKind::kPick, Verdict::kUnknown, {}, {}, {}};
  if (tracker.identify(tracking::make_image_point(event.pick_px), reply.tube)) {
    reply.verdict = Verdict::kConfirmed;
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

Reply answer_pose_result(const Event& event, const Sighting& sighting) {
  Reply reply{EventKind::kPoseResult, Verdict::kRefused, {}, {}, event.pose};
  if (event.pose.reason == PoseReason::kNone) {
    reply.verdict = Verdict::kUnknown;
    if (sighting.tool_known) {
      reply.tube = sighting.tool;
      reply.verdict =
          event.pose.nearest == sighting.tool ? Verdict::kConfirmed : Verdict::kContradicted;
    }
  }
  return reply;
}

}  // namespace

template <Scalar S>
Reply Session<S>::answer_pose_request(Output& output) {
  Reply reply{EventKind::kPoseRequest, Verdict::kRefused, {}, {}, {}};
  if (pose_awaited_ > 0) {
    reply.pose.reason = PoseReason::kBusy;
    return reply;
  }
  if (output.sighting.state != TrackState::kTracking) {
    reply.pose.reason = PoseReason::kNotTracking;
    return reply;
  }
  if (is_moving(output.sighting)) {
    reply.pose.reason = PoseReason::kMoving;
    return reply;
  }
  for (const TubeSighting& tube : output.tubes) {
    if (!tube.plug && tube.quality_permyriad > 0) {
      static_cast<void>(output.order.tubes.try_push_back({tube.address, tube.center_px}));
    }
  }
  output.order.wanted = true;
  pose_awaited_ = kPoseRequestLasts;
  reply.verdict = Verdict::kTaken;
  reply.pose.reason = PoseReason::kNone;
  return reply;
}

template <Scalar S>
void Session<S>::step(const Input& input, Output& output) {
  output.replies.clear();
  output.lamp_permille = input.lamp_permille;
  output.order.wanted = false;
  output.order.tubes.clear();
  pose_awaited_ = pose_awaited_ > 0 ? pose_awaited_ - 1 : 0;
  for (const Event& event : input.events) {
    if (event.kind == EventKind::kStart) {
      tracker_.request_start(tracking::make_start_clicks(event.start));
    }
  }
  tracker_.step(input.field, output.sighting, output.tubes);
  for (const Event& event : input.events) {
    Reply reply{event.kind, Verdict::kNotServed, {}, {}, {}};
    if (event.kind == EventKind::kClaim) {
      reply = answer_claim(event, output.sighting);
    } else if (event.kind == EventKind::kPick) {
      reply = answer_pick<S>(event, tracker_);
    } else if (event.kind == EventKind::kPoseRequest) {
      reply = answer_pose_request(output);
    } else if (event.kind == EventKind::kPoseResult) {
      pose_awaited_ = 0;
      reply = answer_pose_result(event, output.sighting);
    } else if (event.kind == EventKind::kStart) {
      reply.refusal = tracker_.start_refusal();
      reply.verdict =
          reply.refusal == tracking::StartRefusal::kNone ? Verdict::kTaken : Verdict::kRefused;
    }
    static_cast<void>(output.replies.try_push_back(reply));
  }
}

TUBESIGHT_INSTANTIATE_CLASS(Session)

}  // namespace tubesight::core::session
