#include "core/verification/start_judge.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"

namespace tubesight::core::verification {

template <Scalar S>
void StartJudge<S>::configure() {
  // What the tool can go in this time at the greatest speed, a quarter more, stays below three
  // quarters of a step: 0.6 step / speed.
  const std::int64_t step_q16 = to_scaled(model_->lattice.parameters().shortest_step, 16);
  const std::int64_t speed_q4 = to_scaled(model_->max_speed_mm_s, 4);
  const std::int64_t gap_us = speed_q4 > 0 ? step_q16 * 600'000 / (speed_q4 << 12) : 0;
  longest_gap_ = std::chrono::microseconds(gap_us);
  picture_.configure({model_->window, longest_gap_});
}

template <Scalar S>
void StartJudge<S>::look(const Field& field, bool tracking) {
  present_ = field.number;
  by_track_ = tracking;
  // Not what StillPicture asks: a track follows fields of either parity, and a damaged one between
  // them counts; pictures are compared with good ones of their own parity.
  const FieldTime passed = field.mid_exposure - last_time_;
  in_time_ = field.status == FieldStatus::kGood && passed > FieldTime(0) &&
             passed <= longest_gap_ && field.sequence >= last_sequence_;
  if (field.status != FieldStatus::kMissing) {
    last_time_ = field.mid_exposure;
    last_sequence_ = field.sequence;
  }
  if (tracking) {
    picture_.forget();
  } else {
    tracked_rest_ = false;
    picture_.look(field);
  }
}

template <Scalar S>
StartRefusal StartJudge<S>::judge(const Start& start) const {
  if (!start.seen_field || *start.seen_field == present_) {
    return StartRefusal::kNone;
  }
  if (*start.seen_field > present_ || *start.seen_field < 0) {
    return StartRefusal::kUnknownField;
  }
  if (by_track_) {
    const bool rested = tracked_rest_ && in_time_ && rest_since_ <= *start.seen_field;
    return rested ? StartRefusal::kNone : StartRefusal::kMoved;
  }
  const std::int64_t* const since = picture_.since();
  return since != nullptr && *since <= *start.seen_field ? StartRefusal::kNone
                                                         : StartRefusal::kMoved;
}

template <Scalar S>
void StartJudge<S>::follow(const RecentField<S>& field) {
  const bool known = field.sighting.judged && field.sighting.state == TrackState::kTracking;
  if (!known) {
    tracked_rest_ = false;
    return;
  }
  if (!tracked_rest_ || has_moved(field.pose)) {
    tracked_rest_ = true;
    rest_pose_ = field.pose;
    rest_since_ = field.sighting.field;
  }
}

// More than an eighth of the bore's radius where the anchor of the rest's beginning shows: clicks
// up to 60 % of the radius off stay in the dark of their tube-ends.
template <Scalar S>
bool StartJudge<S>::has_moved(const tracking::SheetPose<S>& pose) const {
  const auto before = tracking::project<S>(*model_, rest_pose_, {});
  const auto now =
      tracking::project<S>(*model_, pose, model_->lattice.offset(pose.anchor, rest_pose_.anchor));
  if (!before || !now) {
    return true;
  }
  const Mm<S> px_per_mm =
      quotient<Mm<S>>(model_->camera.parameters().scale_px.x, rest_pose_.origin.z);
  const Mm<S> radius_px = times(model_->bore_radius_mm, px_per_mm);
  const Vector2<Mm<S>> shift{convert<Mm<S>>(now->x - before->x),
                             convert<Mm<S>>(now->y - before->y)};
  return tracking::plane_length(shift) > times(radius_px, constant<Mm<S>>(0.125));
}

TUBESIGHT_INSTANTIATE_CLASS(StartJudge)

}  // namespace tubesight::core::verification
