#include "core/tracking/last_place.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "core/base/instantiate.h"
#include "core/base/overflow.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/tool_point.h"

namespace tubesight::core::tracking {
namespace {

constexpr std::int64_t kMillion = 1'000'000;

// Microseconds, up to the time in which every tool is anywhere; products fit.
std::int64_t microseconds_of(FieldTime since) {
  constexpr FieldTime kLongest = std::chrono::seconds(1000);
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::clamp(since, FieldTime(0), kLongest))
      .count();
}

}  // namespace

template <Scalar S>
void LastPlace<S>::believe(const Field& field, TubeAddress anchor, const Vector2<Mm<S>>& local,
                           const Motion<S>& motion) {
  known_ = true;
  motion_known_ = motion.known;
  velocity_mm_s_ = motion.velocity_mm_s;
  interval_s_ = motion.interval_s;
  anchor_ = anchor;
  local_ = local;
  time_ = field.mid_exposure;
}

// Lengths are 1/16 mm.
template <Scalar S>
bool LastPlace<S>::within_reach(const TrackingModel<S>& model, const Vector2<Mm<S>>& way,
                                FieldTime since) const {
  const std::int64_t since_us = microseconds_of(since);
  const std::int64_t half_step_q4 = to_scaled(model.lattice.parameters().shortest_step, 4) / 2;
  const std::int64_t farthest_q4 = to_scaled(model.max_speed_mm_s, 4) * since_us / kMillion;
  const std::int64_t way_q4 = to_scaled(plane_length(way), 4);
  // A way that leaves the range of numbers is a long one.
  if (take_overflow_flag() || way_q4 > half_step_q4 + farthest_q4) {
    return false;
  }
  // Later the greatest speed says more, or as much.
  if (!motion_known_ || since_us >= kMillion) {
    return true;
  }
  // The velocity is that of the middle of its interval.
  const std::int64_t interval_us = to_scaled(interval_s_, 20) * kMillion / (1 << 20);
  const std::int64_t change_q4 = to_scaled(model.max_acceleration_m_s2, 4) * since_us / 1'000 *
                                 (since_us + interval_us) / kMillion;
  const auto beside_q4 = [since_us](Mm<S> passed, Mm<S> speed) {
    return std::int64_t{to_scaled(passed, 4)} - to_scaled(speed, 4) * since_us / kMillion;
  };
  const std::int64_t x_q4 = beside_q4(way.x, velocity_mm_s_.x);
  const std::int64_t y_q4 = beside_q4(way.y, velocity_mm_s_.y);
  const std::int64_t reach_q4 = half_step_q4 + change_q4;
  return x_q4 * x_q4 + y_q4 * y_q4 <= reach_q4 * reach_q4;
}

template <Scalar S>
bool LastPlace<S>::refutes(const Field& field, StartSearch<S>& search) const {
  if (!known_ || field.status != FieldStatus::kGood) {
    return false;
  }
  // A start may come of either search.
  const TrackingModel<S>& model = search.model();
  static_cast<void>(take_overflow_flag());  // of what came before
  for (const ClickSearch kind : {ClickSearch::kBisected, ClickSearch::kRound}) {
    const auto& clicked = search.by(kind);
    if (!clicked.answer.taken() || clicked.overflowed) {
      continue;
    }
    const auto tool = find_tool_point<S>(model, clicked.pose);
    if (take_overflow_flag() || !tool) {
      continue;
    }
    const Vector2<Mm<S>> way =
        model.lattice.offset(anchor_, clicked.pose.anchor) + tool->local - local_;
    if (!within_reach(model, way, field.mid_exposure - time_)) {
      return true;
    }
  }
  return false;
}

TUBESIGHT_INSTANTIATE_CLASS(LastPlace)

}  // namespace tubesight::core::tracking
