#pragma once

#include <cstdint>

#include "drivers/camera/picture_counters.h"

namespace tubesight::drivers {

/// What is the matter with a camera behind Aravis.
enum class AravisTrouble : std::uint8_t {
  kNone,
  kNotOpen,      ///< it was not opened yet, or could not be: messages() say why
  kSettling,     ///< the first pictures after a start: they may be old, or without a clock yet
  kIncomplete,   ///< packets of pictures get lost
  kNoise,        ///< pictures are snow
  kBlank,        ///< pictures are of one grey
  kOtherSize,    ///< pictures are not what was agreed
  kStamps,       ///< times jump or go back
  kRepeated,     ///< the same picture twice
  kSilent,       ///< nothing came for too long
  kControlLost,  ///< it does not answer any more, or another program has taken it
};

/// The trouble for a person: "packets get lost".
[[nodiscard]] const char* words_of(AravisTrouble trouble);

/// What a camera has come to since its first start; nothing is ever reset.
struct AravisCounters : PictureCounters {
  std::int64_t incomplete = 0;       ///< pictures with packets missing
  std::int64_t other_size = 0;       ///< pictures of another size or format than agreed
  std::int64_t settling = 0;         ///< pictures after a start that were not believed yet
  std::int64_t clock_jumps = 0;      ///< times that the camera's clock went ahead of ours
  std::int64_t clock_back = 0;       ///< stamps that were not after the one before
  std::int64_t too_old = 0;          ///< pictures that had waited for too long
  std::int64_t underruns = 0;        ///< pictures for which no buffer was free
  std::int64_t resent_packets = 0;   ///< packets that came at a second request
  std::int64_t missing_packets = 0;  ///< packets that never came
  std::int64_t controls_lost = 0;    ///< times that the camera did not obey any more
};

/// How a camera is doing.
struct AravisReport {
  AravisTrouble trouble = AravisTrouble::kNotOpen;
  bool counts = false;  ///< the camera's counter moves
  bool stamps = false;  ///< times are the camera's own
  AravisCounters counters;
};

}  // namespace tubesight::drivers
