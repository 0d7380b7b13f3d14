#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/tracker.h"

// How a tracker recognises pictures that it has seen before.
namespace tubesight::core::tracking {

// Whether two or more of the lines looked at are a picture seen before: the frame store stopped, or
// the field is torn. Counts only where the tool's rest has shown that equal lines do not happen:
// drawn and averaged pictures have no noise.
template <Scalar S>
bool Tracker<S>::shows_old_picture(const Field& field) {
  likeness_ = memory_.look(field.pixels, field.parity, model_->window);
  return noisy_ && likeness_.equal >= 2;
}

// After a field was believed: three at rest in a row make the picture of the same lines before one
// of the same place.
template <Scalar S>
void Tracker<S>::learn_noise() {
  constexpr std::int32_t kRested = 3;
  const Mm<S> slow = from_scaled<Mm<S>>(3, 0);  // mm/s; a twentieth of a millimetre in a field
  const bool rests = motion_.known && plane_length(motion_.velocity_mm_s) < slow;
  rested_ = rests ? rested_ + 1 : 0;
  if (rested_ >= kRested && likeness_.equal == 0 &&
      2 * likeness_.compared > PictureMemory::kLines) {
    noisy_ = true;
  }
}

#define TUBESIGHT_INSTANTIATE(S)                             \
  template bool Tracker<S>::shows_old_picture(const Field&); \
  template void Tracker<S>::learn_noise();
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
