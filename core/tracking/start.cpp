#include "core/tracking/start.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/base/overflow.h"
#include "core/tracking/projection.h"
#include "core/tracking/rim_outline.h"
#include "core/tracking/tool_point.h"

namespace tubesight::core::tracking {
namespace {

// A clicked tube-end: where it is on the virtual plane (at unit distance) and on the sheet.
template <Scalar S>
struct Anchor {
  TubeAddress address{};
  ClickedTube tube{};
  Vector2<Mm<S>> seen{};
  Vector2<Mm<S>> local{};  // mm from the first click's tube
};

template <Scalar S>
using AnchorList = StaticVector<Anchor<S>, kMaxStartPoints>;

template <Scalar S>
StartAnswer find_anchors(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                         const FieldView& field, const StartClickList& clicks, ClickSearch search,
                         const LightLevels& light, AnchorList<S>& anchors) {
  for (std::int32_t i = 0; i < clicks.size(); ++i) {
    const StartClick& click = clicks[i];
    if (map.state(click.address) == TubeState::kAbsent) {
      return {StartRefusal::kAddresses, i};
    }
    Anchor<S> anchor;
    anchor.address = click.address;
    anchor.tube = find_clicked_tube<S>(model, field, click.u_q16 / 65536, click.v_q16 / 65536,
                                       search, light.edge_threshold);
    if (!anchor.tube.found) {
      return {StartRefusal::kNoTubeThere, i};
    }
    const auto plane = model.camera.to_plane({from_scaled<Px<S>>(anchor.tube.center_u_q16, 16),
                                              from_scaled<Px<S>>(anchor.tube.center_v_q16, 16)});
    const auto seen = model.virtual_plane.from_image(plane);
    if (!seen) {
      return {StartRefusal::kNoTubeThere, i};
    }
    anchor.seen = *seen;
    anchor.local = model.lattice.offset(clicks[0].address, click.address);
    for (const Anchor<S>& other : anchors) {
      if (std::abs(other.tube.center_u_q16 - anchor.tube.center_u_q16) < other.tube.width_q16 / 2 &&
          std::abs(other.tube.center_v_q16 - anchor.tube.center_v_q16) <
              other.tube.height_q16 / 2) {
        return {StartRefusal::kSameTubeTwice, i};
      }
    }
    static_cast<void>(anchors.try_push_back(anchor));
  }
  return StartRefusal::kNone;
}

// Similarity of the virtual plane: seen = middle_seen + turn (local - middle_local), with
// turn = [a -b; b a] per mm.
template <Scalar S>
struct Similarity {
  Vector2<Mm<S>> middle_seen{};
  Vector2<Mm<S>> middle_local{};
  Unit<S> a{};
  Unit<S> b{};
};

template <Scalar S>
Vector2<Mm<S>> mean(const AnchorList<S>& anchors, Vector2<Mm<S>> Anchor<S>::*member) {
  const Mm<S> share = quotient<Mm<S>>(Mm<S>(1), from_scaled<Mm<S>>(anchors.size(), 0));
  Vector2<Mm<S>> sum{};
  for (const Anchor<S>& anchor : anchors) {
    sum = sum + Vector2<Mm<S>>{times((anchor.*member).x, share), times((anchor.*member).y, share)};
  }
  return sum;
}

// Least squares for the similarity s_i = [a -b; b a] l_i, both from their middles:
//
//   a = sum l . s / sum l . l,   b = sum (l_x s_y - l_y s_x) / sum l . l;
//
// false when the clicks' addresses contradict it by more than an
// eighth of the distances: lean of a degree and rough bisection stay well below.
template <Scalar S>
bool fit_similarity(const AnchorList<S>& anchors, Similarity<S>& fit) {
  using M = Mm<S>;
  fit.middle_seen = mean<S>(anchors, &Anchor<S>::seen);
  fit.middle_local = mean<S>(anchors, &Anchor<S>::local);
  M along{};
  M across{};
  M size{};
  // In units of 8 mm: pitches of up to 300 mm apart keep their squares in range.
  const M scale = constant<M>(0.125);
  for (const Anchor<S>& anchor : anchors) {
    const auto seen = anchor.seen - fit.middle_seen;
    const auto local = anchor.local - fit.middle_local;
    const M x = times(local.x, scale);
    const M y = times(local.y, scale);
    along += narrow<M>(product(x, seen.x) + product(y, seen.y));
    across += narrow<M>(product(x, seen.y) - product(y, seen.x));
    size += narrow<M>(product(x, x) + product(y, y));
  }
  if (size < constant<M>(1.0 / 16.0)) {
    return false;
  }
  const M a = quotient<M>(along, size);  // per 8 mm
  const M b = quotient<M>(across, size);
  M error{};
  M extent{};
  for (const Anchor<S>& anchor : anchors) {
    const auto seen = anchor.seen - fit.middle_seen;
    const auto local = anchor.local - fit.middle_local;
    const M x = times(local.x, scale);
    const M y = times(local.y, scale);
    const M ex = seen.x - narrow<M>(product(a, x) - product(b, y));
    const M ey = seen.y - narrow<M>(product(b, x) + product(a, y));
    error += narrow<M>(product(ex, ex) + product(ey, ey));
    extent += narrow<M>(product(seen.x, seen.x) + product(seen.y, seen.y));
  }
  fit.a = convert<Unit<S>>(times(a, scale));
  fit.b = convert<Unit<S>>(times(b, scale));
  return times(error, constant<M>(64.0)) < extent;
}

// A level sheet whose picture on the virtual plane is the similarity: a point l of it at the depth
// z is seen at R(angle) l / z, so that 1 / z = sqrt(a^2 + b^2) and (cos, sin) = z (a, b).
template <Scalar S>
StartRefusal level_pose(const TrackingModel<S>& model, const Similarity<S>& fit, TubeAddress anchor,
                        SheetPose<S>& pose) {
  using U = Unit<S>;
  using M = Mm<S>;
  // Widened by 32: elements are around 1/200 per mm.
  const M a = times(convert<M>(fit.a), constant<M>(32.0));
  const M b = times(convert<M>(fit.b), constant<M>(32.0));
  const M length = square_root(times(a, a) + times(b, b));
  if (length < constant<M>(1.0 / 32.0)) {
    return StartRefusal::kHeight;  // over 1000 mm away
  }
  const M depth = quotient<M>(constant<M>(32.0), length);
  const U cosine = quotient<U>(a, length);
  const U sine = quotient<U>(b, length);
  const auto& ex = model.virtual_plane.x_axis();
  const auto& ey = model.virtual_plane.y_axis();
  const auto& ez = model.virtual_plane.normal();
  const auto mix = [](const Vector3<U>& p, U cp, const Vector3<U>& q, U cq) {
    return Vector3<U>{narrow<U>(product(p.x, cp) + product(q.x, cq)),
                      narrow<U>(product(p.y, cp) + product(q.y, cq)),
                      narrow<U>(product(p.z, cp) + product(q.z, cq))};
  };
  pose.anchor = anchor;
  pose.x_axis = mix(ex, cosine, ey, sine);
  pose.y_axis = mix(ex, -sine, ey, cosine);
  pose.normal = ez;
  const auto deep = [&](U x, U y, U z) {
    return times(depth, narrow<M>(product(x, fit.middle_seen.x) + product(y, fit.middle_seen.y) +
                                  product(z, M(1))));
  };
  pose.origin = Vector3<M>{deep(ex.x, ey.x, ez.x), deep(ex.y, ey.y, ez.y), deep(ex.z, ey.z, ez.z)};
  const auto middle = pose.along(fit.middle_local);
  pose.origin = pose.origin - middle;
  const auto tool = find_tool_point<S>(model, pose);
  // Docked tips stand in the tube by a few mm at most; nobody works 250 mm below the sheet.
  if (!tool || tool->height_mm < constant<M>(-15.0) || tool->height_mm > constant<M>(250.0)) {
    return StartRefusal::kHeight;
  }
  return StartRefusal::kNone;
}

// The width of a bore's image, whether the search window holds it or not; 1/65536 px, zero when it
// cannot be projected.
template <Scalar S>
std::int32_t image_width_q16(const TrackingModel<S>& model, const Vector3<Mm<S>>& center,
                             const RimSpokes<S>& spokes) {
  std::int32_t least = 0;
  std::int32_t most = 0;
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const auto pixel = to_pixel<S>(model, center + spokes[k]);
    if (!pixel) {
      return 0;
    }
    const std::int32_t u_q16 = to_scaled(pixel->x, 16);
    least = k == 0 ? u_q16 : std::min(least, u_q16);
    most = k == 0 ? u_q16 : std::max(most, u_q16);
  }
  return most - least;
}

// The clicked tube-ends must be as large as bores at that distance look: the first that is not, -1
// where all are.
template <Scalar S>
std::int32_t find_misfit(const TrackingModel<S>& model, const SheetPose<S>& pose,
                         const AnchorList<S>& anchors) {
  const RimSpokes<S> spokes = make_rim_spokes<S>(pose, model.bore_radius_mm);
  for (std::int32_t i = 0; i < anchors.size(); ++i) {
    const std::int32_t predicted =
        image_width_q16<S>(model, pose.origin + pose.along(anchors[i].local), spokes);
    if (std::abs(anchors[i].tube.width_q16 - predicted) > predicted / 4) {
      return i;
    }
  }
  return -1;
}

// Midway between the clicked tube-ends and their surroundings: it is sheet what is brighter.
template <Scalar S>
std::int32_t middle_grey(const AnchorList<S>& anchors) {
  std::int32_t sum = 0;
  for (const Anchor<S>& anchor : anchors) {
    sum += anchor.tube.midway;
  }
  return sum / anchors.size();
}

}  // namespace

