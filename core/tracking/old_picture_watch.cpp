#include "core/tracking/old_picture_watch.h"

namespace tubesight::core::tracking {

bool OldPictureWatch::shows_old(const Field& field, const PixelBox& window) {
  // One line alone may be equal by chance; a torn field has more.
  constexpr std::int32_t kTorn = 2;
  likeness_ = memory_.look(field.pixels, field.parity, window);
  return noisy_ && likeness_.equal >= kTorn;
}

// Three fields at rest in a row: the picture of the same lines before was one of the same place,
// whichever of its parity it was.
void OldPictureWatch::believe(bool at_rest) {
  constexpr std::int32_t kRested = 3;
  rested_ = at_rest ? rested_ + 1 : 0;
  if (rested_ >= kRested && likeness_.equal == 0 &&
      2 * likeness_.compared > PictureMemory::kLines) {
    noisy_ = true;
  }
}

}  // namespace tubesight::core::tracking
