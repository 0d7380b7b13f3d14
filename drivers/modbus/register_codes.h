#pragma once

#include <cstdint>

#include "core/base/reply.h"
#include "core/base/sighting.h"

namespace tubesight::drivers {

// What the numbers of registers "in code" and "in bits" mean; docs/robot-link.md lists them, and a
// test compares. Reasons are the core's own enumerations, whose words docs/messages.md explains.

/// Bits of sighting_valid.
enum class SightingBit : std::uint8_t {
  kSighting = 0,  ///< there is one, and it is not too old; without it no other bit is set
  kJudged = 1,    ///< tube-ends of this very field were measured and believed
  kAge = 2,
  kPrimary = 3,
  kTube = 4,  ///< tube above the guidetube, offset and its direction
  kAxis = 5,  ///< axis and height
  kMargin = 6,
  kVelocity = 7,
  kLiveness = 8,
  kResidual = 9,
};

/// The register state; 0 is no state, so that a register that nobody filled shows none.
[[nodiscard]] constexpr std::int32_t code_of(core::TrackState state) {
  return static_cast<std::int32_t>(state) + 1;
}

/// The register verdict.
enum class VerdictCode : std::uint8_t { kNone = 0, kAgree = 1, kDisagree = 2, kCannotSay = 3 };

[[nodiscard]] constexpr VerdictCode code_of(core::ClaimVerdict verdict) {
  switch (verdict) {
    case core::ClaimVerdict::kConfirmed: return VerdictCode::kAgree;
    case core::ClaimVerdict::kContradicted: return VerdictCode::kDisagree;
    case core::ClaimVerdict::kUnknown: break;
  }
  return VerdictCode::kCannotSay;
}

// Reasons that the link itself gives, beyond those of the core.
inline constexpr std::int32_t kNoAnswerInTime = 100;  ///< the box did not judge it in time
inline constexpr std::int32_t kOtherWindow = 101;     ///< a window or optimum not of the settings
inline constexpr std::int32_t kNotServed = 102;       ///< this box does not serve it

/// Bits of command, acknowledge and busy.
enum class CommandBit : std::uint8_t {
  kStart = 0,
  kPick = 1,
  kLamp = 2,
  kPose = 3,
  kAcknowledge = 4,
};
inline constexpr std::int32_t kCommandBits = 5;

/// Bits of self_test_bad and self_test_absent.
enum class SelfTestBit : std::uint8_t {
  kNumbers = 0,  ///< the golden recording
  kCamera = 1,
  kRate = 2,
  kTime = 3,
  kIdentity = 4,  ///< the camera is that of the calibration
  kLamp = 5,
  kPattern = 6,
  kLink = 7,
  kDisk = 8,
  kPairs = 9,
  kPriority = 10,
  kMemory = 11,
  kBoots = 12,
  kWatchdog = 13,
  kJournal = 14,
};

/// The register journal.
inline constexpr std::int32_t kJournalNone = 0;
inline constexpr std::int32_t kJournalWriting = 1;
inline constexpr std::int32_t kJournalStanding = 2;

/// Registers start_result and lamp_result, pick_result: 2 is always the refusal.
inline constexpr std::int32_t kResultTaken = 1;
inline constexpr std::int32_t kResultRefused = 2;

/// Registers lamp_mode, as wanted, and lamp_mode_now, as it is; there 0 is a lamp that nobody dims.
inline constexpr std::int32_t kLampCommanded = 1;
inline constexpr std::int32_t kLampAutomatic = 2;

/// The register robot_told.
inline constexpr std::int32_t kRobotNothing = 0;
inline constexpr std::int32_t kRobotPlace = 1;
inline constexpr std::int32_t kRobotTurned = 2;

/// The register pose_result.
[[nodiscard]] constexpr std::int32_t code_of(core::PoseVerdict verdict) {
  return static_cast<std::int32_t>(verdict) + 1;
}

template <typename Bit>
[[nodiscard]] constexpr std::int32_t bit_of(Bit bit, bool set = true) {
  return set ? 1 << static_cast<std::int32_t>(bit) : 0;
}

}  // namespace tubesight::drivers
