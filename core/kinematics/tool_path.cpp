#include "core/kinematics/tool_path.h"

#include <cmath>
#include <cstddef>

#include "core/base/scalar.h"
#include "core/base/trigonometry.h"

namespace tubesight::core::kinematics {
namespace {

// The six numbers of a place: x, y, height, alpha, beta, gamma.
using Six = std::array<double, 6>;

Six six_of(const ToolPlace& p) {
  return {p.x_mm, p.y_mm, p.height_mm, p.alpha_deg, p.beta_deg, p.gamma_deg};
}

ToolPlace place_of(const Six& six) { return {six[0], six[1], six[2], six[3], six[4], six[5]}; }

bool finite(const ToolPlace& place) {
  for (const double number : six_of(place)) {
    if (!std::isfinite(number)) {
      return false;
    }
  }
  return true;
}

// What the speed profile measures: mm of the tip's way where there is one, else degrees. A docking
// without a change of height only straightens the tool.
double way(const ToolPlace& from, const ToolPlace& to) {
  const Six a = six_of(from);
  const Six b = six_of(to);
  double mm2 = 0.0;
  double deg2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    mm2 += (b[i] - a[i]) * (b[i] - a[i]);
    deg2 += (b[i + 3] - a[i + 3]) * (b[i + 3] - a[i + 3]);
  }
  return square_root(mm2 > 0.0 ? mm2 : deg2);
}

// A value with its first two derivatives in time.
struct Swing {
  double value = 0.0;
  double rate = 0.0;
  double rate2 = 0.0;
};

}  // namespace

Transform<frames::Sheet, frames::Tool> transform_of(const ToolPlace& place) {
  return {rotation_from_degrees({place.alpha_deg, place.beta_deg, place.gamma_deg}),
          Eigen::Vector3d(place.x_mm, place.y_mm, -place.height_mm)};
}

ToolPlace end_of(const PathSegment& segment, const ToolPlace& from) {
  ToolPlace place = from;
  switch (segment.kind) {
    case SegmentKind::kRest: break;
    case SegmentKind::kMove:
      place.x_mm = segment.to_mm[0];
      place.y_mm = segment.to_mm[1];
      break;
    case SegmentKind::kHeight: place.height_mm = segment.height_mm; break;
    case SegmentKind::kDock:
      place.height_mm = segment.height_mm;
      place.beta_deg = 0.0;
      place.gamma_deg = 0.0;
      break;
    case SegmentKind::kTurn: place.alpha_deg = segment.alpha_deg; break;
    case SegmentKind::kLean:
      place.beta_deg = segment.lean_deg[0];
      place.gamma_deg = segment.lean_deg[1];
      break;
    case SegmentKind::kJump: place = segment.place; break;
  }
  return place;
}

Result<void> ToolPath::begin(const ToolPlace& start) {
  if (!finite(start)) {
    return Unexpected(Error::kInvalidArgument);
  }
  segments_.clear();
  start_ = start;
  end_ = start;
  duration_s_ = 0.0;
  return {};
}

Result<void> ToolPath::add(const PathSegment& segment) {
  Segment added;
  added.start_s = duration_s_;
  added.from = end_;
  added.to = end_of(segment, end_);
  if (!finite(added.to)) {
    return Unexpected(Error::kInvalidArgument);
  }
  if (segment.kind == SegmentKind::kRest) {
    if (!(segment.rest_s >= 0.0) || !std::isfinite(segment.rest_s)) {
      return Unexpected(Error::kInvalidArgument);
    }
    added.duration_s = segment.rest_s;
  } else if (segment.kind == SegmentKind::kJump) {
    added.from = added.to;
  } else {
    const auto profile =
        SpeedProfile::make(way(added.from, added.to), segment.shape, segment.limits);
    if (!profile) {
      return Unexpected(profile.error());
    }
    added.profile = *profile;
    added.duration_s = profile->duration_s();
  }
  if (!segments_.try_push_back(added)) {
    return Unexpected(Error::kBufferTooSmall);
  }
  duration_s_ += added.duration_s;
  end_ = added.to;
  return {};
}

// The last segment that has begun; by halving, as paths of hours have a thousand.
std::int32_t ToolPath::segment_at(double time_s) const {
  if (!(time_s >= 0.0) || segments_.empty()) {
    return -1;
  }
  if (time_s >= duration_s_) {
    return segments_.size();
  }
  std::int32_t low = 0;
  std::int32_t high = segments_.size();
  while (high - low > 1) {
    const std::int32_t middle = low + (high - low) / 2;
    (segments_[middle].start_s <= time_s ? low : high) = middle;
  }
  return low;
}

ToolState ToolPath::state_at(double time_s) const {
  ToolState state;
  state.segment = segment_at(time_s);
  std::array<Swing, 6> six{};
  Six from = six_of(state.segment < 0 ? start_ : end_);
  Six to = from;
  ProfilePoint along;
  double length = 0.0;
  if (state.segment >= 0 && state.segment < segments_.size()) {
    const Segment& segment = segments_[state.segment];
    from = six_of(segment.from);
    to = six_of(segment.to);
    along = segment.profile.at(time_s - segment.start_s);
    length = segment.profile.length();
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const double slope = length > 0.0 ? (to[i] - from[i]) / length : 0.0;
    six[i] = {from[i] + slope * along.distance, slope * along.speed, slope * along.acceleration};
  }
  Six values{};
  for (std::size_t i = 0; i < 6; ++i) {
    values[i] = six[i].value;
  }
  state.place = place_of(values);
  state.T_sheet_tool = transform_of(state.place);
  state.velocity_mm_s = {six[0].rate, six[1].rate, -six[2].rate};
  state.acceleration_mm_s2 = {six[0].rate2, six[1].rate2, -six[2].rate2};
  double sum = 0.0;
  for (const double v : state.velocity_mm_s) {
    sum += v * v;
  }
  state.speed_mm_s = square_root(sum);
  return state;
}

}  // namespace tubesight::core::kinematics
