#include "core/session/session.h"

#include "core/base/instantiate.h"
#include "core/tracking/tracking_setup.h"

namespace tubesight::core::session {
namespace {

using Verdict = Reply::Verdict;

Reply answer_claim(const Event& event, const Sighting& sighting) {
  Reply reply{EventKind::kClaim, Verdict::kUnknown, {}, {}};
  if (sighting.aligned) {
    reply.tube = sighting.tool;
    reply.verdict = event.claim == sighting.tool ? Verdict::kConfirmed : Verdict::kContradicted;
  }
  return reply;
}

template <Scalar S>
Reply answer_pick(const Event& event, const tracking::Tracker<S>& tracker) {
  Reply reply{EventKind::kPick, Verdict::kUnknown, {}, {}};
  if (tracker.identify(tracking::make_image_point(event.pick_px), reply.tube)) {
    reply.verdict = Verdict::kConfirmed;
  }
  return reply;
}

}  // namespace

template <Scalar S>
void Session<S>::step(const Input& input, Output& output) {
  output.replies.clear();
  output.lamp_permille = input.lamp_permille;
  for (const Event& event : input.events) {
    if (event.kind == EventKind::kStart) {
      tracker_.request_start(tracking::make_start_clicks(event.start));
    }
  }
  tracker_.step(input.field, output.sighting, output.tubes);
  for (const Event& event : input.events) {
    Reply reply{event.kind, Verdict::kNotServed, {}, {}};
    if (event.kind == EventKind::kClaim) {
      reply = answer_claim(event, output.sighting);
    } else if (event.kind == EventKind::kPick) {
      reply = answer_pick<S>(event, tracker_);
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
