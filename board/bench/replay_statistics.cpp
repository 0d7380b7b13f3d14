#include "board/bench/replay_statistics.h"

#include <algorithm>
#include <cmath>

namespace tubesight::board {

using core::EventKind;
using core::FieldTime;
using core::TrackState;
using Verdict = core::session::Reply::Verdict;

void ReplayStatistics::add(const core::EventList& events, const core::session::Output& output) {
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
  for (std::int32_t i = 0; i < std::min(events.size(), output.replies.size()); ++i) {
    take_reply(events[i], output.replies[i], sighting.time);
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

void ReplayStatistics::take_reply(const core::Event& event, const core::session::Reply& reply,
                                  FieldTime time) {
  if (reply.verdict == Verdict::kNotServed) {
    ++not_served_;
    return;
  }
  switch (reply.kind) {
    case EventKind::kStart: starts_.push_back({time, reply.refusal}); break;
    case EventKind::kClaim:
      if (reply.verdict == Verdict::kConfirmed) {
        ++claims_confirmed_;
      } else if (reply.verdict == Verdict::kContradicted) {
        contradictions_.push_back({time, event.claim, reply.tube});
      } else {
        ++claims_unknown_;
      }
      break;
    case EventKind::kPick:
      ++(reply.verdict == Verdict::kConfirmed ? picks_named_ : picks_unknown_);
      break;
    case EventKind::kPoseRequest:
      if (reply.verdict == Verdict::kRefused) {
        poses_.push_back({time, reply.pose, false});
      }
      break;
    case EventKind::kPoseResult:
      poses_.push_back({time, reply.pose, reply.verdict == Verdict::kContradicted});
      break;
    case EventKind::kLampCommand:
    case EventKind::kAcknowledge: break;
  }
}

}  // namespace tubesight::board
