#include "core/tracking/tracker.h"

#include <algorithm>

#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
template <Scalar S>
void Tracker<S>::request_start(const StartClickList& clicks) {
  clicks_ = clicks;
  start_requested_ = true;
}

template <Scalar S>
void Tracker<S>::step(const Field& field, Sighting& sighting, TubeSightingList& tubes) {
  measured_now_ = false;
  observer_.clear_field();
  static_cast<void>(take_overflow_flag());
  if (start_requested_) {
    start_requested_ = false;
    start(field);
  } else if (state_ == TrackState::kTracking || state_ == TrackState::kDegraded) {
    follow(field);
  }
  if (take_overflow_flag() && state_ != TrackState::kWaiting) {
    lose(Reason::kArithmetic);
  }
  report(field, sighting, tubes);
  if (take_overflow_flag()) {
    lose(Reason::kArithmetic);
    report(field, sighting, tubes);
  }
  clock_.see(field);
}

// Why the tool can be too far from where it is expected, though no picture was unusable. With no
// field missing either, the limits of [motion] allow too much between two fields even on a perfect
// picture, or this picture is too poor.
template <Scalar S>
Reason Tracker<S>::why_too_far(bool missing, Mm<S> reach_mm) const {
  if (missing) {
    return Reason::kGap;
  }
  constexpr std::int32_t kDeviations = 3;
  const Mm<S> least = times(from_scaled<Mm<S>>(kDeviations, 0), systematic_deviation_mm<Mm<S>>());
  return reach_mm + least > address_limit_mm<S>(*model_) ? Reason::kRate : Reason::kUncertain;
}

template <Scalar S>
bool Tracker<S>::shows_old_picture(const Field& field) {
  return old_pictures_.shows_old(field, model_->window_left_px, model_->window_top_px,
                                 model_->window_right_px, model_->window_bottom_px);
}

template <Scalar S>
void Tracker<S>::follow(const Field& field) {
  using M = Mm<S>;
  if (const Reason refused = clock_.refuses(field); refused != Reason::kNone) {
    lose(refused);
    return;
  }
  if (!model_->margin_check) {
    follow_unchecked(field);
    return;
  }
  const auto [missing, since_good] = clock_.pass(field);
  if (missing) {
    order_.miss();
  }
  if (since_good >= std::chrono::seconds(1)) {
    lose(missing ? Reason::kGap : Reason::kRate);
    return;
  }
  const Unit<S> span_s = seconds<S>(since_good);
  predicted_deviation_mm_ =
      deviation_mm_ + velocity_deviation_mm<S>(motion_, picture_deviation_mm_, span_s);
  const M reach = reachable_mm<S>(*model_, motion_, span_s, predicted_deviation_mm_);
  const M uncertain =
      reach + predicted_deviation_mm_ + predicted_deviation_mm_ + predicted_deviation_mm_;
  const bool coasting = reason_ != Reason::kNone && state_ == TrackState::kDegraded &&
                        reason_ != Reason::kFewTubes && reason_ != Reason::kUncertain;
  if (uncertain > address_limit_mm<S>(*model_)) {
    lose(coasting ? Reason::kCoasted : why_too_far(missing, reach));
    return;
  }
  const SheetPose<S> predicted = predict<S>(*model_, pose_, tool_, motion_, span_s);
  // A picture that refuted the prediction showed the sheet: what comes back must fit the motion as
  // closely as it had to then, or it is another tube's neighbourhood.
  if (contradictions_ == 0) {
    believed_mm_ = reach;
  }
  const M believed = std::min(believed_mm_, reach);
  if (field.status != FieldStatus::kGood || shows_old_picture(field)) {
    const bool no_field = field.status == FieldStatus::kMissing;
    coast(no_field ? Reason::kNoField : Reason::kDamagedField, predicted, reach);
    return;
  }
  const Observation<S> outcome =
      observer_.observe(field.pixels, {predicted, believed, motion_.known});
  if (outcome.contradiction) {
    look_aside(field);
    doubt(outcome.trouble == Reason::kNone ? Reason::kJump : outcome.trouble, predicted, reach);
    return;
  }
  if (!outcome.fitted) {
    coast(outcome.trouble, predicted, reach);
    return;
  }
  if (const Reason refused = gate(outcome, predicted, believed, span_s); refused != Reason::kNone) {
    look_aside(field);
    doubt(refused, predicted, reach);
    return;
  }
  accept(outcome, field, span_s);
}

