#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tubesight::drivers {

/// What can go wrong between the steam generator and the box; the `kind` of a `[[fault]]`. The list
/// is closed: docs/scenarios.md tells each with its parameters.
enum class FaultKind : std::uint8_t {
  kDropped,      ///< fields are lost; sequence and time show it
  kRepeated,     ///< the last picture of the same lines is delivered again
  kTorn,         ///< below a line the picture is still the one before
  kSwapped,      ///< the two fields of a frame were exposed in the other order
  kBlack,        ///< no video level
  kSaturated,    ///< white all over
  kSignalLoss,   ///< snow
  kKnock,        ///< the camera is turned against the tool, from then on or for a while
  kLampOut,      ///< the lighthouse shines with a share of its light
  kLampsDead,    ///< some of its twelve lamps are dark
  kLampDrift,    ///< its light changes slowly to a share, and stays there
  kVibration,    ///< the tool shakes
  kCut,          ///< nothing for a while, the tool moves on; time shows it
  kJump,         ///< the tool stands whole lattice steps away at once, and nothing shows it
  kEmi,          ///< lines are lifted or lowered
  kSaltPepper,   ///< single pixels are white or black
  kFrozen,       ///< the picture stands still, under new noise
  kOtherCamera,  ///< the picture of another toolhead, under another lamp with a pattern of its own
  kSkip,         ///< a length of the path is left out, and nothing shows it
  kPoseStep,     ///< the tool stands off at once, by height, heading or lean
  kHeld,         ///< a frame store hangs, bit for bit: a share of the columns, under line noise
  kCompressed,   ///< squares that hardly change come again, the others are coarse
  kJitter,       ///< the fields' stamps waver, their numbers do not
  kBlots,        ///< dark drops and dirt
  kReflections,  ///< bright spots of a lamp
  kGhost,        ///< the picture a second time beside itself
  kBlackLevel,   ///< less contrast on a raised black
  kCovered,      ///< the lowest or the left part is one grey value
};
inline constexpr std::int32_t kFaultKinds = 28;

/// The word of a kind in files: `dropped`, `signal-loss` ...; the order is that of the kinds.
inline constexpr std::array<std::string_view, kFaultKinds> kFaultWords = {
    "dropped",     "repeated",  "torn",        "swapped",     "black",      "saturated",
    "signal-loss", "knock",     "lamp-out",    "lamps-dead",  "lamp-drift", "vibration",
    "cut",         "jump",      "emi",         "salt-pepper", "frozen",     "other-camera",
    "skip",        "pose-step", "held",        "compressed",  "jitter",     "blots",
    "reflections", "ghost",     "black-level", "covered"};

[[nodiscard]] constexpr std::string_view name_of(FaultKind kind) {
  return kFaultWords[static_cast<std::size_t>(kind)];
}

/// One fault of a scenario. A field has it when its nominal mid-exposure is in [at_s, at_s +
/// for_s); for_s = 0 is the first field at or after at_s, but for knock, lamp-out, lamps-dead,
/// jump and from frozen on, but for skip, which then last to the end. Of a skip for_s is what is
/// left out. Swapped and cut go by whole frames,
/// whose instant is that of their first field. Vibration, lamp-drift and skip need a length.
struct Fault {
  FaultKind kind = FaultKind::kDropped;
  double at_s = 0.0;             ///< when it begins, from the recording's start
  double for_s = 0.0;            ///< how long it lasts, 0 or more
  double share = 0.5;            ///< torn: of the lines that are new, 0..1; emi: of lines hit;
                                 ///< salt-pepper, blots, reflections: of pixels; held: of
                                 ///< columns, from the left; ghost: of its light;
                                 ///< black-level: of the contrast; covered: of the lines or columns
  double level = 0.0;            ///< lamp-out, lamp-drift: share of full light, 0..1;
                                 ///< black, black-level, covered: grey value
  double amplitude = 0.0;        ///< emi: grey levels; held: sigma of the line's noise;
                                 ///< compressed: grey levels of a step
  double waver_ms = 0.0;         ///< jitter: by how much at most, to either side
  double angle_deg = 0.0;        ///< knock: by how much, right-handed
  std::array<double, 3> axis{};  ///< knock: about which axis of the camera frame, any length
  std::uint16_t lamps = 0;       ///< lamps-dead: bit n is lamp n
  std::array<double, 3> shake_mm{};   ///< vibration: amplitude in the tool frame; pose-step
  std::array<double, 3> shake_deg{};  ///< vibration: amplitude about the tool's x, y, z;
                                      ///< pose-step
  double frequency_hz = 20.0;         ///< vibration
  std::int32_t rows = 0;              ///< jump, other-camera: lattice steps
  std::int32_t columns = 0;
  bool told = true;  ///< signal-loss: the driver marks the fields as damaged;
                     ///< cut: the sequence shows it too;
                     ///< covered: the left columns instead of the lowest lines
};

/// Whether a fault without a length lasts to the end of the recording.
[[nodiscard]] constexpr bool lasts_to_the_end(FaultKind kind) {
  return kind == FaultKind::kKnock || kind == FaultKind::kLampOut ||
         kind == FaultKind::kLampsDead || kind == FaultKind::kJump ||
         (kind >= FaultKind::kFrozen && kind != FaultKind::kSkip);
}

/// Whether a fault takes whole frames, by the instant of their first field.
[[nodiscard]] constexpr bool by_frames(FaultKind kind) {
  return kind == FaultKind::kSwapped || kind == FaultKind::kCut;
}

}  // namespace tubesight::drivers
