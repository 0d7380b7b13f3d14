#include "core/tracking/old_picture_watch.h"

#include <algorithm>

namespace tubesight::core::tracking {
namespace {

// With fewer blocks of grey the picture tells nothing of its noise.
constexpr std::int32_t kEnough = 16;
// A variance of the difference of 0.36: noise of 0.3 grey levels, rounded. Below, rounding hides
// how much it is.
constexpr std::int32_t kLeastNoise = 20;
// Fields until the usual noise is known.
constexpr std::int32_t kKnown = 3;

}  // namespace

// A quiet picture is not kept: the next one is compared with that before it, too, so that a store
// under noise of its own stays at half of the variance of two live pictures, or below.
bool OldPictureWatch::shows_old(const Field& field, const PixelBox& window, bool moves) {
  // One or two blocks may be equal by chance; a torn field has more.
  constexpr std::int32_t kTorn = 4;
  constexpr std::int32_t kStandingEdges = 3;
  likeness_ = memory_.look(field.pixels, field.parity, window, expected_noise());
  const bool noisy = source_ == Source::kNoisy;
  const bool repeated = noisy && likeness_.equal >= kTorn + 2 * most_equal_;
  const bool standing = likeness_.equal_edges >= kStandingEdges;
  const bool stands = moves && standing;
  const bool quiet = is_quiet();
  const bool old = repeated || stands || (quiet && quiet_);
  quiet_ = quiet;
  if (!old && !quiet) {
    memory_.keep(field.pixels, field.parity, window);
  }
  age(old, standing);
  return old;
}

void OldPictureWatch::age(bool old, bool standing) {
  if (old) {
    aged_ = aged_ == Aged::kStood ? Aged::kOldAgain : Aged::kOld;
  } else if (!standing) {
    aged_ = Aged::kFresh;
  } else if (aged_ == Aged::kOld) {
    aged_ = Aged::kStood;
  }
}

// Where the picture got darker the photons' share of the noise went with it: its variance is as the
// grey level. Where it lost contrast (a raised black level, a smaller gain) its noise did, too: as
// the contrast's variance. Where it got brighter there is as much as before, at least.
std::int32_t OldPictureWatch::expected_noise() const {
  constexpr std::int64_t kFlat = 64;  // a picture of no contrast has what noise it has
  if (grey_q4_ <= 0) {
    return 0;
  }
  const std::int64_t grey_q4 = std::min(16 * likeness_.grey, grey_q4_);
  const std::int64_t contrast = std::min(likeness_.contrast, contrast_) + kFlat;
  return static_cast<std::int32_t>(noise_q4_ * grey_q4 / grey_q4_ * contrast / (contrast_ + kFlat) /
                                   16);
}

// A store's own noise is half of what two live pictures differ by, or less. Forty blocks tell their
// mean variance to a twelfth: two thirds are four deviations from either. Where a part of the
// picture is live it outweighs the mean: of live blocks a sixth have less than half of the usual
// noise, half of all are four deviations more.
bool OldPictureWatch::is_quiet() const {
  const std::int32_t usual = expected_noise();
  if (source_ != Source::kNoisy || learnt_ < kKnown || usual < kLeastNoise ||
      likeness_.compared < kEnough) {
    return false;
  }
  return 3 * likeness_.noise < 2 * usual || 2 * likeness_.quiet >= likeness_.compared;
}

// Three fields at rest in a row: the picture of the same lines before was one of the same place,
// whichever of its parity it was. What a source is, is settled once; between the two the next field
// is asked, as a compressor sends a whole picture anew at times. What is nearly at rest tells that
// there is noise, but not how much: the grain of the plate moves by half a pixel, and would be
// taken for noise that live pictures lack later.
void OldPictureWatch::believe(Rest rest) {
  constexpr std::int32_t kRested = 3;
  rested_ = rest != Rest::kNone ? rested_ + 1 : 0;
  still_ = rest == Rest::kStill ? still_ + 1 : 0;
  if (rested_ < kRested || quiet_) {
    unequal_ = 0;
    return;
  }
  if (source_ == Source::kUnknown) {
    learn_source();
  }
  if (likeness_.compared >= kEnough && source_ == Source::kNoisy &&
      16 * likeness_.equal <= likeness_.compared) {
    most_equal_ = std::max(most_equal_, likeness_.equal);
    if (still_ >= kRested) {
      learn_noise();
    }
  }
}

// Where little of the picture is grey, as when the tool is docked and the plate above it lies in
// the dark, some fields together show what one of them does not. Two fields' worth of blocks is
// asked of them, as they are the same places over and over. Too few in each show nothing: a
// compressor may happen to send just these anew.
void OldPictureWatch::learn_source() {
  constexpr std::int32_t kFewest = kEnough / 2;
  const std::int32_t compared = likeness_.compared;
  const bool all_new = likeness_.equal == 0 && likeness_.middle_noise >= kLeastNoise;
  unequal_ = all_new && compared >= kFewest ? std::min(unequal_ + compared, kMostUnequal) : 0;
  if (compared >= kEnough && 4 * likeness_.equal >= compared) {
    source_ = Source::kRepeating;
  } else if ((all_new && compared >= kEnough) || unequal_ >= 2 * kEnough) {
    source_ = Source::kNoisy;
  }
}

// The mean of the first fields, then one that follows slowly, downwards sooner: what moves a little
// shows more. Of the middle block, which specks, interference and shaking edges do not reach: a chi
// square of seven is 0.907 of its mean there.
// What is far more than usual is no noise: the picture moved, by a whole step or very slowly.
void OldPictureWatch::learn_noise() {
  const std::int32_t noise_q4 = likeness_.middle_noise * 16 * 11 / 10;
  if (learnt_ >= kKnown && 2 * noise_q4 > 3 * noise_q4_) {
    return;
  }
  learnt_ = std::min(learnt_ + 1, kMostLearnt);
  noise_q4_ += (noise_q4 - noise_q4_) / std::min(learnt_, noise_q4 < noise_q4_ ? 8 : kMostLearnt);
  grey_q4_ += (16 * likeness_.grey - grey_q4_) / learnt_;
  contrast_ += (likeness_.contrast - contrast_) / learnt_;
}

}  // namespace tubesight::core::tracking
