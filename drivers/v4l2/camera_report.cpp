#include "drivers/v4l2/camera_report.h"

namespace tubesight::drivers {

const char* words_of(CameraTrouble trouble) {
  switch (trouble) {
    case CameraTrouble::kNone: return "well";
    case CameraTrouble::kNotOpen: return "not open";
    case CameraTrouble::kNoSignal: return "no signal";
    case CameraTrouble::kStandard: return "a signal of another standard";
    case CameraTrouble::kNoise: return "snow";
    case CameraTrouble::kBlank: return "a picture of one grey";
    case CameraTrouble::kDamaged: return "damaged pictures";
    case CameraTrouble::kStamps: return "times that cannot be";
    case CameraTrouble::kOrder: return "fields of no known order";
    case CameraTrouble::kSilent: return "nothing comes";
    case CameraTrouble::kStream: return "the driver gave up";
    case CameraTrouble::kSourceChanged: return "the signal's format changed";
    case CameraTrouble::kSwitched: return "another input was chosen";
    case CameraTrouble::kAltered: return "a control that moves the picture was changed";
    case CameraTrouble::kGone: return "the device is gone";
  }
  return "";
}

}  // namespace tubesight::drivers