template <Scalar S>
StartAnswer find_start_pose(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                            const FieldView& field, const StartClickList& clicks,
                            ClickSearch search, LightLevels& light, SheetPose<S>& pose) {
  if (clicks.size() < 3) {
    return StartRefusal::kTooFew;
  }
  AnchorList<S> anchors;
  if (const StartAnswer answer = find_anchors<S>(model, map, field, clicks, search, light, anchors);
      !answer.taken()) {
    return answer;
  }
  Similarity<S> similarity;
  if (!fit_similarity<S>(anchors, similarity)) {
    return StartRefusal::kAddresses;
  }
  SheetPose<S> level;
  if (const auto refusal = level_pose<S>(model, similarity, clicks[0].address, level);
      refusal != StartRefusal::kNone) {
    return refusal;
  }
  if (const std::int32_t misfit = find_misfit<S>(model, level, anchors); misfit >= 0) {
    return {StartRefusal::kSize, misfit};
  }
  pose = level;
  if (search == ClickSearch::kRound && model.region_threshold == 0) {
    light.region_threshold = middle_grey<S>(anchors);
  }
  return StartRefusal::kNone;
}

template <Scalar S>
const typename StartSearch<S>::Found& StartSearch<S>::by(ClickSearch search) {
  std::optional<Found>& found = found_[search == ClickSearch::kRound ? 1 : 0];
  if (!found) {
    const bool before = take_overflow_flag();
    found.emplace();
    found->light = first_light<S>(*model_);
    found->answer =
        find_start_pose<S>(*model_, *map_, *field_, *clicks_, search, found->light, found->pose);
    found->overflowed = take_overflow_flag();
    if (before) {
      raise_overflow_flag();
    }
  }
  return *found;
}

#define TUBESIGHT_INSTANTIATE(S)                                                                \
  template StartAnswer find_start_pose<S>(const TrackingModel<S>&, const tubesheet::SheetMap&,  \
                                          const FieldView&, const StartClickList&, ClickSearch, \
                                          LightLevels&, SheetPose<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE
TUBESIGHT_INSTANTIATE_CLASS(StartSearch)

}  // namespace tubesight::core::tracking
