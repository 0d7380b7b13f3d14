#include "core/picture/rest_average.h"

#include <algorithm>

#include "core/picture/rest_check.h"

namespace tubesight::core::picture {

Result<void> RestAverage::add(const FieldView& field) {
  const bool comparable = average_.count(field.first_line) > 0 && field.lines >= 3 &&
                          field.width_px == average_.width_px();
  if (comparable) {
    frame_shift_px_ = std::max(frame_shift_px_, shift_between_frames(average_, field).largest_px);
  }
  interlaced_ = interlaced_ || field.line_step == 2;
  return average_.add(field);
}

RestOutcome RestAverage::finish() {
  RestOutcome outcome;
  outcome.frame_shift_px = frame_shift_px_;
  if (interlaced_ && average_.count(0) > 0 && average_.count(1) > 0) {
    outcome.field_shift_px = shift_between_fields(average_).largest_px;
  }
  const auto picture = average_.finish();
  if (picture) {
    outcome.picture = *picture;
    outcome.rested = outcome.frame_shift_px <= kLargestFrameShift_px &&
                     outcome.field_shift_px <= kLargestFieldShift_px;
  }
  return outcome;
}

}  // namespace tubesight::core::picture
