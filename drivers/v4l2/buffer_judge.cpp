#include "drivers/v4l2/buffer_judge.h"

#include <chrono>

#include <linux/videodev2.h>

namespace tubesight::drivers::v4l2 {
namespace {

using core::FieldStatus;
using core::FieldTime;
using core::Parity;

StampKind kind_of_stamp(std::uint32_t flags) {
  if ((flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return StampKind::kUnknown;
  }
  return (flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE
             ? StampKind::kStartOfExposure
             : StampKind::kEndOfFrame;
}

constexpr Parity other(Parity parity) {
  return parity == Parity::kEven ? Parity::kOdd : Parity::kEven;
}

}  // namespace

void BufferJudge::begin(core::Scan scan, const AgreedFormat& agreed, FieldTime exposure,
                        FieldTime now) {
  scan_ = scan;
  agreed_ = agreed;
  sequence_.begin_anew(agreed.kind);
  stamps_.begin({agreed.span, exposure > FieldTime{0} ? exposure : agreed.span,
                 agreed.kind == BufferKind::kPair ? 2 : 1},
                now);
  // A rate that the settings say otherwise is none of a standard.
  const FieldTime usual = field_time_of(agreed.standard);
  const bool paced = std::chrono::abs(agreed.span - usual) < usual / 100;
  pace_.begin(paced ? agreed.standard : VideoStandard::kNone);
}

/// What is in doubt is not used; the first doubt is the one that is told.
void BufferJudge::doubt(core::Field& field, CameraTrouble trouble, std::int64_t& counter) {
  ++counter;
  field.status = FieldStatus::kDamaged;
  if (report_->trouble == CameraTrouble::kNone) {
    report_->trouble = trouble;
  }
}

/// Of the buffer's first field.
Parity BufferJudge::parity_of(const v4l2_buffer& buffer) {
  CameraCounters& counters = report_->counters;
  const bool half = buffer.field == V4L2_FIELD_TOP || buffer.field == V4L2_FIELD_BOTTOM;
  if (agreed_.kind == BufferKind::kFrame) {
    return Parity::kProgressive;
  }
  if (agreed_.kind == BufferKind::kOneField) {
    if (half) {
      return buffer.field == V4L2_FIELD_TOP ? Parity::kEven : Parity::kOdd;
    }
    doubt(first_, CameraTrouble::kOrder, counters.odd_order);
    return other(last_parity_);
  }
  odd_above_ = agreed_.odd_above;
  if (half) {
    doubt(first_, CameraTrouble::kOrder, counters.odd_order);
  } else if (agreed_.sequential && V4L2_FIELD_IS_SEQUENTIAL(buffer.field)) {
    odd_above_ = buffer.field == V4L2_FIELD_SEQ_BT;
  }
  // In time the settings decide, as many drivers err here; the tracking finds out when the tool
  // moves. What contradicts them is counted.
  const bool says_even =
      buffer.field == V4L2_FIELD_INTERLACED_TB || buffer.field == V4L2_FIELD_SEQ_TB;
  const bool says_odd =
      buffer.field == V4L2_FIELD_INTERLACED_BT || buffer.field == V4L2_FIELD_SEQ_BT;
  counters.odd_order += (scan_ == core::Scan::kOddFirst ? says_even : says_odd) ? 1 : 0;
  return core::parity_of(scan_, false);
}

core::Field BufferJudge::first_field(const v4l2_buffer& buffer, const Arrival& arrival,
                                     Signal signal) {
  CameraCounters& counters = report_->counters;
  ++counters.buffers;
  report_->trouble = CameraTrouble::kNone;
  first_ = {};
  if (signal == Signal::kNone) {
    doubt(first_, CameraTrouble::kNoSignal, counters.without_signal);
  }
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    doubt(first_, CameraTrouble::kDamaged, counters.flagged);
  } else if (buffer.bytesused < agreed_.bytes) {
    doubt(first_, CameraTrouble::kDamaged, counters.cut_short);
  }
  first_.parity = parity_of(buffer);
  count(buffer);
  judge_time(buffer, arrival);
  if (signal == Signal::kOtherStandard || pace_.other()) {
    doubt(first_, CameraTrouble::kStandard, counters.other_standard);
  }
  return first_;
}

void BufferJudge::count(const v4l2_buffer& buffer) {
  CameraCounters& counters = report_->counters;
  const auto counted = sequence_.next(buffer.sequence, first_.parity == Parity::kOdd);
  first_.sequence = counted.sequence;
  counters.lost_fields += counted.lost;
  counters.counter_back += counted.went_back ? 1 : 0;
  if (counted.repeated) {
    doubt(first_, CameraTrouble::kDamaged, counters.counter_repeated);
  }
  report_->counts = sequence_.counts();
  // Two numbers a frame, the even one of its first field.
  const bool later = first_.parity != core::parity_of(scan_, false);
  first_.number = last_number_ + ((last_number_ % 2 != 0) == later ? 2 : 1);
  last_number_ = first_.number;
  last_parity_ = first_.parity;
  if (agreed_.kind == BufferKind::kPair) {
    ++last_number_;
    last_parity_ = other(first_.parity);
  }
}

void BufferJudge::judge_time(const v4l2_buffer& buffer, const Arrival& arrival) {
  const FieldTime stamp = std::chrono::seconds(buffer.timestamp.tv_sec) +
                          std::chrono::microseconds(buffer.timestamp.tv_usec);
  const auto judged = stamps_.judge(kind_of_stamp(buffer.flags), stamp, arrival.at);
  first_.mid_exposure = judged.mid_exposure;
  report_->counters.without_stamp += judged.by_arrival ? 1 : 0;
  if (judged.wrong || (judged.by_arrival && arrival.late)) {
    doubt(first_, CameraTrouble::kStamps, report_->counters.wrong_stamps);
  } else {
    pace_.take(first_.mid_exposure, first_.sequence);
  }
  report_->stamps = !judged.by_arrival && !judged.wrong;
}

core::Field BufferJudge::second_field() const {
  core::Field field = first_;
  field.parity = other(first_.parity);
  field.sequence += 1;
  field.number += 1;
  field.mid_exposure += agreed_.span;
  return field;
}

FieldLines BufferJudge::lines_of(Parity parity) const {
  return agreed_.lines_of(parity == Parity::kOdd, odd_above_);
}

void BufferJudge::look_at_picture(core::Field& field, bool unwritten) {
  CameraCounters& counters = report_->counters;
  if (unwritten) {
    // What is in it beside is not looked at; a buffer that the driver flagged is told once.
    if (field.status == FieldStatus::kGood) {
      doubt(field, CameraTrouble::kDamaged, counters.unwritten);
    }
    return;
  }
  switch (look_at(field.pixels)) {
    case Look::kPicture: return;
    case Look::kNoise: doubt(field, CameraTrouble::kNoise, counters.noise); return;
    case Look::kBlank: doubt(field, CameraTrouble::kBlank, counters.blank); return;
    case Look::kBlack: ++counters.black; return;  // the session says that it is dark
  }
}

}  // namespace tubesight::drivers::v4l2
