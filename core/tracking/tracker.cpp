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

template <Scalar S>
bool Tracker<S>::shows_old_picture(const Field& field) {
  return old_pictures_.shows_old(field, model_->window_left_px, model_->window_top_px,
                                 model_->window_right_px, model_->window_bottom_px);
}

template <Scalar S>
void Tracker<S>::follow(const Field& field) {
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
  gate_.open(motion_, span_s, doubt_.contradicted());
  if (gate_.exceeds_limit()) {
    const bool coasting = reason_ != Reason::kNone && state_ == TrackState::kDegraded &&
                          reason_ != Reason::kFewTubes && reason_ != Reason::kUncertain;
    const Reason why = missing ? Reason::kGap : gate_.why_exceeded();
    lose(coasting ? Reason::kCoasted : why);
    return;
  }
  const SheetPose<S> predicted = predict<S>(*model_, pose_, tool_, motion_, span_s);
  if (field.status != FieldStatus::kGood || shows_old_picture(field)) {
    const bool no_field = field.status == FieldStatus::kMissing;
    coast(no_field ? Reason::kNoField : Reason::kDamagedField, predicted);
    return;
  }
  const Observation<S> outcome =
      observer_.observe(field.pixels, {predicted, gate_.believed_mm(), motion_.known});
  if (outcome.contradiction) {
    doubt(outcome.trouble == Reason::kNone ? Reason::kJump : outcome.trouble, field, predicted);
    return;
  }
  if (!outcome.fitted) {
    coast(outcome.trouble, predicted);
    return;
  }
  if (const Reason refused = gate(outcome, predicted, span_s); refused != Reason::kNone) {
    doubt(refused, field, predicted);
    return;
  }
  accept(outcome, field, span_s);
}

template <Scalar S>
Reason Tracker<S>::gate(const Observation<S>& outcome, const SheetPose<S>& predicted,
                        Unit<S> span_s) const {
  const auto expected = find_tool_point<S>(*model_, predicted);
  if (!expected) {
    return Reason::kJump;
  }
  return gate_.refuses(outcome.tool.local, outcome.deviation_mm, expected->local, tool_.local,
                       span_s);
}

template <Scalar S>
void Tracker<S>::accept(const Observation<S>& outcome, const Field& field, Unit<S> span_s) {
  if (state_ == TrackState::kTracking || state_ == TrackState::kDegraded) {
    motion_ = motion_between<S>(pose_, tool_, outcome.pose, outcome.tool, motion_, span_s);
  }
  pose_ = outcome.pose;
  tool_ = outcome.tool;
  gate_.close(outcome.deviation_mm, outcome.picture_deviation_mm);
  residual_px_ = outcome.fit.rms_px;
  clock_.believe(field);
  doubt_.agree();
  old_pictures_.believe(rests<S>(motion_));
  order_.believe(field, tool_.local);
  measured_now_ = true;
  const Mm<S> doubtful = from_scaled<Mm<S>>(3, 2);  // 0.75 mm: an offset of 2.5 mm means little
  if (outcome.fit.used < 3) {
    reason_ = Reason::kFewTubes;
  } else {
    reason_ = outcome.deviation_mm > doubtful ? Reason::kUncertain : Reason::kNone;
  }
  if (doubt_.lasts()) {
    reason_ = doubt_.reason();
  }
  state_ = reason_ == Reason::kNone ? TrackState::kTracking : TrackState::kDegraded;
  primary_.choose<S>(observer_.record().measured, model_->optimum_px);
  reanchor();
  shown_ = pose_;
  tool_shown_ = tool_;
  if (order_.wrong() && model_->margin_check) {
    lose(Reason::kFieldOrder);
  }
}

template <Scalar S>
void Tracker<S>::doubt(Reason reason, const Field& field, const SheetPose<S>& predicted) {
  if (motion_.known) {
    order_.look_aside(field, pose_, gate_.widest_look_mm(), doubt_.contradicted(), observer_);
  }
  doubt_.raise(reason);
  if (doubt_.is_certainty() || !motion_.known) {
    lose(order_.explains(clock_.usual_span_ns()) ? Reason::kFieldOrder : reason);
    return;
  }
  coast(reason, predicted);
}

template <Scalar S>
void Tracker<S>::coast(Reason reason, const SheetPose<S>& predicted) {
  const auto tool = find_tool_point<S>(*model_, predicted);
  if (!tool) {
    lose(Reason::kJump);
    return;
  }
  if (!doubt_.contradicted()) {
    order_.miss();
  }
  state_ = TrackState::kDegraded;
  reason_ = reason;
  observer_.clear_field();
  shown_ = predicted;
  tool_shown_ = *tool;
  gate_.pass_over();
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
  order_.move_anchor(shift);
}

TUBESIGHT_INSTANTIATE_CLASS(Tracker)

}  // namespace tubesight::core::tracking
