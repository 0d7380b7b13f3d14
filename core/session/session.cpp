#include "core/session/session.h"

#include "core/tracking/tracking_setup.h"
#include "core/verification/pick_judge.h"

namespace tubesight::core::session {
namespace {

constexpr bool knows_place(TrackState state) {
  return state == TrackState::kTracking || state == TrackState::kDegraded;
}

/// For the lamp.
constexpr bool rests(const Sighting& sighting) {
  constexpr std::int32_t kRest_um_s = tracking::kRest_mm_s * 1000;
  const auto slow = [](std::int32_t speed) { return -kRest_um_s < speed && speed < kRest_um_s; };
  return sighting.velocity_known && slow(sighting.velocity_um_s[0]) &&
         slow(sighting.velocity_um_s[1]);
}

}  // namespace

template <Scalar S, typename Margin>
void Session<S, Margin>::step(const Input& input, Output& output) {
  output.replies.clear();
  output.lamp_permille = lamp_wanted_.value_or(input.field.lamp_permille);
  output.order.wanted = false;
  output.order.tubes.clear();
  poses_.age();
  starts_.look(input.field, knows_place(state_));
  const bool started = take_starts(input.field, input.events);
  tracker_.step(input.field, output.sighting, output.tubes);
  follow_lamp(input, output);
  if (started && tracker_.start_refusal() != StartRefusal::kElsewhere) {
    recent_.clear();  // a track that needed a new start does not vouch for the time before it
  }
  remember(output.sighting);
  claims_.answer_waiting(recent_, output.replies);
  std::int32_t start = 0;
  for (const Event& event : input.events) {
    answer(event, input, start, output);
  }
  if (output.lamp_ruled) {
    output.lamp_permille = lighting_.wanted_permille(lamp_wanted_, input.field.mid_exposure);
  }
  output.lamp_automatic = output.lamp_ruled && lighting_.follows_picture() && !lamp_wanted_;
}

// The last of several starts before one field is the one that counts; each gets its own answer.
// Says whether there is one for the tracker.
template <Scalar S, typename Margin>
bool Session<S, Margin>::take_starts(const Field& field, const EventList& events) {
  start_refusals_.clear();
  const Start* last = nullptr;
  for (const Event& event : events) {
    if (const auto* const start = content_if<Start>(event)) {
      if (last != nullptr) {
        static_cast<void>(start_refusals_.try_push_back(StartRefusal::kSuperseded));
      }
      last = start;
    }
  }
  if (last == nullptr) {
    return false;
  }
  // Without a picture nothing can be taken, and a track that is well goes on.
  const bool picture = field.status == FieldStatus::kGood;
  StartRefusal refusal = picture ? starts_.judge(*last) : StartRefusal::kPicture;
  if (refusal == StartRefusal::kNone && lighting_.liveness() == Liveness::kFailed) {
    refusal =
        StartRefusal::kNotLive;  // what is clicked on may be gone when pictures are live again
  }
  static_cast<void>(start_refusals_.try_push_back(refusal));
  if (refusal == StartRefusal::kNone) {
    tracker_.request_start(tracking::make_start_clicks(last->tubes), last->confirmed);
  }
  return refusal == StartRefusal::kNone;
}

// A picture that does not follow the lamp may be an old one, or another camera's: the tool may be
// anywhere, and on a bare lattice no picture would show it when it is live again. So the track is
// lost, and none begins until the pattern is seen.
template <Scalar S, typename Margin>
void Session<S, Margin>::follow_lamp(const Input& input, Output& output) {
  output.lamp_ruled = lighting_.rules();
  if (!output.lamp_ruled) {
    return;
  }
  lighting_.look({&input.field, output.tubes, model_.window, knows_place(output.sighting.state),
                  rests(output.sighting)});
  if (lighting_.liveness() == Liveness::kFailed && knows_place(output.sighting.state)) {
    tracker_.give_up(Reason::kNotLive, input.field, output.sighting, output.tubes);
  }
  if (lighting_.doubts()) {  // the track goes on, but which tube the tool is under is not said
    output.sighting.tool_known = false;
    output.sighting.aligned = false;
  }
  output.sighting.liveness = lighting_.liveness();
  output.lamp = lighting_.condition();
}

// The count of judged fields and the age are the session's, whatever happens to the track.
template <Scalar S, typename Margin>
void Session<S, Margin>::remember(Sighting& sighting) {
  state_ = sighting.state;
  if (sighting.judged) {
    ++judged_fields_;
    last_judged_ = sighting.time;
  }
  if (sighting.state == TrackState::kLost &&
      (sighting.reason == Reason::kMap || sighting.reason == Reason::kFieldOrder ||
       sighting.reason == Reason::kNotLive)) {
    recent_.clear();  // the last fields' addresses are refuted, too
  }
  sighting.judged_fields = judged_fields_;
  sighting.age = judged_fields_ > 0 ? sighting.time - last_judged_ : FieldTime(0);
  const verification::RecentField<S> field{sighting, tracker_.shown()};
  recent_.push(field);
  starts_.follow(field);
}

template <Scalar S, typename Margin>
void Session<S, Margin>::answer(const Event& event, const Input& input, std::int32_t& start,
                                Output& output) {
  const auto reply = [&](const auto& content) {
    static_cast<void>(
        output.replies.try_push_back({event.id, event.origin, input.field.mid_exposure, content}));
  };
  std::visit(
      Overloaded{[&](const Claim& claim) { claims_.take(event, claim, recent_, output.replies); },
                 [&](const Start&) {
                   const StartRefusal refusal = start_refusals_[start++];
                   reply(refusal == StartRefusal::kNone
                             ? StartReply{tracker_.start_refusal(), tracker_.refused_click()}
                             : StartReply{refusal});
                 },
                 [&](const Pick& pick) {
                   reply(verification::judge_pick<S>(pick, recent_, model_, map_));
                 },
                 [&](const PoseRequest&) {
                   reply(poses_.take(event, output.sighting, output.tubes, output.order));
                 },
                 [&](const PoseResult& pose) { reply(poses_.judge(pose, output.sighting)); },
                 [&](const LampCommand& command) {
                   if (!input.lamp_dimmed && !output.lamp_ruled) {
                     reply(NotServedReply{});
                     return;
                   }
                   if (command.automatic) {
                     // A box without a level of its own keeps what was commanded.
                     if (!lighting_.rules() || !lighting_.follows_picture()) {
                       reply(NotServedReply{});
                       return;
                     }
                     lamp_wanted_.reset();
                     reply(LampReply{
                         lighting_.wanted_permille(lamp_wanted_, input.field.mid_exposure), true});
                     return;
                   }
                   lamp_wanted_ = command.permille;
                   output.lamp_permille = command.permille;
                   reply(LampReply{command.permille});
                 },
                 [&](const Acknowledge&) { reply(NotServedReply{}); }},
      event.content);
}

TUBESIGHT_INSTANTIATE_POLICY_CLASS(Session)

}  // namespace tubesight::core::session
