#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tubesight::drivers {

/// Every value of the robot link's map; docs/robot-link.md is the contract for those who read it.
enum class Register : std::uint8_t {
  // identity
  kMapVersion,
  kIdentityValid,
  kWordOrderMark,
  kProduct,
  kProductVersion,
  kBoot,
  kCameraId,
  kToolId,
  kBaseId,
  // sighting
  kSequence,
  kSightingBoot,
  kSightingValid,
  kState,
  kReason,
  kLiveness,
  kJudgedFields,
  kAge,
  kField,
  kPrimaryRow,
  kPrimaryColumn,
  kPrimaryU,
  kPrimaryV,
  kTubeRow,
  kTubeColumn,
  kOffset,
  kOffsetX,
  kOffsetY,
  kHeight,
  kAxisU,
  kAxisV,
  kMargin,
  kVelocityX,
  kVelocityY,
  kTracked,
  kAligned,
  kResidual,
  kSightingAge,
  kSequenceAgain,
  // verdict
  kVerdictSequence,
  kVerdictBoot,
  kVerdictValid,
  kVerdict,
  kVerdictReason,
  kVerdictReserved,
  kVerdictId,
  kVerdictClaimedRow,
  kVerdictClaimedColumn,
  kVerdictTubeRow,
  kVerdictTubeColumn,
  kVerdictField,
  kVerdictAge,
  kVerdictSequenceAgain,
  // claim
  kClaimId,
  kClaimRow,
  kClaimColumn,
  kClaimAge,
  kClaimCommit,
  // command
  kCommand,
  kStartConfirm,
  kCommandId,
  kSeenField,
  kPickU,
  kPickV,
  kLampLevel,
  kLampMode,
  kStart1Row,
  kStart1Column,
  kStart1U,
  kStart1V,
  kStart2Row,
  kStart2Column,
  kStart2U,
  kStart2V,
  kStart3Row,
  kStart3Column,
  kStart3U,
  kStart3V,
  kWindowLeft,
  kWindowTop,
  kWindowRight,
  kWindowBottom,
  kOptimumU,
  kOptimumV,
  // result
  kAcknowledge,
  kBusy,
  kResultBoot,
  kStartResult,
  kStartReason,
  kStartId,
  kPickResult,
  kPickReason,
  kPickId,
  kPickAtU,
  kPickAtV,
  kPickRow,
  kPickColumn,
  kLampResult,
  kLampTaken,
  kLampId,
  kPoseResult,
  kPoseReason,
  kPoseId,
  kPoseTubeRow,
  kPoseTubeColumn,
  kPoseX,
  kPoseY,
  kPoseZ,
  kPoseAlpha,
  kPoseBeta,
  kPoseGamma,
  kPoseSigmaX,
  kPoseSigmaY,
  kPoseSigmaZ,
  kPoseSigmaAlpha,
  kPoseSigmaBeta,
  kPoseSigmaGamma,
  kPoseTubes,
  kPoseValid,
  kCorrectionX,
  kCorrectionY,
  kCorrectionZ,
  // health
  kHealthValid,
  kCameraHealth,
  kLampHealth,
  kLampPattern,
  kLampNow,
  kLampModeNow,
  kFields,
  kFieldsMissing,
  kFieldsLate,
  kRequests,
  kAnswers,
  kExceptions,
  kCrcErrors,
  kCutFrames,
  kOtherUnits,
  kBroadcasts,
  kStrayBytes,
  kDroppedEvents,
  kLateClaims,
  kAbandonedAnswers,
  kReopenings,
  kResponseLast,
  kResponseWorst,
  kClaimResponseWorst,
  kPairsWritten,
  kPairsLost,
  // robot
  kRobotTold,
  kRobotJoints,
  kRobotX,
  kRobotY,
  kRobotZ,
  kRobotAlpha,
  kRobotBeta,
  kRobotGamma,
  kRobotJoint1,
  kRobotJoint2,
  kRobotJoint3,
  kRobotJoint4,
  kRobotJoint5,
  kRobotJoint6,
  kRobotJoint7,
  kRobotJoint8,
  // zone_tube
  kZoneTubeRow,
  kZoneTubeColumn,
  // zone
  kZoneValid,
  kZoneReserved,
  kZoneRow,
  kZoneColumn,
  kZoneX,
  kZoneY,
  kZoneZ,
  kZoneSigmaAcross,
  kZoneSigmaAlong,
  // self_test
  kSelfTest,
  kSelfTestBad,
  kSelfTestAbsent,
  kSelfTestReserved,
  kBootNumber,
  kStartNumber,
  kUp,
  // journal
  kJournal,
  kJournalReserved,
  kJournalSafe,
  kJournalWaiting,
  kJournalLost,
  kCount,
};

/// The map's parts: one request reads or writes within one of them.
enum class Block : std::uint8_t {
  kIdentity,
  kSighting,
  kVerdict,
  kClaim,
  kCommand,
  kResult,
  kHealth,
  kRobot,
  kZoneTube,
  kZone,
  kSelfTest,
  kJournal,
};

/// Where a value stands and what its number means.
struct RegisterRow {
  Register name;
  std::uint8_t width;        ///< words: 1 unsigned, 2 signed (counters and identities: modulo 2^32)
  std::uint16_t address;     ///< of its first word, from 0
  std::int32_t per_unit;     ///< what 1 of the unit is in the register
  std::string_view unit;     ///< "mm", "px", "bits", "code"; empty: a plain number
  std::string_view label;    ///< its name in the document
  std::string_view meaning;  ///< in the document
};

struct RegisterBlock {
  Block name;
  bool writable;
  std::uint16_t first;
  std::uint16_t last;
  std::string_view label;

  [[nodiscard]] constexpr bool holds(std::int32_t address, std::int32_t count) const {
    return address >= first && address + count - 1 <= last;
  }
};

/// Words of the whole map, those between its blocks among them.
inline constexpr std::int32_t kMapWords = 708;

/// What the map says where a value is not known; its validity bit is off as well.
inline constexpr std::int32_t kUnknown = INT32_MIN;
inline constexpr std::uint16_t kUnknownWord = 0xFFFF;

inline constexpr std::int32_t kPresentMapVersion = 1;
inline constexpr std::int32_t kWordOrderPattern = 0x01020304;
inline constexpr std::int32_t kProductPattern = 0x54554245;

/// All values in the order of their addresses; that of a value is its number.
[[nodiscard]] std::span<const RegisterRow> register_table();
[[nodiscard]] const RegisterRow& row_of(Register name);

[[nodiscard]] std::span<const RegisterBlock> register_blocks();

}  // namespace tubesight::drivers
