#pragma once

#include <cstdint>
#include <variant>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/pose_result.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// Why clicks were not taken; docs/messages.md has the words.
enum class StartRefusal : std::uint8_t {
  kNone,
  kTooFew,         ///< fewer than three clicks
  kNoTubeThere,    ///< no dark tube-end around a click
  kSameTubeTwice,  ///< two clicks in one tube-end
  kAddresses,      ///< addresses, lattice (its handedness, too) and camera contradict each other
  kHeight,         ///< the tube-ends' distances do not fit a tool below this sheet
  kSize,           ///< the tube-ends' sizes do not fit the bore
  kPicture,        ///< the other tube-ends are not where the clicks put them
  kMoved,          ///< the tool is not known to have stood still since the picture clicked into
  kUnknownField,   ///< the picture clicked into is none that the box has seen
  kSuperseded,     ///< another start came before the same field, and that one counts
  kMap,            ///< plugs or places without a tube look like open tube-ends
  kElsewhere,      ///< the tool was just seen too far from there; a confirmed start is taken
  kNotLive,        ///< the picture does not follow the lamp: it is not live, or the lamp is dead
};
inline constexpr StartRefusal kLastStartRefusal = StartRefusal::kNotLive;  ///< of the list

/// What the box says to a claim.
enum class ClaimVerdict : std::uint8_t {
  kConfirmed,     ///< it vouches for that tube
  kContradicted,  ///< it vouches for another one
  kUnknown,       ///< it cannot tell
};

/// Why a claim could not be judged; docs/messages.md has the words.
enum class ClaimDoubt : std::uint8_t {
  kNone,
  kNoPicture,   ///< there is no picture of the claim's instant, or none to be used
  kTooOld,      ///< the claim's instant is longer ago than the box answers for
  kNotYet,      ///< the claim's instant is farther ahead than any field to come soon
  kNoSighting,  ///< no field is near enough to the claim's instant
  kNotKnown,    ///< the box does not know which tube it sees, or none stands there
  kNotAligned,  ///< the guidetube was not near enough under any tube
  kMoving,      ///< between the nearest field and the claim's instant it may have gone elsewhere
  kBusy,        ///< too many claims are waiting for their field
};

/// The answer to a Claim.
struct ClaimReply {
  TubeAddress claimed{};  ///< the claim, sent back
  ClaimVerdict verdict = ClaimVerdict::kUnknown;
  ClaimDoubt doubt = ClaimDoubt::kNone;  ///< why, where the verdict is kUnknown
  TubeAddress tube{};                    ///< the tube vouched for, unless the verdict is kUnknown
  std::int64_t field = -1;               ///< number of the field judged by; -1: there was none
};

/// The answer to a Start; taken when there is no refusal.
struct StartReply {
  StartRefusal refusal = StartRefusal::kNone;
  std::int32_t click = -1;  ///< the one to blame, counted from 0; -1: none alone is
};

/// Why no tube can be named at a place; docs/messages.md has the words.
enum class PickDoubt : std::uint8_t {
  kNone,
  kNotTracking,   ///< the box did not know in that field which tubes it saw
  kNoTube,        ///< no tube stands there
  kUnknownField,  ///< that field is none of the last second, or is still to come
};

/// The answer to a Pick.
struct PickReply {
  PickDoubt doubt = PickDoubt::kNone;
  TubeAddress tube{};  ///< valid without a doubt
};

/// The answer to a PoseRequest; a result will follow when there is no refusal.
struct PoseRequestReply {
  PoseReason refusal = PoseReason::kNone;
};

/// How a measured pose goes together with what the box sees.
enum class PoseVerdict : std::uint8_t {
  kConfirmed,     ///< it is under the tube that the box sees
  kContradicted,  ///< the box sees the tool under another tube
  kUnknown,       ///< the box does not see under which tube the tool is
  kRefused,       ///< there is no pose: see `pose.reason`
};

/// The answer to a PoseResult, for whoever asked for the pose.
struct PoseReply {
  PoseVerdict verdict = PoseVerdict::kRefused;
  TubeAddress tube{};  ///< that the box sees; valid when confirmed or contradicted
  PoseResult pose{};
};

/// The answer to a LampCommand: the level is wanted from now on.
struct LampReply {
  std::int32_t permille = 0;
  bool automatic = false;  ///< it is the box's own, which will change
};

/// The answer where nobody is there to serve that kind of event.
struct NotServedReply {};

/// What the box says to one event.
struct Reply {
  std::int64_t id = 0;  ///< of the event
  EventOrigin origin = EventOrigin::kRobot;
  FieldTime at{0};  ///< when it was made: mid-exposure of the field after which it was said
  std::variant<NotServedReply, ClaimReply, StartReply, PickReply, PoseRequestReply, PoseReply,
               LampReply>
      content;
};

/// A tube-end to begin a pose with, and where its centre is.
struct PoseOrderTube {
  TubeAddress address;
  ImagePoint center_px;
};

/// Tube-ends that an order names: as many as give a safe first pose.
inline constexpr std::int32_t kMaxPoseOrderTubes = 12;

/// The pose that a request asks for, handed to whoever computes it from this field on.
struct PoseOrder {
  bool wanted = false;
  std::int64_t id = 0;  ///< of the request, and so of the result
  EventOrigin origin = EventOrigin::kRobot;
  StaticVector<PoseOrderTube, kMaxPoseOrderTubes> tubes;
};

/// Claims that wait for the field nearest to their instant.
inline constexpr std::int32_t kMaxWaitingClaims = 16;

using ReplyList = StaticVector<Reply, kMaxEventsPerField + kMaxWaitingClaims>;

}  // namespace tubesight::core
