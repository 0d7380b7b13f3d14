#include "drivers/modbus/register_table.h"

#include <array>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

constexpr RegisterRow kTable[] = {
    {Register::kMapVersion, 1, 0, 1, "", "map_version", "version of this map: 1"},
    {Register::kIdentityValid, 1, 1, 1, "bits", "identity_valid",
     "bit 0: camera_id, 1: tool_id, 2: base_id are known"},
    {Register::kWordOrderMark, 2, 2, 1, "", "word_order_mark",
     "always 16909060 (0x01020304): shows the order of the two words"},
    {Register::kProduct, 2, 4, 1, "", "product", "always 1414873669 (0x54554245, \"TUBE\")"},
    {Register::kProductVersion, 2, 6, 1, "", "product_version",
     "10000 * major + 100 * minor + patch"},
    {Register::kBoot, 2, 8, 1, "", "boot",
     "differs from one start of the box to the next; never 0"},
    {Register::kCameraId, 2, 10, 1, "", "camera_id", "identity of the camera's calibration"},
    {Register::kToolId, 2, 12, 1, "", "tool_id", "identity of the tool's calibration"},
    {Register::kBaseId, 2, 14, 1, "", "base_id", "identity of the robot base's calibration"},
    {Register::kSequence, 2, 100, 1, "", "sequence",
     "grows with each sighting, skips 0; 0: there was none yet"},
    {Register::kSightingBoot, 2, 102, 1, "", "sighting_boot", "boot again"},
    {Register::kSightingValid, 1, 104, 1, "bits", "sighting_valid",
     "which of the registers below are valid"},
    {Register::kState, 1, 105, 1, "code", "state", "how far the box knows where it is"},
    {Register::kReason, 1, 106, 1, "code", "reason", "why the state is not tracking"},
    {Register::kLiveness, 1, 107, 1, "code", "liveness", "whether the picture is known to be live"},
    {Register::kJudgedFields, 2, 108, 1, "", "judged_fields",
     "fields judged so far; grows with them alone"},
    {Register::kAge, 2, 110, 1, "ms", "age",
     "since the exposure of the field judged last, at the time of the reading"},
    {Register::kField, 2, 112, 1, "", "field", "number of the field"},
    {Register::kPrimaryRow, 2, 114, 1, "", "primary_row", "primary tube"},
    {Register::kPrimaryColumn, 2, 116, 1, "", "primary_column", "primary tube"},
    {Register::kPrimaryU, 2, 118, 1000, "px", "primary_u",
     "its centre in the picture, to the right"},
    {Register::kPrimaryV, 2, 120, 1000, "px", "primary_v", "its centre in the picture, down"},
    {Register::kTubeRow, 2, 122, 1, "", "tube_row", "tube above the guidetube"},
    {Register::kTubeColumn, 2, 124, 1, "", "tube_column", "tube above the guidetube"},
    {Register::kOffset, 2, 126, 1000, "mm", "offset",
     "distance of the guidetube's axis from that tube's centre"},
    {Register::kOffsetX, 2, 128, 1000, "mm", "offset_x",
     "the same as a vector, from the tube's centre to the axis, sheet x"},
    {Register::kOffsetY, 2, 130, 1000, "mm", "offset_y", "sheet y"},
    {Register::kHeight, 2, 132, 1000, "mm", "height",
     "guidetube's tip below the plane of the tube-ends"},
    {Register::kAxisU, 2, 134, 1000, "px", "axis_u",
     "where the guidetube's axis meets the sheet, in the picture"},
    {Register::kAxisV, 2, 136, 1000, "px", "axis_v",
     "where the guidetube's axis meets the sheet, in the picture"},
    {Register::kMargin, 2, 138, 10000, "", "margin",
     "distance of the address from its rounding limit in standard deviations"},
    {Register::kVelocityX, 2, 140, 1000, "mm/s", "velocity_x",
     "of the axis over the sheet, sheet x"},
    {Register::kVelocityY, 2, 142, 1000, "mm/s", "velocity_y", "sheet y"},
    {Register::kTracked, 1, 144, 1, "", "tracked", "tube-ends measured in this field and used"},
    {Register::kAligned, 1, 145, 1, "", "aligned",
     "1: the box vouches for the tube above the guidetube; 0: it does not"},
    {Register::kResidual, 2, 146, 1000, "px", "residual", "RMS of the tube-ends used"},
    {Register::kSightingAge, 2, 148, 1, "ms", "sighting_age",
     "since the exposure of this field, at the time of the reading"},
    {Register::kSequenceAgain, 2, 150, 1, "", "sequence_again",
     "the same as sequence: two readings that differ belong to two sightings"},
    {Register::kVerdictSequence, 2, 200, 1, "", "verdict_sequence",
     "grows with each claim taken, skips 0; 0: there was none yet"},
    {Register::kVerdictBoot, 2, 202, 1, "", "verdict_boot", "boot again"},
    {Register::kVerdictValid, 1, 204, 1, "bits", "verdict_valid",
     "bit 0: verdict and claim, 1: verdict_tube, 2: a claim is being judged"},
    {Register::kVerdict, 1, 205, 1, "code", "verdict",
     "0: none, 1: AGREE, 2: DISAGREE, 3: CANNOT SAY"},
    {Register::kVerdictReason, 1, 206, 1, "code", "verdict_reason", "why the box cannot say"},
    {Register::kVerdictReserved, 1, 207, 1, "", "verdict_reserved", "always 0"},
    {Register::kVerdictId, 2, 208, 1, "", "verdict_id", "claim_id of the claim, sent back"},
    {Register::kVerdictClaimedRow, 2, 210, 1, "", "verdict_claimed_row", "the claim, sent back"},
    {Register::kVerdictClaimedColumn, 2, 212, 1, "", "verdict_claimed_column",
     "the claim, sent back"},
    {Register::kVerdictTubeRow, 2, 214, 1, "", "verdict_tube_row",
     "the tube that the box vouches for"},
    {Register::kVerdictTubeColumn, 2, 216, 1, "", "verdict_tube_column",
     "the tube that the box vouches for"},
    {Register::kVerdictField, 2, 218, 1, "", "verdict_field", "number of the field judged by"},
    {Register::kVerdictAge, 2, 220, 1, "ms", "verdict_age",
     "since the claim's instant, at the time of the reading"},
    {Register::kVerdictSequenceAgain, 2, 222, 1, "", "verdict_sequence_again",
     "the same as verdict_sequence"},
    {Register::kClaimId, 2, 300, 1, "", "claim_id", "any number, better a new one for each claim"},
    {Register::kClaimRow, 2, 302, 1, "", "claim_row",
     "tube that the robot believes to be above the guidetube"},
    {Register::kClaimColumn, 2, 304, 1, "", "claim_column",
     "tube that the robot believes to be above the guidetube"},
    {Register::kClaimAge, 1, 306, 1, "ms", "claim_age",
     "how long ago that was so, up to 10000; 0 again after each claim"},
    {Register::kClaimCommit, 1, 307, 1, "", "claim_commit", "write 1: this is a claim; reads as 0"},
    {Register::kCommand, 1, 320, 1, "bits", "command",
     "bit 0: start, 1: pick, 2: lamp, 3: pose, 4: acknowledge; done when a bit goes from 0 to 1"},
    {Register::kStartConfirm, 1, 321, 1, "", "start_confirm",
     "1: a person insists on the start against a warning; 0 again after each start"},
    {Register::kCommandId, 2, 322, 1, "", "command_id", "sent back with the result"},
    {Register::kSeenField, 2, 324, 1, "", "seen_field",
     "number of the field in whose picture u and v were read; -1: the one that follows"},
    {Register::kPickU, 2, 326, 1000, "px", "pick_u", "a place in the picture"},
    {Register::kPickV, 2, 328, 1000, "px", "pick_v", "a place in the picture"},
    {Register::kLampLevel, 1, 330, 1, "permille", "lamp_level", "level wanted, 0 to 1000"},
    {Register::kLampMode, 1, 331, 1, "code", "lamp_mode",
     "1: the level is that of lamp_level, 2: automatic, the box's own"},
    {Register::kStart1Row, 2, 332, 1, "", "start_1_row", "first tube of the start"},
    {Register::kStart1Column, 2, 334, 1, "", "start_1_column", "first tube of the start"},
    {Register::kStart1U, 2, 336, 1000, "px", "start_1_u", "a place inside its dark"},
    {Register::kStart1V, 2, 338, 1000, "px", "start_1_v", "a place inside its dark"},
    {Register::kStart2Row, 2, 340, 1, "", "start_2_row", "second tube"},
    {Register::kStart2Column, 2, 342, 1, "", "start_2_column", "second tube"},
    {Register::kStart2U, 2, 344, 1000, "px", "start_2_u", "a place inside its dark"},
    {Register::kStart2V, 2, 346, 1000, "px", "start_2_v", "a place inside its dark"},
    {Register::kStart3Row, 2, 348, 1, "", "start_3_row", "third tube"},
    {Register::kStart3Column, 2, 350, 1, "", "start_3_column", "third tube"},
    {Register::kStart3U, 2, 352, 1000, "px", "start_3_u", "a place inside its dark"},
    {Register::kStart3V, 2, 354, 1000, "px", "start_3_v", "a place inside its dark"},
    {Register::kWindowLeft, 1, 356, 1, "px", "window_left", "search window, inclusive"},
    {Register::kWindowTop, 1, 357, 1, "px", "window_top", "search window, inclusive"},
    {Register::kWindowRight, 1, 358, 1, "px", "window_right", "search window, inclusive"},
    {Register::kWindowBottom, 1, 359, 1, "px", "window_bottom", "search window, inclusive"},
    {Register::kOptimumU, 2, 360, 1000, "px", "optimum_u", "where the light is best"},
    {Register::kOptimumV, 2, 362, 1000, "px", "optimum_v", "where the light is best"},
    {Register::kAcknowledge, 1, 400, 1, "bits", "acknowledge",
     "the command bits whose results are here"},
    {Register::kBusy, 1, 401, 1, "bits", "busy", "the command bits whose results are to come"},
    {Register::kResultBoot, 2, 402, 1, "", "result_boot", "boot again"},
    {Register::kStartResult, 1, 404, 1, "code", "start_result", "0: none, 1: taken, 2: refused"},
    {Register::kStartReason, 1, 405, 1, "code", "start_reason", "why the start was refused"},
    {Register::kStartId, 2, 406, 1, "", "start_id", "command_id, sent back"},
    {Register::kPickResult, 1, 408, 1, "code", "pick_result",
     "0: none, 1: a tube, 2: no tube can be named"},
    {Register::kPickReason, 1, 409, 1, "code", "pick_reason", "why no tube can be named"},
    {Register::kPickId, 2, 410, 1, "", "pick_id", "command_id, sent back"},
    {Register::kPickAtU, 2, 412, 1000, "px", "pick_at_u", "the place, sent back"},
    {Register::kPickAtV, 2, 414, 1000, "px", "pick_at_v", "the place, sent back"},
    {Register::kPickRow, 2, 416, 1, "", "pick_row", "the tube at that place"},
    {Register::kPickColumn, 2, 418, 1, "", "pick_column", "the tube at that place"},
    {Register::kLampResult, 1, 420, 1, "code", "lamp_result",
     "0: none, 1: taken, 2: nobody dims the lamp"},
    {Register::kLampTaken, 1, 421, 1, "permille", "lamp_taken", "the level wanted from now on"},
    {Register::kLampId, 2, 422, 1, "", "lamp_id", "command_id, sent back"},
    {Register::kPoseResult, 1, 424, 1, "code", "pose_result",
     "0: none, 1: confirmed, 2: contradicted, 3: the box does not see which tube, 4: refused"},
    {Register::kPoseReason, 1, 425, 1, "code", "pose_reason", "why there is no pose"},
    {Register::kPoseId, 2, 426, 1, "", "pose_id", "command_id, sent back"},
    {Register::kPoseTubeRow, 2, 428, 1, "", "pose_tube_row",
     "the tube that the box sees above the guidetube"},
    {Register::kPoseTubeColumn, 2, 430, 1, "", "pose_tube_column",
     "the tube that the box sees above the guidetube"},
    {Register::kPoseX, 2, 432, 10000, "mm", "pose_x",
     "T_sheet_tool: the guidetube's tip in the sheet frame"},
    {Register::kPoseY, 2, 434, 10000, "mm", "pose_y", ""},
    {Register::kPoseZ, 2, 436, 10000, "mm", "pose_z", ""},
    {Register::kPoseAlpha, 2, 438, 100000, "deg", "pose_alpha",
     "its rotation Rz(alpha) Ry(beta) Rx(gamma)"},
    {Register::kPoseBeta, 2, 440, 100000, "deg", "pose_beta", ""},
    {Register::kPoseGamma, 2, 442, 100000, "deg", "pose_gamma", ""},
    {Register::kPoseSigmaX, 2, 444, 10000, "mm", "pose_sigma_x", "one standard deviation of each"},
    {Register::kPoseSigmaY, 2, 446, 10000, "mm", "pose_sigma_y", ""},
    {Register::kPoseSigmaZ, 2, 448, 10000, "mm", "pose_sigma_z", ""},
    {Register::kPoseSigmaAlpha, 2, 450, 100000, "deg", "pose_sigma_alpha", ""},
    {Register::kPoseSigmaBeta, 2, 452, 100000, "deg", "pose_sigma_beta", ""},
    {Register::kPoseSigmaGamma, 2, 454, 100000, "deg", "pose_sigma_gamma", ""},
    {Register::kPoseTubes, 1, 456, 1, "", "pose_tubes", "tube-ends used"},
    {Register::kPoseValid, 1, 457, 1, "bits", "pose_valid",
     "bit 0: the pose, 1: pose_tube, 2: correction"},
    {Register::kCorrectionX, 2, 458, 10000, "mm", "correction_x",
     "move in the tool's own axes that brings the guidetube's axis through the tube's centre"},
    {Register::kCorrectionY, 2, 460, 10000, "mm", "correction_y", ""},
    {Register::kCorrectionZ, 2, 462, 10000, "mm", "correction_z", ""},
    {Register::kHealthValid, 1, 500, 1, "bits", "health_valid",
     "bit 0: camera_health, 1: lamp_health, 2: lamp_pattern, 3: lamp_now, 4: box counters"},
    {Register::kCameraHealth, 1, 501, 1, "code", "camera_health", "1: well, 2: failed"},
    {Register::kLampHealth, 1, 502, 1, "code", "lamp_health",
     "1: well, as the picture shows, 2: failed"},
    {Register::kLampPattern, 1, 503, 1, "code", "lamp_pattern",
     "1: the picture follows the lamp, 2: it does not"},
    {Register::kLampNow, 1, 504, 1, "permille", "lamp_now", "level in force"},
    {Register::kLampModeNow, 1, 505, 1, "code", "lamp_mode_now",
     "0: nobody dims the lamp, 1: the level is commanded, 2: automatic, the box's own"},
    {Register::kFields, 2, 506, 1, "", "fields", "steps of the box, those without a field too"},
    {Register::kFieldsMissing, 2, 508, 1, "", "fields_missing", "steps without a field"},
    {Register::kFieldsLate, 2, 510, 1, "", "fields_late",
     "sightings that came after the deadline of the box"},
    {Register::kRequests, 2, 512, 1, "", "requests", "requests to this unit"},
    {Register::kAnswers, 2, 514, 1, "", "answers", "answers sent"},
    {Register::kExceptions, 2, 516, 1, "", "exceptions", "of them refusals"},
    {Register::kCrcErrors, 2, 518, 1, "", "crc_errors", "frames with a wrong check sum"},
    {Register::kCutFrames, 2, 520, 1, "", "cut_frames", "frames that ended too early"},
    {Register::kOtherUnits, 2, 522, 1, "", "other_units", "frames to or from other units"},
    {Register::kBroadcasts, 2, 524, 1, "", "broadcasts", "requests to all units"},
    {Register::kStrayBytes, 2, 526, 1, "", "stray_bytes", "bytes that belong to no frame"},
    {Register::kDroppedEvents, 2, 528, 1, "", "dropped_events",
     "requests refused with exception 6"},
    {Register::kLateClaims, 2, 530, 1, "", "late_claims",
     "claims answered CANNOT SAY because the box did not answer in time"},
    {Register::kAbandonedAnswers, 2, 532, 1, "", "abandoned_answers",
     "answers not sent because the next request was there already"},
    {Register::kReopenings, 2, 534, 1, "", "reopenings", "times that the line was opened again"},
    {Register::kResponseLast, 2, 536, 1, "us", "response_last",
     "from a request's last byte to its answer, within the box"},
    {Register::kResponseWorst, 2, 538, 1, "us", "response_worst",
     "the longest so far, function 23 with a claim left out"},
    {Register::kClaimResponseWorst, 2, 540, 1, "us", "claim_response_worst",
     "the longest of function 23 with a claim"},
};

