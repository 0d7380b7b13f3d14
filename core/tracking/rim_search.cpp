#include "core/tracking/rim_search.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/edges/edge_search.h"

namespace tubesight::core::tracking {
namespace {

using edges::Edge;
using edges::EdgePath;
using edges::EdgePeak;
using edges::EdgeReach;

// A search along a path: where the rim is expected and how to read it. Positions are readings:
// every `step`-th pixel or line, `offset` being the first.
struct Search {
  EdgePath path;
  std::int32_t step = 1;
  std::int32_t offset = 0;
  std::int32_t expected = 0;   // nearest position
  std::int32_t direction = 1;  // outwards
  std::int32_t range = 0;
  std::int32_t taps = 0;
  std::int32_t positions = 0;  // that the path has
  bool weigh = false;          // positions are too far apart to interpolate between
  EdgeReach reach;
};

bool stays_inside(const Search& s) {
  const std::int32_t reading = s.range + s.taps + 4;
  const std::int32_t levels =
      s.range + (s.reach.dark > s.reach.bright ? s.reach.dark : s.reach.bright) + 3;
  const std::int32_t most = reading > levels ? reading : levels;
  return s.expected - most >= 0 && s.expected + most < s.positions;
}

// The edge at a peak of readings that pixels or lines lie between.
Edge edge_between(const Search& s, const EdgePeak& peak, std::int32_t least_contrast) {
  const EdgePath each{s.path.origin, s.path.step / s.step, s.path.side};
  const EdgePeak there{true, peak.position * s.step, peak.gradient};
  const EdgeReach reach{s.reach.dark * s.step, s.reach.bright * s.step};
  Edge edge = s.weigh ? edges::weigh_edge(each, there, s.direction, least_contrast)
                      : edges::refine_edge_coarsely(each, there, s.direction, reach, s.step,
                                                    least_contrast);
  edge.position_q16 += s.offset * 65536;
  return edge;
}

// The search is bounded so closely that no other tube-end's edge can be met: a difficult edge,
// below the threshold, is taken at half of it in the same walk. Else it is tried again at half of
// that with the start moved inwards.
Edge search_outwards(const Search& s, std::int32_t least_contrast,
                     edges::DynamicThreshold& threshold) {
  std::int32_t inwards = s.range;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const EdgePeak peak =
        edges::find_edge(s.path, {s.expected - s.direction * inwards, s.direction,
                                  inwards + s.range + 1, s.taps, threshold.for_taps(s.taps) / 2});
    if (peak.found) {
      threshold.follow(peak.gradient, s.taps);
      if (s.step > 1) {
        return edge_between(s, peak, least_contrast);
      }
      return s.weigh ? edges::weigh_edge(s.path, peak, s.direction, least_contrast)
                     : edges::refine_edge(s.path, peak, s.direction, s.reach, least_contrast);
    }
    if (threshold.at_least()) {
      break;
    }
    threshold.halve();
    ++inwards;
  }
  return {};
}

// Where the rim crosses a line (or column) of the picture near one of its points.
template <Scalar S>
struct Crossing {
  Mm<S> slope{};     // of the rim: across per along the other axis
  Mm<S> position{};  // px
};

// A rim point seen along a search: `across` runs with the search, `lane` names the line or column.
template <Scalar S>
struct Lane {
  Px<S> across{};
  Px<S> lane{};
  Px<S> across_tangent{};
  Px<S> lane_tangent{};
  Px<S> across_outward{};
  Px<S> lane_outward{};
};

// The rim point is carried along the rim by the angle that takes it to the lane, to second order;
// the second derivative of a nearly elliptic rim is the vector to its middle.
template <Scalar S>
Crossing<S> crossing(const Lane<S>& rim, Px<S> lane) {
  using M = Mm<S>;
  const Unit<S> per_lane = quotient<Unit<S>>(Px<S>(1), rim.lane_tangent);
  const Px<S> off = lane - rim.lane;
  M angle = times(convert<M>(off), per_lane);
  const M half = constant<M>(0.5);
  const M bend = times(times(angle, angle), half);
  angle += times(times(bend, rim.lane_outward), per_lane);
  const auto moved = product(angle, rim.across_tangent) - product(bend, rim.across_outward);
  return {times(convert<M>(rim.across_tangent), per_lane),
          convert<M>(rim.across) + narrow<M>(moved)};
}

// Reads every `step`-th pixel or line alone; one of these readings is where the rim is expected.
void read_every(std::int32_t step, Search& s) {
  if (step <= 1 || s.expected < 0) {
    return;
  }
  s.step = step;
  s.offset = s.expected % step;
  s.path = edges::every(s.path, step, s.offset);
  s.expected /= step;
  s.positions = (s.positions - s.offset + step - 1) / step;
  s.range = (s.range + step - 1) / step;
}

// The search along the field's line nearest to the rim point.
template <Scalar S>
bool line_search(const FieldView& field, const Lane<S>& rim, const MeasurementBounds& bounds,
                 Search& s, Crossing<S>& found) {
  const std::int32_t twice = 2 * (rounded(rim.lane) - field.first_line);
  const std::int32_t line = (twice + field.line_step) / (2 * field.line_step);
  if (twice < 0 || line < 1 || line > field.lines - 2) {
    return false;
  }
  found = crossing<S>(rim, from_scaled<Px<S>>(line * field.line_step + field.first_line, 0));
  s.path = edges::horizontal_path(field, line);
  s.expected = rounded(found.position);
  s.range = bounds.range_px;
  s.taps = bounds.taps;
  s.positions = field.width_px;
  // Where the rim runs aslant the rise from dark to bright is longer.
  const std::int32_t slant = rounded(absolute(found.slope));
  s.reach = {4 + 2 * slant, 4 + 2 * slant};
  return true;
}

// The search along the column nearest to the rim point; positions are lines of the field.
template <Scalar S>
bool column_search(const FieldView& field, const Lane<S>& rim, const MeasurementBounds& bounds,
                   Search& s, Crossing<S>& found) {
  const std::int32_t column = rounded(rim.lane);
  if (column < 2 || column > field.width_px - 3) {
    return false;
  }
  found = crossing<S>(rim, from_scaled<Px<S>>(column, 0));
  s.path = edges::vertical_path(field, column);
  const bool interlaced = field.line_step == 2;
  const Mm<S> first = from_scaled<Mm<S>>(field.first_line, 0);
  s.expected = rounded(times(found.position - first, from_scaled<Mm<S>>(1, interlaced ? 1 : 0)));
  s.range = bounds.range_px / field.line_step + 1;
  s.taps = edges::kVerticalTaps;
  s.positions = field.lines;
  s.reach = {interlaced ? 2 : 4, interlaced ? 2 : 4};
  // Weighing needs a bright side of three lines.
  s.weigh = interlaced && !bounds.thin_rim;
  return true;
}

}  // namespace

