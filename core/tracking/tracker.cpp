#include "core/tracking/tracker.h"

#include "core/base/constant.h"
#include "core/base/overflow.h"
#include "core/tracking/attitude_gate.h"
#include "core/tracking/confirmed_start.h"

namespace tubesight::core::tracking {

template <Scalar S, typename Margin>
void Tracker<S, Margin>::step(const Field& field, Sighting& sighting, TubeSightingList& tubes) {
  judged_ = false;
  observer_.clear_field();
  static_cast<void>(take_overflow_flag());
  if (!starts(field) && knows_place()) {
    follow(field);
  }
  clicks_.reset();
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

// Whether there are clicks, and they take the track's place. Where they may not, nothing changes by
// them.
template <Scalar S, typename Margin>
bool Tracker<S, Margin>::starts(const Field& field) {
  if (!clicks_) {
    return false;
  }
  StartSearch<S> search(*model_, *map_, field.pixels, *clicks_);
  if (!confirmed_ && last_place_.refutes(field, search)) {
    start_answer_ = StartRefusal::kElsewhere;
    return false;
  }
  start(field, search);
  return true;
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::start(const Field& field, StartSearch<S>& search) {
  state_ = TrackState::kWaiting;
  reason_ = Reason::kStartRefused;
  primary_.forget();
  motion_ = {};
  doubt_.clear();
  refuted_.forget();
  old_pictures_.begin();
  clock_.begin();
  order_.begin();
  observer_.begin();
  map_watch_.begin();
  sites_.begin();
  if (field.status != FieldStatus::kGood) {
    start_answer_ = StartRefusal::kPicture;
    return;
  }
  Observation<S> seen;
  start_answer_ = find_confirmed_start<S>(search, observer_, seen);
  if (!start_answer_.taken()) {
    observer_.clear_field();  // addresses that were refuted are not told
    return;
  }
  accept(seen, field);
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::follow(const Field& field) {
  if (const Reason refused = clock_.refuses(field); refused != Reason::kNone) {
    lose(refused);
    return;
  }
  if constexpr (!Margin::kChecked) {
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
    const Reason why = missing ? Reason::kGap : gate_.why_exceeded();
    lose(coasts() ? Reason::kCoasted : why);
    return;
  }
  const SheetPose<S> predicted = predict<S>(*model_, good_.pose, good_.tool, motion_, span_s);
  if (field.status != FieldStatus::kGood || shows_old_picture(field)) {
    if (old_pictures_.stays_old()) {
      lose(Reason::kCoasted);
      return;
    }
    const bool no_field = field.status == FieldStatus::kMissing;
    coast(no_field ? Reason::kNoField : Reason::kDamagedField, predicted);
    return;
  }
  const Observation<S> seen =
      observer_.observe(field.pixels, {predicted, gate_.believed_mm(), motion_.known});
  if (seen.contradiction) {
    doubt(seen.trouble == Reason::kNone ? Reason::kJump : seen.trouble, field, predicted, seen);
    return;
  }
  if (!seen.fitted) {
    coast(seen.trouble, predicted);
    return;
  }
  if (const Reason refused = gate(seen, predicted, span_s); refused != Reason::kNone) {
    doubt(refused, field, predicted, seen);
    return;
  }
  if (refuted_.come_back(field, {seen.pose.anchor, seen.tool.local, seen.deviation_mm})) {
    lose(Reason::kJump);
    return;
  }
  motion_ = motion_between<S>(good_.pose, good_.tool, seen.pose, seen.tool, motion_, span_s);
  accept(seen, field);
}

// Whether the last field already was not believed: what is lost then has been passed over too long.
template <Scalar S, typename Margin>
bool Tracker<S, Margin>::coasts() const {
  return state_ == TrackState::kDegraded && reason_ != Reason::kNone &&
         reason_ != Reason::kFewTubes && reason_ != Reason::kUncertain;
}

template <Scalar S, typename Margin>
bool Tracker<S, Margin>::shows_old_picture(const Field& field) {
  // What was passed over may have been the end of the motion.
  return old_pictures_.shows_old(field, model_->window, !coasts() && travels<S>(motion_));
}

template <Scalar S, typename Margin>
Reason Tracker<S, Margin>::gate(const Observation<S>& seen, const SheetPose<S>& predicted,
                                Unit<S> span_s) const {
  const auto expected = find_tool_point<S>(*model_, predicted);
  if (!expected) {
    return Reason::kJump;
  }
  const Reason place =
      gate_.refuses(seen.tool.local, seen.deviation_mm, few_are_left<S>(seen, good_, 2),
                    expected->local, good_.tool.local, span_s);
  return place != Reason::kNone ? place
                                : refuses_attitude<S>(*model_, seen, predicted, expected->height_mm,
                                                      good_, motion_, span_s);
}

// Believes what the field shows. The motion is that from the field believed before to this one.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::accept(const Observation<S>& seen, const Field& field) {
  good_ = seen;
  judged_ = true;
  gate_.close(seen.deviation_mm, seen.picture_deviation_mm);
  clock_.believe(field);
  doubt_.agree(seen.fit.used);
  old_pictures_.believe(rest_of<S>(motion_, field.parity));
  order_.believe(field, seen.tool.local);
  last_place_.believe(field, seen.pose.anchor, seen.tool.local, motion_);
  judge(seen);
  primary_.choose<S>(observer_.record().measured, model_->optimum_px);
  reanchor();
  shown_ = {good_.pose, good_.tool};
  watch_map();
  remember_sites();
  if (Margin::kChecked && order_.wrong()) {
    lose(Reason::kFieldOrder);
  } else if (Margin::kChecked && map_watch_.refuted()) {
    lose(Reason::kMap);
  }
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::watch_map() {
  map_watch_.see(observer_.record().sites);
  if (map_watch_.asks()) {
    map_watch_.take_answer(observer_.fits_other_addresses());
  }
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::remember_sites() {
  const FieldRecord<S>& record = observer_.record();
  for (const auto& tube : record.measured) {
    if (tube.used) {
      sites_.saw_tube_end(tube.address);
    } else {
      sites_.saw_dark(tube.address);  // a rim off the plane: a plug may have one
    }
  }
  const SiteSightings& sites = record.sites;
  const TubeAddress tool = model_->lattice.nearest(good_.pose.anchor, good_.tool.local);
  const auto saw_closed = [&](TubeAddress address) {
    sites_.saw_closed(address, clear_of_guidetube<S>(*model_, good_.pose, address), tool);
  };
  for (const TubeAddress address : sites.bright) {
    saw_closed(address);
  }
  for (std::int32_t i = 0; i < sites.dark.size(); ++i) {
    if (((sites.flat >> static_cast<unsigned>(i)) & 1U) != 0) {
      saw_closed(sites.dark[i]);
    } else {
      sites_.saw_dark(sites.dark[i]);
    }
  }
  sites_.end_field();
}

// How far a field that is believed can be relied on.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::judge(const Observation<S>& seen) {
  const Mm<S> doubtful = constant<Mm<S>>(0.75);  // an offset of 2.5 mm means little
  if (doubts()) {
    reason_ = doubt_.reason();
  } else if (seen.fit.used < 3) {
    reason_ = Reason::kFewTubes;
  } else {
    reason_ = seen.deviation_mm > doubtful ? Reason::kUncertain : Reason::kNone;
  }
  state_ = reason_ == Reason::kNone ? TrackState::kTracking : TrackState::kDegraded;
}

// Moves the pose's origin to the primary tube, so that levers stay short wherever the tool goes.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::reanchor() {
  if (!primary_.known() || primary_.is(good_.pose.anchor)) {
    return;
  }
  const auto shift = model_->lattice.offset(good_.pose.anchor, primary_.address());
  good_.pose.origin = good_.pose.origin + good_.pose.along(shift);
  good_.pose.anchor = primary_.address();
  good_.tool.local = good_.tool.local - shift;
  order_.move_anchor(shift);
}

// A good picture refutes the prediction.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::doubt(Reason reason, const Field& field, const SheetPose<S>& predicted,
                               const Observation<S>& seen) {
  const bool jumped = motion_.known && is_jump(field, predicted, seen);
  if (motion_.known) {
    order_.look_aside(field, good_.pose, gate_.widest_look_mm(), doubt_.contradicted(), observer_);
  }
  doubt_.raise(reason);
  if (doubt_.is_certainty() || jumped || !motion_.known) {
    lose(order_.explains(clock_.usual_span_ns()) ? Reason::kFieldOrder : reason);
    return;
  }
  coast(reason, predicted);
}

// Whether a picture that refutes the prediction shows the sheet well, elsewhere: looked for in the
// whole cell of a tube, as the pattern repeats beyond it.
template <Scalar S, typename Margin>
bool Tracker<S, Margin>::is_jump(const Field& field, const SheetPose<S>& predicted,
                                 const Observation<S>& seen) {
  const auto shows_sheet = [](const Observation<S>& look) {
    return look.fitted && !look.contradiction && look.fit.used >= 3 &&
           2 * look.fit.used > look.looked_at;
  };
  Observation<S> look = seen;
  if (!shows_sheet(look)) {
    const Mm<S> half = times(model_->lattice.parameters().shortest_step, constant<Mm<S>>(0.5));
    look = observer_.glance(field.pixels, {predicted, half, true});
  }
  const auto expected = find_tool_point<S>(*model_, predicted);
  if (!shows_sheet(look) || !expected) {
    return false;
  }
  const Unit<S> a_field_s = seconds<S>(FieldTime(clock_.usual_span_ns()));
  return refuted_.refute(
      field, {look.pose.anchor, look.tool.local, look.deviation_mm},
      {expected->local,
       {times(motion_.velocity_mm_s.x, a_field_s), times(motion_.velocity_mm_s.y, a_field_s)},
       gate_.believed_mm()});
}

// Passes over a field: the prediction stands for it.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::coast(Reason reason, const SheetPose<S>& predicted) {
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
  shown_ = {predicted, *tool};
  gate_.pass_over();
}

// Ends the track until a new start.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::lose(Reason reason) {
  state_ = TrackState::kLost;
  reason_ = reason;
  judged_ = false;
  primary_.forget();
  observer_.clear_field();
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::report(const Field& field, Sighting& sighting,
                                TubeSightingList& tubes) const {
  sighting = {};
  tubes.clear();
  sighting.time = field.mid_exposure;
  sighting.state = state_;
  sighting.reason = reason_;
  sighting.field = field.number;
  sighting.status = field.status;
  sighting.judged = judged_;
  if (judged_) {
    sighting.residual_px_q16 = to_scaled(good_.fit.rms_px, 16);
  }
  report_tubes<S>(observer_.record(), primary_, sighting, tubes);
  // After a picture that refuted the prediction nothing is said of the tool until two agree.
  if (doubts() || !knows_place()) {
    return;
  }
  report_axis<S>(*model_, shown_, motion_, sighting);
  const NearestTube<S> nearest = find_nearest_tube<S>(*model_, shown_);
  const Mm<S> margin = gate_.margin(nearest.to_edge_mm);
  report_margin(margin, sighting);
  // Four standard deviations from the rounding limit, or the address is not said.
  const bool certain = !Margin::kChecked || margin >= constant<Mm<S>>(4.0);
  if (certain && map_->state(nearest.address) != TubeState::kAbsent &&
      sites_.vouches_for(nearest.address)) {
    report_tool<S>(*model_, shown_.pose, nearest, sighting);
  }
}

template <Scalar S, typename Margin>
void Tracker<S, Margin>::list_estimates(CandidateList<S>& estimates) const {
  estimates.clear();
  if (knows_place()) {
    list_candidates<S>(*model_, *map_, shown_.pose, estimates);
  }
}

template <Scalar S, typename Margin>
bool Tracker<S, Margin>::locate(TubeAddress address, ImagePoint& pixel) const {
  return knows_place() && locate_tube<S>(*model_, shown_.pose, address, pixel);
}

TUBESIGHT_INSTANTIATE_POLICY_CLASS(Tracker)

}  // namespace tubesight::core::tracking
