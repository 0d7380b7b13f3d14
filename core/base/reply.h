#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/pose_result.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// Why clicks were not taken; docs/messages.md has the words.
enum class StartRefusal : std::uint8_t {
  kNone,
  kTooFew,         ///< fewer than three clicks
  kNoTubeThere,    ///< no dark tube-end around a click
  kSameTubeTwice,  ///< two clicks in one tube-end
  kAddresses,      ///< the addresses contradict the lattice or its handedness
  kHeight,         ///< the tube-ends' distances do not fit a tool below this sheet
  kSize,           ///< the tube-ends' sizes do not fit the bore
  kPicture,        ///< the other tube-ends are not where the clicks put them
};

/// What the box says to an event.
struct Reply {
  /// How the event was answered.
  enum class Verdict : std::uint8_t {
    kConfirmed,     ///< claim: the box vouches for that tube; pick: `tube` stands there;
                    ///< pose result: `pose` is under the tube that the box sees
    kContradicted,  ///< claim: the box vouches for `tube` instead; pose result: the box sees `tube`
    kUnknown,       ///< the box cannot tell
    kTaken,         ///< start: tracking began; pose request: a pose will follow
    kRefused,       ///< start: see `refusal`; pose request and pose result: see `pose.reason`
    kNotServed,     ///< this build has nobody to answer that kind of event
  };
  EventKind kind = EventKind::kClaim;
  Verdict verdict = Verdict::kUnknown;
  TubeAddress tube{};
  StartRefusal refusal = StartRefusal::kNone;
  PoseResult pose{};
};

using ReplyList = StaticVector<Reply, kMaxEventsPerField>;

}  // namespace tubesight::core
