#include "drivers/aravis/aravis_report.h"

namespace tubesight::drivers {

const char* words_of(AravisTrouble trouble) {
  switch (trouble) {
    case AravisTrouble::kNone: return "well";
    case AravisTrouble::kNotOpen: return "not open";
    case AravisTrouble::kSettling: return "settling";
    case AravisTrouble::kIncomplete: return "packets get lost";
    case AravisTrouble::kNoise: return "snow";
    case AravisTrouble::kBlank: return "a picture of one grey";
    case AravisTrouble::kOtherSize: return "pictures of another size";
    case AravisTrouble::kStamps: return "times that cannot be";
    case AravisTrouble::kRepeated: return "the same picture twice";
    case AravisTrouble::kSilent: return "nothing comes";
    case AravisTrouble::kControlLost: return "control lost";
  }
  return "";
}

}  // namespace tubesight::drivers