template <Scalar S>
RimMiss search_rim(const FieldView& field, const Vector2<Px<S>>& point,
                   const Vector2<Px<S>>& tangent, const Vector2<Px<S>>& middle,
                   const MeasurementBounds& bounds, edges::DynamicThreshold& threshold,
                   RimEquation<S>& equation) {
  using P = Px<S>;
  using M = Mm<S>;
  const Vector2<P> outward = point - middle;
  // The rim's normal is (tangent v, -tangent u); a search along a line crosses it well where the
  // tangent is steep, and needs the chord's length for its inner pixels.
  const P run = absolute(tangent.x);
  const P rise = absolute(tangent.y);
  const std::int32_t half_chord = rounded(absolute(outward.x));
  const bool along_line = rise + rise + rise >= run &&
                          2 * half_chord >= bounds.range_px + bounds.step_px * (bounds.taps + 2);
  if (!along_line && run + run + run < rise + rise) {
    return RimMiss::kOutside;  // neither a line nor a column crosses the rim well here
  }
  const Lane<S> rim = along_line
                          ? Lane<S>{point.x, point.y, tangent.x, tangent.y, outward.x, outward.y}
                          : Lane<S>{point.y, point.x, tangent.y, tangent.x, outward.y, outward.x};
  Search s;
  Crossing<S> predicted;
  const bool possible = along_line ? line_search<S>(field, rim, bounds, s, predicted)
                                   : column_search<S>(field, rim, bounds, s, predicted);
  // Outwards along the search: the rim's normal has that sign there.
  const bool turned = product(tangent.y, outward.x) < product(tangent.x, outward.y);
  const P normal = along_line ? tangent.y : -tangent.x;
  s.direction = (normal < P{}) != turned ? -1 : 1;
  if (bounds.step_px > 1) {
    read_every(along_line ? bounds.step_px : bounds.step_px / field.line_step, s);
  }
  if (!possible || !stays_inside(s)) {
    return RimMiss::kOutside;
  }
  const Edge edge = search_outwards(s, bounds.least_contrast, threshold);
  if (!edge.found) {
    return RimMiss::kNoEdge;
  }
  const std::int64_t found_q16 =
      along_line ? edge.position_q16
                 : std::int64_t{edge.position_q16} * field.line_step + field.first_line * 65536;
  equation.along_line = along_line;
  equation.slope = predicted.slope;
  equation.distance = from_scaled<M>(found_q16, 16) - predicted.position;
  const M aside = times(predicted.slope, rim.lane_outward);
  equation.reach = times(convert<M>(rim.across_outward) - aside, constant<M>(1.0 / 32.0));
  equation.weight = quotient<M>(M(1), M(1) + times(predicted.slope, predicted.slope));
  equation.contrast = edge.contrast;
  return RimMiss::kNone;
}

#define TUBESIGHT_INSTANTIATE(S)                                                                 \
  template RimMiss search_rim<S>(const FieldView&, const Vector2<Px<S>>&, const Vector2<Px<S>>&, \
                                 const Vector2<Px<S>>&, const MeasurementBounds&,                \
                                 edges::DynamicThreshold&, RimEquation<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
