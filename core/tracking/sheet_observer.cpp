#include "core/tracking/sheet_observer.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/base/overflow.h"
#include "core/tracking/bright_patch.h"
#include "core/tracking/circle_shift.h"
#include "core/tracking/picture_light.h"
#include "core/tracking/plane_length.h"

namespace tubesight::core::tracking {
namespace {

// Tube-ends that fit one pose: no chance.
constexpr std::int32_t kMany = 8;

// How far a rim may be from where a good pose puts it, in readings of a search.
constexpr std::int32_t kCloseRange = 3;

// How well bisection places the tube-ends, mm: two pixels. What it finds is fitted and then gated.
template <typename M>
M bisected_mm() {
  return constant<M>(0.5);
}

// Lean 0.5 degrees always; turn 0.1 degrees and height 0.5 mm from field to field, once a motion
// predicts them: kEdgeDeviation^2 / sigma^2.
//
// Against edges of 0.2 px in usual pictures. In larger ones an edge is off by what the sheet's
// tube-ends are off their places rather than by noise, in as many more pixels.
template <Scalar S>
PosePrior<S> prior_of(const TrackingModel<S>& model, const Expectation<S>& expected) {
  using M = Mm<S>;
  const std::int32_t step = model.reading_step_px;
  const auto scaled = [step](M weight) { return times(weight, from_scaled<M>(step * step, 0)); };
  PosePrior<S> prior;
  prior.lean_weight = scaled(constant<M>(0.032));
  if (expected.from_motion) {
    prior.turn_weight = scaled(constant<M>(0.8));
    prior.height_weight = scaled(constant<M>(0.16));
  }
  return prior;
}

// In the fit's unknowns, w in 1/128 rad: heading n . w, lean x . w and y . w, height
// n . t + (n x arm) . w where arm leads from the tip to the anchor.
template <Scalar S>
AttitudeDeviation<S> attitude_deviation(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                        const NormalEquations<S>& equations, Mm<S> excess) {
  using M = Mm<S>;
  const M scale = times(from_scaled<M>(kEdgeDeviationQ10, 10), excess);
  const M per_unknown = constant<M>(1.0 / 128.0);
  const auto scaled = [scale](M deviation) {
    return times(scale, std::min(deviation, constant<M>(30.0)));
  };
  const auto turn = [&](const Vector3<Unit<S>>& axis) {
    return times(scaled(equations.deviation(
                     {convert<M>(axis.x), convert<M>(axis.y), convert<M>(axis.z), M{}, M{}, M{}})),
                 per_unknown);
  };
  const Vector3<M> lever = cross<M>(pose.normal, pose.origin - model.tip_mm);
  AttitudeDeviation<S> known;
  known.heading_rad = turn(pose.normal);
  known.lean_rad = plane_length(Vector2<M>{turn(pose.x_axis), turn(pose.y_axis)});
  known.height_mm = scaled(equations.deviation(
      {times(lever.x, per_unknown), times(lever.y, per_unknown), times(lever.z, per_unknown),
       convert<M>(pose.normal.x), convert<M>(pose.normal.y), convert<M>(pose.normal.z)}));
  return known;
}

// How well the place and the attitude are known.
template <Scalar S>
void judge_deviations(const TrackingModel<S>& model, const NormalEquations<S>& equations,
                      Observation<S>& seen) {
  using M = Mm<S>;
  // Distances larger than edges of 0.2 px explain make the place as much less certain: the centre
  // of a rim point's fit is known to some 0.125 px then.
  const M excess = std::max(M(1), times(convert<M>(seen.fit.rms_px), constant<M>(8.0)));
  seen.picture_deviation_mm =
      times(tool_point_deviation<S>(seen.pose, seen.tool, equations), excess);
  seen.attitude = attitude_deviation<S>(model, seen.pose, equations, excess);
  // Independent of each other: sqrt(picture^2 + systematic^2).
  seen.deviation_mm =
      plane_length(Vector2<M>{seen.picture_deviation_mm, systematic_deviation_mm<M>()});
}

// Leaves out what is seen of nothing: sites that are one grey value alone, far beyond their rims,
// where tube-ends show that the camera has noise. A cloth, a shutter or a title hides them.
void leave_out_blank(FindingCount& found, SiteSightings& sites) {
  if (found.blank == 0 || 2 * found.noisy <= found.measured) {
    return;
  }
  found.looked_at -= found.blank;
  found.bright -= found.bright_blank;
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < sites.bright.size(); ++i) {
    if (((sites.blank >> static_cast<unsigned>(i)) & 1U) == 0) {
      sites.bright[kept++] = sites.bright[i];
    }
  }
  sites.bright.truncate(kept);
  sites.blank = 0;
}

}  // namespace

template <Scalar S>
void SheetObserver<S>::begin(const LightLevels& light) {
  record_.plugs.clear();
  record_.light = light;
}

