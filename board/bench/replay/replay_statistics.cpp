#include "board/bench/replay/replay_statistics.h"

#include <algorithm>
#include <cmath>

namespace tubesight::board {

using core::FieldTime;
using core::TrackState;

void ReplayStatistics::add(const core::session::Output& output) {
  const core::Sighting& sighting = output.sighting;
  if (fields_ == 0) {
    begin_ = sighting.time;
  } else {
    // A time that runs backwards is the recording's mistake; it takes none away.
    account(std::max(sighting.time - previous_.time, FieldTime(0)));
  }
  if (sighting.state == TrackState::kLost &&
      (fields_ == 0 || previous_.state != TrackState::kLost)) {
    losses_.push_back({sighting.time, FieldTime(0), sighting.reason});
  }
  ++fields_;
  previous_ = sighting;
  take_sighting(output);
  for (const core::Reply& reply : output.replies) {
    take_reply(reply);
  }
}

void ReplayStatistics::finish() {
  if (fields_ > 0) {
    account(span_);
  }
}

void ReplayStatistics::account(FieldTime span) {
  const auto book = [span](Share& share) {
    share.fields += 1;
    share.time += span;
  };
  book(states_[static_cast<std::size_t>(previous_.state)]);
  if (previous_.state == TrackState::kDegraded) {
    book(degraded_[static_cast<std::size_t>(previous_.reason)]);
  }
  if (previous_.state == TrackState::kLost) {
    losses_.back().lasted += span;
  }
  visits_.add(previous_, span);
  span_ = span;
}

void ReplayStatistics::take_sighting(const core::session::Output& output) {
  const core::Sighting& sighting = output.sighting;
  if (sighting.state != TrackState::kTracking && sighting.state != TrackState::kDegraded) {
    return;
  }
  tubes_used_ += sighting.tracked;
  for (const core::TubeSighting& tube : output.tubes) {
    if (tube.plug) {
      plugs_.insert(tube.address);
    }
  }
  if (sighting.state == TrackState::kTracking && sighting.velocity_known) {
    constexpr double kUmPerMm = 1000.0;
    const double speed_mm_s =
        std::hypot(sighting.velocity_um_s[0], sighting.velocity_um_s[1]) / kUmPerMm;
    if (speed_mm_s > largest_speed_mm_s_) {
      largest_speed_mm_s_ = speed_mm_s;
      largest_speed_at_ = sighting.time;
    }
  }
}

void ReplayStatistics::take_reply(const core::Reply& reply) {
  using core::ClaimVerdict;
  using core::PoseVerdict;
  std::visit(
      core::Overloaded{
          [this](const core::NotServedReply&) { ++not_served_; },
          [&](const core::StartReply& start) {
            starts_.push_back({reply.at, start});
          },
          [&](const core::ClaimReply& claim) {
            if (claim.verdict == ClaimVerdict::kConfirmed) {
              ++claims_confirmed_;
            } else if (claim.verdict == ClaimVerdict::kContradicted) {
              contradictions_.push_back({reply.at, claim.claimed, claim.tube});
            } else {
              ++claims_unknown_;
            }
          },
          [this](const core::PickReply& pick) {
            ++(pick.doubt == core::PickDoubt::kNone ? picks_named_ : picks_unknown_);
          },
          [&](const core::PoseRequestReply& request) {
            if (request.refusal != core::PoseReason::kNone) {
              core::PoseResult refused;
              refused.reason = request.refusal;
              poses_.push_back({reply.at, refused, false});
            }
          },
          [&](const core::PoseReply& pose) {
            poses_.push_back({reply.at, pose.pose, pose.verdict == PoseVerdict::kContradicted});
          },
          [](const core::LampReply&) {}},
      reply.content);
}

}  // namespace tubesight::board