template <Scalar S>
Reason Tracker<S>::gate(const Observation<S>& outcome, const SheetPose<S>& predicted,
                        Mm<S> reach_mm, Unit<S> span_s) const {
  using M = Mm<S>;
  const auto expected = find_tool_point<S>(*model_, predicted);
  if (!expected) {
    return Reason::kJump;
  }
  const M noise = outcome.deviation_mm + outcome.deviation_mm + outcome.deviation_mm;
  if (plane_length(outcome.tool.local - expected->local) > reach_mm + noise) {
    return Reason::kJump;
  }
  const M farthest = times(model_->max_speed_mm_s, span_s);
  const M moved = plane_length(outcome.tool.local - tool_.local);
  // A quarter above the limit: its own control may overshoot, the box's noise adds to it.
  if (moved > farthest + times(farthest, from_scaled<M>(1, 2)) + noise) {
    return Reason::kSpeed;
  }
  return Reason::kNone;
}

template <Scalar S>
void Tracker<S>::accept(const Observation<S>& outcome, const Field& field, Unit<S> span_s) {
  if (state_ == TrackState::kTracking || state_ == TrackState::kDegraded) {
    motion_ = motion_between<S>(pose_, tool_, outcome.pose, outcome.tool, motion_, span_s);
  }
  pose_ = outcome.pose;
  tool_ = outcome.tool;
  deviation_mm_ = outcome.deviation_mm;
  predicted_deviation_mm_ = outcome.deviation_mm;
  picture_deviation_mm_ = outcome.picture_deviation_mm;
  residual_px_ = outcome.fit.rms_px;
  clock_.believe(field);
  contradictions_ = 0;
  to_agree_ = std::max(to_agree_ - 1, 0);
  old_pictures_.believe(rests<S>(motion_));
  note_place(field, tool_.local);
  measured_now_ = true;
  const Mm<S> doubtful = from_scaled<Mm<S>>(3, 2);  // 0.75 mm: an offset of 2.5 mm means little
  if (outcome.fit.used < 3) {
    reason_ = Reason::kFewTubes;
  } else {
    reason_ = outcome.deviation_mm > doubtful ? Reason::kUncertain : Reason::kNone;
  }
  if (to_agree_ > 0) {
    reason_ = doubted_;
  }
  state_ = reason_ == Reason::kNone ? TrackState::kTracking : TrackState::kDegraded;
  primary_.choose<S>(observer_.record().measured, model_->optimum_px);
  reanchor();
  shown_ = pose_;
  tool_shown_ = tool_;
  strayed_mm_ = {};
  if (order_.wrong() && model_->margin_check) {
    lose(Reason::kFieldOrder);
  }
}

// One field torn, repeated or of noise is passed over; three in a row are a jump. What comes behind
// it may be another false picture that happens to fit: two in a row must agree.
template <Scalar S>
void Tracker<S>::doubt(Reason reason, const SheetPose<S>& predicted, Mm<S> reach_mm) {
  constexpr std::int32_t kMostContradictions = 2;
  to_agree_ = 2;
  doubted_ = reason;
  if (++contradictions_ > kMostContradictions || !motion_.known) {
    lose(order_explains() ? Reason::kFieldOrder : reason);
    return;
  }
  coast(reason, predicted, reach_mm);
}

template <Scalar S>
void Tracker<S>::coast(Reason reason, const SheetPose<S>& predicted, Mm<S> reach_mm) {
  const auto tool = find_tool_point<S>(*model_, predicted);
  if (!tool) {
    lose(Reason::kJump);
    return;
  }
  if (contradictions_ == 0) {
    order_.miss();
  }
  state_ = TrackState::kDegraded;
  reason_ = reason;
  observer_.clear_field();
  shown_ = predicted;
  tool_shown_ = *tool;
  strayed_mm_ = reach_mm;
}

template <Scalar S>
void Tracker<S>::lose(Reason reason) {
  state_ = TrackState::kLost;
  measured_now_ = false;
  reason_ = reason;
  primary_.forget();
  observer_.clear_field();
}

// Moves the pose's origin to the primary tube, so that levers stay short wherever the tool goes.
template <Scalar S>
void Tracker<S>::reanchor() {
  if (!primary_.known() || primary_.is(pose_.anchor)) {
    return;
  }
  const auto shift = model_->lattice.offset(pose_.anchor, primary_.address());
  pose_.origin = pose_.origin + pose_.along(shift);
  pose_.anchor = primary_.address();
  tool_.local = tool_.local - shift;
  order_.shift({-to_scaled(shift.x, 10), -to_scaled(shift.y, 10)});
}

TUBESIGHT_INSTANTIATE_CLASS(Tracker)

}  // namespace tubesight::core::tracking
