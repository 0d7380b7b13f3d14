#include "drivers/v4l2/video_standard.h"

#include <bit>

namespace tubesight::drivers::v4l2 {
namespace {

using core::FieldTime;

constexpr FieldTime kNtscField{16'683'333};
constexpr FieldTime kPalField{20'000'000};
/// How far an interval may be from a standard's: half of what would make it the other's.
constexpr FieldTime kNear = (kPalField - kNtscField) / 4;
constexpr std::uint32_t kLooked = (1U << StandardPace::kIntervals) - 1;
/// Fields between two buffers that are looked at; after a longer gap an interval says little.
constexpr std::int64_t kFewFields = 4;

constexpr bool near(FieldTime interval, FieldTime to) {
  return interval > to - kNear && interval < to + kNear;
}

}  // namespace

VideoStandard standard_of(v4l2_std_id bits) {
  const bool ntsc = (bits & V4L2_STD_525_60) != 0;
  const bool pal = (bits & V4L2_STD_625_50) != 0;
  if (ntsc == pal) {
    return VideoStandard::kNone;
  }
  return ntsc ? VideoStandard::kNtsc : VideoStandard::kPal;
}

const char* name_of(VideoStandard standard) {
  switch (standard) {
    case VideoStandard::kNone: break;
    case VideoStandard::kNtsc: return "NTSC";
    case VideoStandard::kPal: return "PAL";
  }
  return "none";
}

FieldTime field_time_of(VideoStandard standard) {
  switch (standard) {
    case VideoStandard::kNone: break;
    case VideoStandard::kNtsc: return kNtscField;
    case VideoStandard::kPal: return kPalField;
  }
  return {};
}

VideoStandard StandardQuestion::ask(int descriptor) {
  // Without a signal drivers answer with none or with all that they know: neither says anything.
  v4l2_std_id sensed = 0;
  const FieldTime before = clock_->now();
  const bool answered = kernel_->ioctl(descriptor, VIDIOC_QUERYSTD, &sensed) == 0;
  dear_ = dear_ || !answered || clock_->now() - before > kLongest;
  return answered ? standard_of(sensed) : VideoStandard::kNone;
}

void StandardPace::begin(VideoStandard agreed) {
  *this = {};
  if (agreed != VideoStandard::kNone) {
    own_time_ = field_time_of(agreed);
    other_time_ = agreed == VideoStandard::kNtsc ? kPalField : kNtscField;
  }
}

void StandardPace::take(FieldTime mid_exposure, std::int64_t sequence) {
  if (own_time_ == FieldTime{0}) {
    return;
  }
  const std::int64_t fields = sequence - last_sequence_;
  if (known_ && fields > 0 && fields <= kFewFields) {
    const FieldTime interval = (mid_exposure - last_) / fields;
    own_bits_ = (own_bits_ << 1 | (near(interval, own_time_) ? 1U : 0U)) & kLooked;
    other_bits_ = (other_bits_ << 1 | (near(interval, other_time_) ? 1U : 0U)) & kLooked;
    if (std::popcount(other_ ? own_bits_ : other_bits_) >= kMost) {
      other_ = !other_;
    }
  }
  known_ = true;
  last_ = mid_exposure;
  last_sequence_ = sequence;
}

}  // namespace tubesight::drivers::v4l2