template <Scalar S>
Observation<S> SheetObserver<S>::observe(const FieldView& field, const Expectation<S>& expected) {
  using M = Mm<S>;
  Observation<S> seen;
  seen.pose = expected.pose;
  const auto light = judge_light(field, model_->window);
  if (light != PictureLight::kUsable) {
    seen.trouble = light == PictureLight::kDark ? Reason::kDark : Reason::kWashedOut;
    return seen;
  }
  // There is light and no tube-end where they must be: no reason to wait for a better picture.
  const auto no_tubes = [&seen] {
    seen.trouble = Reason::kNoTubes;
    seen.contradiction = true;
    return seen;
  };
  list_candidates<S>(*model_, *map_, seen.pose, candidates_, &closed_);
  // Pixels per mm at the anchor, in the middle of the view: f / z.
  const M px_per_mm = quotient<M>(model_->camera.parameters().scale_px.x, seen.pose.origin.z);
  const std::int32_t step_px = model_->reading_step_px;
  std::int32_t range_px = kCloseRange * step_px + to_scaled(times(expected.reach_mm, px_per_mm), 0);
  constexpr std::int32_t kWidestRange = 9;
  if (range_px > kWidestRange * step_px) {
    const M reach = expected.reach_mm + bisected_mm<M>();
    // Right after a start a spoilt picture is worth a longer look.
    if (!shift_onto_dark_regions<S>(*model_, field, candidates_, reach, record_.light, seen.pose) &&
        (expected.from_motion ||
         !shift_onto_circles<S>(*model_, field, candidates_, reach, seen.pose))) {
      return no_tubes();
    }
    list_candidates<S>(*model_, *map_, seen.pose, candidates_, &closed_);
    constexpr std::int32_t kBisectedRange = 6;
    range_px = kBisectedRange * step_px;
  }
  FindingCount found = measure_in_any_light(field, range_px, prior_of<S>(*model_, expected), seen);
  leave_out_blank(found, record_.sites);
  seen.looked_at = found.looked_at;
  // Half of them, or many and next to none bright: what is dark without a rim is in poor light.
  const bool confirmed = 2 * found.measured >= found.looked_at ||
                         (seen.fit.used >= kMany && 4 * found.bright <= seen.fit.used);
  // Sheet where tube-ends should be: a few are plugs, many are a wrong prediction.
  seen.contradiction = (found.bright > std::max(seen.fit.used, 2) && !outweighs_bright(seen.fit)) ||
                       (expected.confirm_all && !confirmed);
  if (!seen.fit.solved || seen.fit.used < 2) {
    return no_tubes();
  }
  const auto tool = find_tool_point<S>(*model_, seen.pose);
  if (!tool) {
    return no_tubes();
  }
  seen.tool = *tool;
  look_at_sites<S>(*model_, field, seen.pose, closed_, record_.light, record_.sites);
  judge_deviations<S>(*model_, equations_, seen);
  seen.fitted = true;
  return seen;
}

// Looks around the predicted rims as far as the prediction may be off for the nearest few tube-ends
// only; they tell the motion, and the others are looked for closely.
template <Scalar S>
FindingCount SheetObserver<S>::measure(const FieldView& field, std::int32_t range_px,
                                       const PosePrior<S>& prior, Observation<S>& seen) {
  constexpr std::int32_t kScouts = 6;
  const std::int32_t close_px = kCloseRange * model_->reading_step_px;
  record_.begin_field();
  FindingCount found;
  if (range_px > close_px) {
    found = measure_field<S>(*model_, field, seen.pose, candidates_,
                             {0, candidates_.size(), range_px, kScouts}, record_);
    seen.fit = fit_pose<S>(*model_, prior, record_.measured, equations_, seen.pose);
    if (!seen.fit.solved) {
      return found;
    }
  }
  found += measure_field<S>(*model_, field, seen.pose, candidates_,
                            {found.next, candidates_.size(), close_px}, record_);
  seen.fit = fit_pose<S>(*model_, prior, record_.measured, equations_, seen.pose);
  return found;
}

// Where nothing is dark enough the light may be another. A threshold that somebody set stays, and
// what bright tube-ends looked like is no plug; a light that tube-ends do not prove is forgotten.
template <Scalar S>
FindingCount SheetObserver<S>::measure_in_any_light(const FieldView& field, std::int32_t range_px,
                                                    const PosePrior<S>& prior,
                                                    Observation<S>& seen) {
  const LightLevels light = record_.light;
  const PlugMemory plugs = record_.plugs;
  FindingCount found = measure(field, range_px, prior, seen);
  if (found.measured > 0 || found.bright <= 2 || model_->region_threshold != 0 ||
      !follow_darkness<S>(*model_, field, seen.pose, candidates_, record_.light)) {
    return found;
  }
  record_.plugs = plugs;
  found = measure(field, range_px, prior, seen);
  if (found.bright > std::max(seen.fit.used, 2) || seen.fit.used < 2) {
    record_.light = light;
  }
  return found;
}

// Whether what fits is worth more than all that is bright: tube-ends enough to be no chance, and
// the bright ones one patch that no other addresses explain, not those of an edge far away either.
template <Scalar S>
bool SheetObserver<S>::outweighs_bright(const PoseFit<S>& fit) const {
  return fit.solved && fit.used >= kMany && is_one_patch<S>(*model_, record_.sites.bright) &&
         !fits_other_addresses() && !fits_an_edge<S>(*model_, *map_, record_);
}

template <Scalar S>
Observation<S> SheetObserver<S>::glance(const FieldView& field, const Expectation<S>& expected) {
  // What is learnt of light and plugs is learnt from pictures that are believed.
  const LightLevels light = record_.light;
  const PlugMemory plugs = record_.plugs;
  const bool overflowed = take_overflow_flag();
  Observation<S> seen = observe(field, expected);
  if (take_overflow_flag()) {
    seen.fitted = false;
  }
  if (overflowed) {
    raise_overflow_flag();
  }
  record_.light = light;
  record_.plugs = plugs;
  return seen;
}

TUBESIGHT_INSTANTIATE_CLASS(SheetObserver)

}  // namespace tubesight::core::tracking
