#include "board/bench/words.h"

namespace tubesight::board {

using core::Reason;
using core::tracking::StartRefusal;

std::string_view explain(Reason reason) {
  switch (reason) {
    case Reason::kNone: return "";
    case Reason::kNoStart: return "nobody has named tubes yet";
    case Reason::kStartRefused: return "the start was refused";
    case Reason::kFewTubes: return "only two tube-ends left";
    case Reason::kDark: return "the picture shows no light";
    case Reason::kWashedOut: return "the picture is saturated";
    case Reason::kNoTubes: return "no tube-ends where they should be";
    case Reason::kDamagedField: return "a field was delivered damaged";
    case Reason::kUncertain: return "the address is too near to its rounding limit";
    case Reason::kCoasted: return "nothing usable seen for too long";
    case Reason::kJump: return "the picture contradicts any motion within the limits";
    case Reason::kSpeed: return "faster than [motion] allows";
    case Reason::kGap: return "too many fields are missing";
    case Reason::kTime: return "the time of a field is not after that of the field before";
    case Reason::kArithmetic: return "a number left the range of the arithmetic";
  }
  return "";
}

std::string_view explain(core::PoseReason reason) {
  using core::PoseReason;
  switch (reason) {
    case PoseReason::kNone: return "";
    case PoseReason::kNotTracking: return "the box does not know which tubes it sees";
    case PoseReason::kMoving: return "the tool moves";
    case PoseReason::kBusy: return "the request before is not answered yet";
    case PoseReason::kPicture: return "the picture shows too few sound tube-ends";
    case PoseReason::kWeak: return "the tube-ends measured don't determine the pose";
    case PoseReason::kEnded: return "the pictures ended before there were enough";
  }
  return "";
}

std::string_view name_of(StartRefusal refusal) {
  switch (refusal) {
    case StartRefusal::kNone: return "";
    case StartRefusal::kTooFew: return "too-few";
    case StartRefusal::kNoTubeThere: return "no-tube-there";
    case StartRefusal::kSameTubeTwice: return "same-tube-twice";
    case StartRefusal::kAddresses: return "addresses";
    case StartRefusal::kHeight: return "height";
    case StartRefusal::kSize: return "size";
    case StartRefusal::kPicture: return "picture";
    case StartRefusal::kMoved: return "moved";
    case StartRefusal::kUnknownField: return "unknown-field";
    case StartRefusal::kSuperseded: return "superseded";
  }
  return "";
}

std::string_view explain(StartRefusal refusal) {
  switch (refusal) {
    case StartRefusal::kNone: return "";
    case StartRefusal::kTooFew: return "fewer than three clicks";
    case StartRefusal::kNoTubeThere: return "no dark tube-end around a click";
    case StartRefusal::kSameTubeTwice: return "two clicks in one tube-end";
    case StartRefusal::kAddresses: return "the addresses contradict the lattice or its handedness";
    case StartRefusal::kHeight:
      return "the tube-ends' distances do not fit a tool below this sheet";
    case StartRefusal::kSize: return "the tube-ends' sizes do not fit bore_mm";
    case StartRefusal::kPicture: return "other tube-ends are not where the clicks put them";
    case StartRefusal::kMoved: return "the tool moved since the picture that was clicked into";
    case StartRefusal::kUnknownField:
      return "the picture clicked into is none that the box has seen";
    case StartRefusal::kSuperseded: return "another start came before the same field";
  }
  return "";
}

}  // namespace tubesight::board
