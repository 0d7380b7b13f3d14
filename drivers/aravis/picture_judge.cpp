#include "drivers/aravis/picture_judge.h"

#include <algorithm>

#include "drivers/camera/picture_look.h"

namespace tubesight::drivers::aravis {
namespace {

using core::FieldStatus;
using core::FieldTime;

}  // namespace

void PictureJudge::begin(core::Scan scan, const AgreedPicture& agreed) {
  scan_ = scan;
  agreed_ = agreed;
  counter_.begin_anew();
  clock_.begin(agreed.frame());
  pictures_ = 0;
  had_complete_ = false;
}

/// What is in doubt is not used; the first doubt is the one that is told.
void PictureJudge::doubt(AravisTrouble trouble) {
  first_.status = FieldStatus::kDamaged;
  if (report_->trouble == AravisTrouble::kNone) {
    report_->trouble = trouble;
  }
}

void PictureJudge::doubt(AravisTrouble trouble, std::int64_t& counter) {
  ++counter;
  doubt(trouble);
}

core::Field PictureJudge::first_field(const Picture& picture) {
  ++report_->counters.buffers;
  report_->trouble = AravisTrouble::kNone;
  first_ = {};
  // The settings say it: a converter of analogue video knows no more of it than they do, and the
  // tracking finds out when they err.
  first_.parity = core::parity_of(scan_, false);
  judge_pixels(picture);
  judge_number(picture);
  judge_time(picture);
  return first_;
}

void PictureJudge::judge_pixels(const Picture& picture) {
  AravisCounters& counters = report_->counters;
  if (!picture.complete) {
    doubt(AravisTrouble::kIncomplete, counters.incomplete);
    return;
  }
  had_complete_ = true;
  if (picture.width_px != agreed_.width_px || picture.height_px != agreed_.height_px ||
      picture.format != agreed_.format.code || picture.padding_bytes != 0 ||
      picture.bytes < agreed_.bytes) {
    doubt(AravisTrouble::kOtherSize, counters.other_size);
  }
}

void PictureJudge::judge_number(const Picture& picture) {
  AravisCounters& counters = report_->counters;
  const std::int64_t fields = agreed_.pair ? 2 : 1;
  const FrameCounter::Step step = counter_.next(picture.frame_id);
  first_.sequence = step.sequence * fields;
  counters.lost_fields += step.lost * fields;
  counters.counter_back += step.went_back ? 1 : 0;
  if (step.repeated) {
    doubt(AravisTrouble::kRepeated, counters.counter_repeated);
  }
  report_->counts = counter_.counts();
  // Two numbers a frame, of a progressive one the even one.
  first_.number = last_number_ + (last_number_ % 2 != 0 ? 1 : 2);
  last_number_ = first_.number + fields - 1;
}

void PictureJudge::judge_time(const Picture& picture) {
  using Verdict = CameraClock::Verdict;
  AravisCounters& counters = report_->counters;
  const CameraClock::Reading reading = clock_.read(picture.stamp_ns, picture.arrival);
  bool settling = pictures_ < CameraClock::kSettled;
  pictures_ += settling ? 1 : 0;
  switch (reading.verdict) {
    case Verdict::kGood: break;
    case Verdict::kSettling: settling = true; break;
    case Verdict::kJumped: doubt(AravisTrouble::kStamps, counters.clock_jumps); break;
    case Verdict::kWentBack: doubt(AravisTrouble::kStamps, counters.clock_back); break;
    case Verdict::kTooOld: doubt(AravisTrouble::kStamps, counters.too_old); break;
    case Verdict::kByArrival: ++counters.without_stamp; break;
  }
  if (settling) {
    doubt(AravisTrouble::kSettling, counters.settling);
  }
  report_->stamps = clock_.trusted();
  // The last line of the last field came `readout` after its exposure had ended.
  const FieldTime before_last = agreed_.pair ? agreed_.span : FieldTime{0};
  const FieldTime mid = reading.time - agreed_.readout - agreed_.exposure / 2 - before_last;
  const FieldTime earliest = last_time_ == FieldTime{INT64_MIN} ? mid : last_time_ + FieldTime{1};
  first_.mid_exposure = std::max(mid, earliest);
  last_time_ = first_.mid_exposure + before_last;
}

core::Field PictureJudge::second_field() const {
  core::Field field = first_;
  field.parity = core::parity_of(scan_, true);
  field.sequence += 1;
  field.number += 1;
  field.mid_exposure += agreed_.span;
  return field;
}

void PictureJudge::look_at_picture(core::Field& field) {
  AravisCounters& counters = report_->counters;
  const auto damage = [&](AravisTrouble trouble, std::int64_t& counter) {
    ++counter;
    field.status = FieldStatus::kDamaged;
    if (report_->trouble == AravisTrouble::kNone) {
      report_->trouble = trouble;
    }
  };
  switch (look_at(field.pixels)) {
    case Look::kPicture: return;
    case Look::kNoise: damage(AravisTrouble::kNoise, counters.noise); return;
    case Look::kBlank: damage(AravisTrouble::kBlank, counters.blank); return;
    case Look::kBlack: ++counters.black; return;  // the session says that it is dark
  }
}

}  // namespace tubesight::drivers::aravis
