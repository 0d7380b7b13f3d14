#pragma once

#include <array>
#include <cstdint>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"

namespace tubesight::board {

/// Something that belongs into the journal, as the tracking thread hands it over. Plain bytes, some
/// hundred of them; what the kind does not need is left as it is.
struct JournalNote {
  enum class Kind : std::uint8_t {
    kClaim,  ///< a claim was answered: `claim`
    kStart,  ///< a start was answered: `start`, `started`
    kLoss,   ///< the track was lost; `seen` has the reason
    kPose,   ///< a pose request was answered: `pose`
    kLeft,   ///< the tool is seen nearest to another tube than in the field before; no row
    kGap,    ///< `lost` notes before this one found no room
  };

  Kind kind = Kind::kClaim;
  std::int64_t id = 0;  ///< of the event answered
  core::EventOrigin origin = core::EventOrigin::kRobot;
  core::FieldTime at{0};  ///< the claim's own instant; else that of the field
  core::ClaimReply claim;
  core::Start start;
  core::StartReply started;
  core::PoseReply pose;
  std::int64_t lost = 0;
  bool seen_known = false;  ///< `seen` is of the field judged by
  core::Sighting seen;
  std::int32_t picture = -1;      ///< place of that field's pixels in the desk; -1: none
  std::array<char, 64> digest{};  ///< SHA-256 of them, of whoever reads them; 0: not known
};

}  // namespace tubesight::board
