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

// How far the tool can have come in this time, and half a step, 1/16 mm.
template <Scalar S>
std::int64_t reach_q4(const TrackingModel<S>& model, FieldTime since) {
  // The time in which every tool is anywhere; products fit.
  constexpr FieldTime kLongest = std::chrono::seconds(1000);
  const auto since_us = std::chrono::duration_cast<std::chrono::microseconds>(
      std::clamp(since, FieldTime(0), kLongest));
  const std::int64_t half_step_q4 = to_scaled(model.lattice.parameters().shortest_step, 4) / 2;
  const std::int64_t speed_q4 = to_scaled(model.max_speed_mm_s, 4);
  return half_step_q4 + speed_q4 * since_us.count() / 1'000'000;
}

}  // namespace

template <Scalar S>
void LastPlace<S>::believe(const Field& field, TubeAddress anchor, const Vector2<Mm<S>>& local) {
  known_ = true;
  anchor_ = anchor;
  local_ = local;
  time_ = field.mid_exposure;
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
    const std::int64_t way_q4 = to_scaled(plane_length(way), 4);
    // A way that leaves the range of numbers is a long one.
    if (take_overflow_flag() || way_q4 > reach_q4<S>(model, field.mid_exposure - time_)) {
      return true;
    }
  }
  return false;
}

TUBESIGHT_INSTANTIATE_CLASS(LastPlace)

}  // namespace tubesight::core::tracking