constexpr RegisterBlock kBlocks[] = {
    {Block::kIdentity, false, 0, 15, "identity"},  {Block::kSighting, false, 100, 151, "sighting"},
    {Block::kVerdict, false, 200, 223, "verdict"}, {Block::kClaim, true, 300, 307, "claim"},
    {Block::kCommand, true, 320, 363, "command"},  {Block::kResult, false, 400, 463, "result"},
    {Block::kHealth, false, 500, 541, "health"},
};

constexpr bool is_sound() {
  if (std::size(kTable) != static_cast<std::size_t>(Register::kCount)) {
    return false;
  }
  std::size_t row = 0;
  for (const RegisterBlock& block : kBlocks) {
    std::int32_t next = block.first;
    while (row < std::size(kTable) && kTable[row].address <= block.last) {
      if (kTable[row].name != static_cast<Register>(row) || kTable[row].address != next) {
        return false;
      }
      next += kTable[row].width;
      ++row;
    }
    if (next != block.last + 1 || block.last - block.first >= 100) {
      return false;
    }
  }
  return row == std::size(kTable) && kBlocks[std::size(kBlocks) - 1].last + 1 == kMapWords;
}
static_assert(is_sound(), "blocks of at most 100 words, without holes, in the enumeration's order");

}  // namespace

std::span<const RegisterRow> register_table() { return kTable; }

const RegisterRow& row_of(Register name) {
  const auto index = static_cast<std::size_t>(name);
  TUBESIGHT_ASSERT(index < std::size(kTable));
  return kTable[index];
}

std::span<const RegisterBlock> register_blocks() { return kBlocks; }

}  // namespace tubesight::drivers
