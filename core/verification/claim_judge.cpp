#include "core/verification/claim_judge.h"

#include <algorithm>
#include <array>

#include "core/base/instantiate.h"

namespace tubesight::core::verification {
namespace {

// Event files round an instant to this; a claim made with a field must not wait for the next one.
constexpr FieldTime kResolution = std::chrono::microseconds(1);

constexpr std::int64_t kMicroseconds = 1'000'000;  // a second

// Fields that a claim waits for, whatever their stamps say: one whose clock stands still brings
// none.
constexpr std::int32_t kLongestWait = 64;

// Not below the length of a vector, and at most an eighth above it.
std::int64_t length_above(const std::array<std::int32_t, 2>& vector) {
  const std::int64_t x = vector[0] < 0 ? -std::int64_t{vector[0]} : vector[0];
  const std::int64_t y = vector[1] < 0 ? -std::int64_t{vector[1]} : vector[1];
  return std::max(x, y) + (std::min(x, y) + 1) / 2;
}

}  // namespace

template <Scalar S>
void ClaimJudge<S>::answer_waiting(const RecentFields<S>& recent, ReplyList& replies) {
  StaticVector<Waiting, kMaxWaitingClaims> still;
  for (Waiting one : waiting_) {
    auto answer = judge(one.claim, one.at, recent);
    if (!answer && ++one.fields > kLongestWait) {
      answer = ClaimReply{one.claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kNoSighting, {}, -1};
    }
    if (answer) {
      static_cast<void>(
          replies.try_push_back({one.id, one.origin, recent.last().sighting.time, *answer}));
    } else {
      static_cast<void>(still.try_push_back(one));
    }
  }
  waiting_ = still;
}

template <Scalar S>
void ClaimJudge<S>::take(const Event& event, const Claim& claim, const RecentFields<S>& recent,
                         ReplyList& replies) {
  const FieldTime now = recent.last().sighting.time;
  const FieldTime at = event.at.value_or(now);
  auto answer = judge(claim, at, recent);
  if (!answer) {
    if (waiting_.try_push_back({event.id, event.origin, at, claim, 0})) {
      return;
    }
    answer = ClaimReply{claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kBusy, {}, -1};
  }
  static_cast<void>(replies.try_push_back({event.id, event.origin, now, *answer}));
}

template <Scalar S>
std::optional<ClaimReply> ClaimJudge<S>::judge(const Claim& claim, FieldTime at,
                                               const RecentFields<S>& recent) const {
  const FieldTime now = recent.newest();
  if (now - at > limits_.oldest) {
    return ClaimReply{claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kTooOld, {}, -1};
  }
  if (at - now > limits_.oldest) {
    return ClaimReply{claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kNotYet, {}, -1};
  }
  if (at - now > kResolution) {
    return std::nullopt;
  }
  const Sighting& nearest = recent.nearest(at)->sighting;
  const ClaimReply reply = judge_by(claim, at, nearest);
  // Before a start is not yet after it: the nearest field was one without that track.
  if (reply.verdict != ClaimVerdict::kUnknown && recent.forgot_nearer(at)) {
    return ClaimReply{claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kNotKnown, {}, nearest.field};
  }
  return reply;
}

template <Scalar S>
ClaimReply ClaimJudge<S>::judge_by(const Claim& claim, FieldTime at,
                                   const Sighting& sighting) const {
  ClaimReply reply{claim.tube, ClaimVerdict::kUnknown, ClaimDoubt::kNone, {}, sighting.field};
  const FieldTime span = RecentFields<S>::distance(sighting.time, at);
  const bool known =
      sighting.state == TrackState::kTracking || sighting.state == TrackState::kDegraded;
  if (span > limits_.within) {
    reply.doubt = ClaimDoubt::kNoSighting;
  } else if (sighting.status != FieldStatus::kGood) {
    reply.doubt = ClaimDoubt::kNoPicture;
  } else if (!known) {
    reply.doubt = ClaimDoubt::kNotKnown;
  } else if (!sighting.judged) {
    reply.doubt = ClaimDoubt::kNoPicture;
  } else if (!sighting.tool_known) {
    reply.doubt = ClaimDoubt::kNotKnown;
  } else if (!sighting.aligned) {
    reply.doubt = ClaimDoubt::kNotAligned;
  } else if (span > kResolution && may_have_left(sighting, span)) {
    reply.doubt = ClaimDoubt::kMoving;
  } else {
    reply.tube = sighting.tool;
    reply.verdict =
        claim.tube == sighting.tool ? ClaimVerdict::kConfirmed : ClaimVerdict::kContradicted;
  }
  return reply;
}

// offset + v t + a t (t + T) / 2 > 0.4 steps. The last speed v is the mean over the span T between
// two fields, and so half of that old.
template <Scalar S>
bool ClaimJudge<S>::may_have_left(const Sighting& sighting, FieldTime span) const {
  const std::int64_t span_us = span.count() / 1000 + 1;
  const std::int64_t speed_um_s =
      sighting.velocity_known ? length_above(sighting.velocity_um_s) : limits_.max_um_s;
  const std::int64_t age_us = span_us + sighting.velocity_span_us;
  const std::int64_t gained_um_s = limits_.max_um_s2 * age_us / kMicroseconds / 2 + 1;
  const std::int64_t moved_um = (speed_um_s + gained_um_s) * span_us / kMicroseconds + 1;
  const std::int64_t offset_um = sighting.offset_um_q8 / 256 + 1;
  return 10 * (offset_um + moved_um) > 4 * limits_.step_um;
}

TUBESIGHT_INSTANTIATE_CLASS(ClaimJudge)

}  // namespace tubesight::core::verification
