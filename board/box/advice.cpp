#include "board/box/advice.h"

namespace tubesight::board {

using core::Reason;
using core::StartRefusal;

std::string_view advice_of(Reason reason) {
  switch (reason) {
    case Reason::kNone: break;
    case Reason::kNoStart: return "Name a tube: Start.";
    case Reason::kStartRefused: return "See why it was refused, and start again.";
    case Reason::kFewTubes: return "Move the window, or the light.";
    case Reason::kUncertain: return "Widen the window.";
    case Reason::kDark: return "Look at the lamp, its cable and the iris.";
    case Reason::kWashedOut: return "Give less light, or a shorter shutter.";
    case Reason::kNoTubes: return "See whether something stands before the camera.";
    case Reason::kDamagedField: return "Look at the camera's cable and the frame store.";
    case Reason::kMap: return "Start again with addresses that are sure.";
    case Reason::kNoField: return "Look at the camera and its cable.";
    case Reason::kCoasted: return "Clear the view, then start anew.";
    case Reason::kJump: return "See that nothing has hit the camera, then start anew.";
    case Reason::kSpeed: return "Compare [motion] with what the robot does, then start anew.";
    case Reason::kGap: return "Look at the camera and its cable, then start anew.";
    case Reason::kTime: return "Have the camera's driver looked at, then start anew.";
    case Reason::kSequence: return "See whether the camera was started anew, then start anew.";
    case Reason::kRate: return "Take a faster camera, or lower values in [motion].";
    case Reason::kFieldOrder: return "Set scan of [camera] to the other order.";
    case Reason::kArithmetic: return "Please report it, and start anew.";
    case Reason::kNotLive: return "Look at the lamp and the frame store, then start anew.";
  }
  return {};
}

std::string_view advice_of(StartRefusal refusal) {
  switch (refusal) {
    case StartRefusal::kNone: break;
    case StartRefusal::kTooFew: return "Click into three tube-ends.";
    case StartRefusal::kNoTubeThere: return "Click into the dark of an open tube-end.";
    case StartRefusal::kSameTubeTwice: return "Click into different tube-ends.";
    case StartRefusal::kAddresses: return "Read the addresses again.";
    case StartRefusal::kHeight: return "Read the addresses again; see whether the pitch is right.";
    case StartRefusal::kSize: return "See whether bore_mm is right, and that the lamp shines.";
    case StartRefusal::kPicture: return "Read the addresses again; see to the light.";
    case StartRefusal::kMoved: return "Freeze the present picture and click into it.";
    case StartRefusal::kUnknownField: return "Freeze the present picture and click into it.";
    case StartRefusal::kSuperseded: return "Another start counts: look at it first.";
    case StartRefusal::kMap: return "Read all addresses again: they are off by the same steps.";
    case StartRefusal::kElsewhere: return "Read the addresses again; confirm if they are right.";
    case StartRefusal::kNotLive: return "Look at the lamp and the frame store.";
  }
  return {};
}

}  // namespace tubesight::board
